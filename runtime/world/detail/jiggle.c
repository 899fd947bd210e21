/* Jiggle (spec 10.4): bodies that move rigidly with their bones, displaced by the lag of a second-order
 * follower of their centre. Each has a frame of its own at the end of the pose: its bone's motion, and the
 * displacement.
 */
#include "math/quat.h"
#include "state/pose/frames.h"
#include "world/detail/detail_levels.h"

/* Greatest displacement, in sizes of all bodies: a bone that jumps does not throw them away. */
static const float MAX_SIZES = 0.25f;

static sbf_vec3 middle_of(const sbri_jiggle *jiggle, const sbr_transform *parent) {
  return sbri_add(parent->position, sbri_rotate(parent->rotation, jiggle->middle));
}

static void put(sbri_character *c, uint32_t index, const sbr_transform *parent, sbf_vec3 shift) {
  sbr_transform *frame = &sbri_pose(c)[sbri_first_jiggle_frame(c->model) + index];
  *frame = (sbr_transform){sbri_scale(sbri_add(parent->position, shift), c->scale), parent->rotation};
}

void sbri_jiggles_reset(sbri_character *c) {
  for (uint32_t j = 0; j < c->model->jiggle_count; j++) {
    const sbri_jiggle *jiggle = &c->model->jiggles[j];
    sbr_transform parent = sbri_delta_of(c, sbri_pose(c), jiggle->parent);
    sbri_position_follower_reset(&sbri_jiggles(c)[j], middle_of(jiggle, &parent));
    put(c, j, &parent, sbri_vec3(0, 0, 0));
  }
}

void sbri_jiggles_tick(sbri_character *c, float tick_s) {
  float max = MAX_SIZES * c->model->rest_size_m;
  for (uint32_t j = 0; j < c->model->jiggle_count; j++) {
    const sbri_jiggle *jiggle = &c->model->jiggles[j];
    sbri_position_follower *follower = &sbri_jiggles(c)[j];
    sbr_transform parent = sbri_delta_of(c, sbri_pose(c), jiggle->parent);
    sbf_vec3 middle = middle_of(jiggle, &parent);
    sbri_follower_step step =
        sbri_follower_step_of(jiggle->frequency_hz, jiggle->damping_ratio, jiggle->response, tick_s);
    sbri_position_follower_tick(follower, middle, &step);
    sbf_vec3 shift = sbri_sub(follower->value, middle);
    if (!(sbri_dot(shift, shift) <= max * max)) {
      sbri_position_follower_reset(follower, middle);
      shift = sbri_vec3(0, 0, 0);
    }
    put(c, j, &parent, shift);
  }
}

void sbri_jiggles_rebase(sbri_character *c, sbf_vec3 shift) {
  for (uint32_t j = 0; j < c->model->jiggle_count; j++) {
    sbri_position_follower *follower = &sbri_jiggles(c)[j];
    follower->value = sbri_sub(follower->value, shift);
    follower->followed = sbri_sub(follower->followed, shift);
  }
}
