/* Minimum-jerk motion of one coordinate from any state to rest at a target at a given time (Flash and Hogan,
 * The coordination of arm movements, 1985). While the target is fixed, all ticks follow one quintic
 * polynomial; when it moves, velocity and acceleration stay continuous. */
#ifndef SBRI_GLIDE_H
#define SBRI_GLIDE_H

#include "math/vec3.h"

typedef struct sbri_glide {
  float position, velocity, acceleration;
} sbri_glide;

static inline sbri_glide sbri_glide_at(float at) {
  return (sbri_glide){at, 0, 0};
}

/* `step_s` further, to arrive after `left_s`. */
static inline void sbri_glide_tick(sbri_glide *g, float target, float left_s, float step_s) {
  if (left_s <= step_s) {
    *g = sbri_glide_at(target);
    return;
  }
  float t = step_s / left_s, away = target - g->position, v = g->velocity * left_s,
        a = 0.5f * g->acceleration * left_s * left_s;
  float c3 = 10 * away - 6 * v - 3 * a, c4 = -15 * away + 8 * v + 3 * a, c5 = 6 * away - 3 * v - a;
  g->position += t * (v + t * (a + t * (c3 + t * (c4 + t * c5))));
  g->velocity = (v + t * (2 * a + t * (3 * c3 + t * (4 * c4 + t * 5 * c5)))) / left_s;
  g->acceleration = (2 * a + t * (6 * c3 + t * (12 * c4 + t * 20 * c5))) / (left_s * left_s);
}

/* The same from rest to rest: rises from 0 to 1 with t from 0 to 1; speed and acceleration are 0 at both
 * ends.
 */
static inline float sbri_smooth(float t) {
  t = sbri_clamp(t, 0, 1);
  return t * t * t * (10 + t * (6 * t - 15));
}

#endif
