/* Shader data of a frame: camera, lights, and positions of the light maps. */
#ifndef RENDER_FRAME_BLOCK_H
#define RENDER_FRAME_BLOCK_H

#include "render/camera.h"
#include "render/light_maps.h"

enum { DISC_POINTS = 24 };

/* The block Frame of shaders/common.glsl, in the same order: std140 packs vec4 and mat4 as C does. */
typedef struct frame_block {
  matrix4 clip_from_world, shadow_from_world;
  float eye[4], subject[4], key[4], fill[4], rim[4], screen[4], floor_grid[4], ground_map[4], heights[4],
      shadow[4], depth[4];
  float disc[DISC_POINTS][4];
} frame_block;

/* Initializes once: points that cover a disc evenly. */
void frame_block_begin(frame_block *frame);

/* Fills it for a picture with this number of samples; the ground fades out at `ground_radius`. */
void frame_block_fill(frame_block *frame, uint32_t width, uint32_t height, const draw_camera *camera,
    const light_view *maps, float ground_radius, bool bodies_shadow_bodies);

/* Direction towards the key light. */
sbf_vec3 frame_block_key(const draw_camera *camera);

#endif
