/* Light maps for the shaders: the shadow map of the key light, and light on the ground. */
#ifndef RENDER_LIGHT_MAPS_H
#define RENDER_LIGHT_MAPS_H

#include "render/draw_math.h"
#include "render/gl_api.h"
#include "render/programs.h"

enum { SHADOW_MAP_SIDE = 512, GROUND_MAP_SIDE = 224, HEIGHT_MAP_SIDE = 112 }; /* texels */

typedef struct light_maps {
  GLuint shadow_texture, shadow_frame, compared, plain; /* two samplers over one texture */
  GLuint ground_texture, ground_frame;                  /* heights of the ground */
  GLuint lowest_texture, lowest_frame;                  /* heights of the lowest objects above it */
  GLuint open_texture, open_frame;                      /* visible fraction of the sky on the ground */
  GLuint light_texture, light_frame, softened_texture, softened_frame; /* light on the ground */
  /* The sizes only grow, and corners are aligned to texels, so that nothing shimmers as objects move. */
  float shadow_side, ground_side;
} light_maps;

/* Position of the maps for one frame. */
typedef struct light_view {
  matrix4 shadow_clip_from_world;  /* to -1..1 */
  float shadow_side, shadow_depth; /* metres, width and depth along the light */
  matrix4 heights_clip_from_world; /* seen from below: x, z in the plane; height as depth */
  float min_x, min_z, ground_side; /* metres */
  float low, high;                 /* heights at depth 0 and 1, metres */
} light_view;

/* Creates a depth texture and its framebuffer. */
bool light_maps_make_depth(const gl_api *gl, GLsizei width, GLsizei height, GLuint *texture, GLuint *frame);

bool light_maps_create(light_maps *maps, const gl_api *gl);
void light_maps_destroy(light_maps *maps, const gl_api *gl);

/* Fits the maps to shadow casters on a ground within the box `ground` (may be empty), which near the
 * casters is no lower than `ground_near`. */
void light_maps_update_view(light_maps *maps, const box3 *casters, const box3 *ground, float ground_near,
    sbf_vec3 to_key, light_view *projections);

#endif
