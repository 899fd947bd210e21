#include "render/frame_block.h"

/* Vogel's spiral: points at the golden angle cover a disc evenly. */
void frame_block_begin(frame_block *frame) {
  for (int i = 0; i < DISC_POINTS; i++) {
    float radius = sqrtf(((float)i + 0.5f) / DISC_POINTS), angle = 2.39996323f * (float)i;
    frame->disc[i][0] = radius * cosf(angle);
    frame->disc[i][1] = radius * sinf(angle);
  }
}

static void set4(float *to, sbf_vec3 v, float w) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = w;
}

/* Converts a direction relative to the camera's initial view. */
static sbf_vec3 towards(float home_yaw, float yaw, float pitch) {
  float level = cosf(pitch);
  return v3(level * sinf(home_yaw + yaw), sinf(pitch), level * cosf(home_yaw + yaw));
}

sbf_vec3 frame_block_key(const draw_camera *camera) {
  return towards(camera->home_yaw, -0.75f, 0.82f);
}

/* 1, 2 or 5 times a power of ten, such that a subject of this size spans about ten cells. */
static float grid_cell(float size) {
  float decade = powf(10, floorf(log10f(fmaxf(size, 1e-3f) / 10))), steps = size / 10 / decade;
  return decade * (steps < 1.5f ? 1.0f : steps < 3.5f ? 2.0f : steps < 7.5f ? 5.0f : 10.0f);
}

void frame_block_fill(frame_block *frame, uint32_t width, uint32_t height, const draw_camera *camera,
    const light_view *maps, float ground_radius, bool bodies_shadow_bodies) {
  float aspect = (float)width / (float)height, size = 2 * camera->distance * camera->half_height;
  matrix4 view = draw_camera_view(camera),
          projection = draw_camera_projection(camera, aspect, 12 * camera->distance * camera->half_height);
  frame->clip_from_world = matrix4_product(&projection, &view);
  const matrix4 half = {{0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 1}};
  frame->shadow_from_world = matrix4_product(&half, &maps->shadow_clip_from_world);
  set4(frame->eye, draw_camera_eye(camera), camera->distance);
  set4(frame->subject, camera->subject, ground_radius);
  set4(frame->key, frame_block_key(camera), bodies_shadow_bodies ? 1 : 0);
  set4(frame->fill, towards(camera->home_yaw, 1.1f, 0.35f), 0);
  set4(frame->rim, towards(camera->home_yaw, 2.6f, 0.55f), 0);
  set4(frame->screen, v3((float)width, (float)height, 1 / (float)width), 1 / (float)height);
  set4(frame->floor_grid, v3(grid_cell(size), fmaxf(1, (float)height / 720), 0), 0);
  set4(frame->ground_map, v3(maps->min_x, maps->min_z, 1 / maps->ground_side),
      maps->ground_side / GROUND_MAP_SIDE);
  set4(frame->heights, v3(maps->low, maps->high, 0), 0);
  set4(frame->depth, v3(0.5f * projection.at[14], 0.5f * projection.at[10] - 0.5f, 0.07f * size), 0);
  /* A light 14 degrees wide: the penumbra is that fraction of the distance from the caster. */
  float texel = 1.0f / SHADOW_MAP_SIDE, growth = 0.125f * maps->shadow_depth / maps->shadow_side;
  set4(frame->shadow, v3(0.028f, growth, 1.5f * texel), 2.0f * texel * maps->shadow_side);
}
