/* What the lit shaders look up: the shadow map of the key light, and the light that reaches the ground. */
#ifndef RENDER_LIGHT_MAPS_H
#define RENDER_LIGHT_MAPS_H

#include "render/draw_math.h"
#include "render/gl_api.h"
#include "render/programs.h"

enum { SHADOW_MAP_SIDE = 512, GROUND_MAP_SIDE = 224, HEIGHT_MAP_SIDE = 112 }; /* texels */

typedef struct light_maps {
  GLuint shadow_texture, shadow_frame, compared, plain; /* two samplers over one texture */
  GLuint ground_texture, ground_frame;                  /* heights of the ground */
  GLuint lowest_texture, lowest_frame;                  /* heights of the lowest thing above it */
  GLuint open_texture, open_frame;                      /* how much sky the ground sees */
  GLuint light_texture, light_frame, softened_texture, softened_frame; /* light that reaches the ground */
  /* The sides only grow, and the corners keep to whole texels, so that nothing shimmers as things move. */
  float shadow_side, ground_side;
} light_maps;

/* Where the maps lie, for one frame. */
typedef struct light_view {
  matrix4 shadow_clip_from_world;  /* to -1..1 */
  float shadow_side, shadow_depth; /* metres across, and along the light */
  matrix4 heights_clip_from_world; /* seen from below: x, z across; height as depth */
  float min_x, min_z, ground_side; /* metres */
  float low, high;                 /* heights at depth 0 and 1, metres */
} light_view;

/* A picture of depths alone, and the frame to draw it by. */
bool light_maps_make_depth(const gl_api *gl, GLsizei width, GLsizei height, GLuint *texture, GLuint *frame);

bool light_maps_create(light_maps *maps, const gl_api *gl);
void light_maps_destroy(light_maps *maps, const gl_api *gl);

/* Fits the maps to what throws shadows on a ground that lies within the box `ground` (may be empty) and, near
 * the casters, no lower than `ground_near`. */
void light_maps_update_view(light_maps *maps, const box3 *casters, const box3 *ground, float ground_near,
    sbf_vec3 to_key, light_view *projections);

#endif
