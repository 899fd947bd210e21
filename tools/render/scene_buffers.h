/* Buffers of a scene's meshes and lines in OpenGL. */
#ifndef RENDER_SCENE_BUFFERS_H
#define RENDER_SCENE_BUFFERS_H

#include "render/draw_scene_data.h"
#include "render/gl_api.h"

/* A vertex array with its buffers. */
typedef struct mesh_buffers {
  GLuint array, positions, normals, colours, uvs, indices;
} mesh_buffers;

/* The same for lines, whose indices are constant. */
typedef struct line_buffers {
  GLuint array, corners, indices;
  size_t capacity; /* number of lines in `indices` */
} line_buffers;

/* Coloured ones also have colours and texture coordinates. */
void mesh_buffers_create(mesh_buffers *made, const gl_api *gl, bool coloured);
void mesh_buffers_destroy(const mesh_buffers *buffers, const gl_api *gl);
void mesh_buffers_fill(const mesh_buffers *to, const gl_api *gl, const draw_scene_list *positions,
    const draw_scene_list *normals, const draw_scene_list *indices);

void line_buffers_create(line_buffers *made, const gl_api *gl);
void line_buffers_destroy(const line_buffers *buffers, const gl_api *gl);
/* Binds the indices of this number of lines; false if memory runs out or the index range is exceeded. */
bool line_buffers_grow(line_buffers *lines, const gl_api *gl, size_t line_count);

void buffer_fill(const gl_api *gl, GLenum target, GLuint buffer, const void *items, size_t bytes);

#endif
