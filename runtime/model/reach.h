/* How far off the places of a soft body are looked for: what bounds a place in a tick is found when it
 * begins, and springs throw back what was slow as fast as anything of the body goes. */
#ifndef SBRI_REACH_H
#define SBRI_REACH_H

#include "math/vec3.h"
#include "model/runtime_model.h"

/* Margin for speeds that grow within a tick by gravity and springs: a displacement of this fraction of the
 * body's size. */
#define SBRI_REACH_FRACTION 0.02f

/* The fastest of the body's free points, m/s; velocities of its island. */
static inline float sbri_fastest_of(const sbri_body *body, const float *velocities) {
  float max = 0;
  for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++) {
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 speed = sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]);
    float square = sbri_dot(speed, speed);
    max = square > max ? square : max;
  }
  return sqrtf(max);
}

/* Metres of the world, for a place that goes `own` in the tick, of a character of that scale, on a body whose
 * fastest point goes `fastest`. */
static inline float sbri_reach_of(const sbri_body *body, float scale, float own, float fastest) {
  return (body->margin_m + SBRI_REACH_FRACTION * body->rest_size_m) * scale + (own > fastest ? own : fastest);
}

#endif
