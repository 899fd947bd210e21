/* Draws the parts of a scene's meshes by their materials. The meshes' vertex array must be bound. */
#ifndef RENDER_MESH_PARTS_H
#define RENDER_MESH_PARTS_H

#include "render/draw_math.h"
#include "render/draw_scene_data.h"
#include "render/image_textures.h"
#include "render/programs.h"

typedef struct mesh_parts {
  const gl_api *gl;
  const program_set *programs;
  image_textures *images;
  const draw_scene *scene;
} mesh_parts;

/* Depth of shadow casters; if there are none, of all parts that do not blend. Holes stay open. */
void mesh_parts_cast(const mesh_parts *parts, const matrix4 *map_from_world);

/* Depth of parts that are neither transparent nor blend: opaque parts, then (`holes`) those with holes. */
void mesh_parts_fill_depth(const mesh_parts *parts, const matrix4 *clip_from_world, bool holes);

/* Colour of parts that are neither transparent nor blend. Parts with holes write their own depth. */
void mesh_parts_colour(const mesh_parts *parts);

/* A blended part, back faces first. */
void mesh_parts_blend(const mesh_parts *parts, const draw_scene_part *part);

void mesh_parts_draw(const gl_api *gl, const draw_scene_part *part);

#endif
