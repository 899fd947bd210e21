/* Second-order followers: y + (2z/w) y' + y''/w^2 = x + (r z/w) x', w = 2 pi f, exact for any time step while
 * x runs evenly from where it was to where it is (spec 14.6). */
#ifndef SBRI_FOLLOWER_H
#define SBRI_FOLLOWER_H

#include "math/quat_log.h"

/* What a step of a given length does to e = y - x - `ahead` x': e <- a e + b e', e' <- c e + d e'. */
typedef struct sbri_follower_step {
  float a, b, c, d;
  float ahead_s; /* (r - 2) z / w */
  float h;
} sbri_follower_step;

/* f > 0, z >= 0, h >= 0. */
sbri_follower_step sbri_follower_step_of(float frequency_hz, float damping_ratio, float response, float h_s);

/* A follower of one number whose aim moves at once and then stands: `value` lags and overshoots. */
typedef struct sbri_lag {
  float value, rate;
} sbri_lag;
void sbri_lag_tick(sbri_lag *lag, float target, const sbri_follower_step *step);

/* Followers of places and rotations that run evenly over the step from what was followed last. */
typedef struct sbri_position_follower {
  sbf_vec3 value, rate, followed;
} sbri_position_follower;
void sbri_position_follower_reset(sbri_position_follower *f, sbf_vec3 at);
void sbri_position_follower_tick(sbri_position_follower *f, sbf_vec3 target, const sbri_follower_step *step);

typedef struct sbri_turn_follower {
  sbf_quat value;
  sbf_vec3 rate; /* rotation vector a second, in the axes that the rotations are seen from */
  sbf_quat followed;
} sbri_turn_follower;
void sbri_turn_follower_reset(sbri_turn_follower *f, sbf_quat at);
void sbri_turn_follower_tick(sbri_turn_follower *f, sbf_quat target, const sbri_follower_step *step);

#endif
