/* Search distance for contacts of soft bodies. The motion of a point in a tick is predicted at its beginning,
 * but springs may accelerate a slow point to the maximum speed of the body within the tick. */
#ifndef SBRI_REACH_H
#define SBRI_REACH_H

#include "math/vec3.h"
#include "model/runtime_model.h"

/* Margin for speeds that grow within a tick by gravity and springs: a displacement of this fraction of the
 * body's size. */
#define SBRI_REACH_FRACTION 0.02f

/* Maximum speed of the body's free points, m/s; `velocities` are those of its island. */
static inline float sbri_fastest_of(const sbri_body *body, const float *velocities) {
  float max = 0;
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 speed = sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]);
    float square = sbri_dot(speed, speed);
    max = square > max ? square : max;
  }
  return sqrtf(max);
}

/* Search distance in world metres. `own`: displacement of the point in the tick; `fastest`: that of the
 * body's fastest point; `scale`: that of the character. */
static inline float sbri_reach_of(const sbri_body *body, float scale, float own, float fastest) {
  return (body->contact.margin_m + SBRI_REACH_FRACTION * body->rest_size_m) * scale +
         (own > fastest ? own : fastest);
}

#endif
