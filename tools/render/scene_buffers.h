/* A scene's meshes and lines in OpenGL's memory. */
#ifndef RENDER_SCENE_BUFFERS_H
#define RENDER_SCENE_BUFFERS_H

#include "render/draw_scene_data.h"
#include "render/gl_api.h"

/* A vertex array and the buffers it reads. */
typedef struct mesh_buffers {
  GLuint array, positions, normals, colours, uvs, indices;
} mesh_buffers;

/* The same of lines, whose corners are the same however they lie. */
typedef struct line_buffers {
  GLuint array, corners, indices;
  size_t capacity; /* lines that `indices` has corners for */
} line_buffers;

/* Coloured ones have colours and places in an image too. */
void mesh_buffers_create(mesh_buffers *made, const gl_api *gl, bool coloured);
void mesh_buffers_destroy(const mesh_buffers *buffers, const gl_api *gl);
void mesh_buffers_fill(const mesh_buffers *to, const gl_api *gl, const draw_scene_list *positions,
    const draw_scene_list *normals, const draw_scene_list *indices);

void line_buffers_create(line_buffers *made, const gl_api *gl);
void line_buffers_destroy(const line_buffers *buffers, const gl_api *gl);
/* Binds the indices of so many lines; false: no memory, or more lines than indices can name. */
bool line_buffers_grow(line_buffers *lines, const gl_api *gl, size_t line_count);

void buffer_fill(const gl_api *gl, GLenum target, GLuint buffer, const void *items, size_t bytes);

#endif
