/* The parts of a scene's meshes, each drawn as its material says. The meshes' vertex array must be bound. */
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

/* Depth alone of what throws shadows; where nothing does, of all but what blends. Holes stay open. */
void mesh_parts_cast(const mesh_parts *parts, const matrix4 *map_from_world);

/* Depth alone of what is neither seen through nor blends: opaque parts, then (`holes`) those with holes. */
void mesh_parts_fill_depth(const mesh_parts *parts, const matrix4 *clip_from_world, bool holes);

/* Colour of what is neither seen through nor blends. Parts with holes write their own depth. */
void mesh_parts_colour(const mesh_parts *parts);

/* One part that blends with what is behind it, its own far sides first. */
void mesh_parts_blend(const mesh_parts *parts, const draw_scene_part *part);

void mesh_parts_draw(const gl_api *gl, const draw_scene_part *part);

#endif
