/* Second-order followers: y + (2z/w) y' + y''/w^2 = x + (r z/w) x', w = 2 pi f, exact for any time step while
 * x moves linearly from its old to its new value (spec 14.6). */
#ifndef SBRI_FOLLOWER_H
#define SBRI_FOLLOWER_H

#include "math/quat_log.h"

/* Effect of a step of a given length on e = y - x - `ahead` x': e <- a e + b e', e' <- c e + d e'. */
typedef struct sbri_follower_step {
  float a, b, c, d;
  float ahead_s; /* (r - 2) z / w */
  float h;
} sbri_follower_step;

/* f > 0, z >= 0, h >= 0. */
sbri_follower_step sbri_follower_step_of(float frequency_hz, float damping_ratio, float response, float h_s);

/* Follower of one number whose target jumps and then stays: `value` lags and overshoots. */
typedef struct sbri_lag {
  float value, rate;
} sbri_lag;
void sbri_lag_tick(sbri_lag *lag, float target, const sbri_follower_step *step);

/* Followers of positions and rotations that move linearly from the previous target. */
typedef struct sbri_position_follower {
  sbf_vec3 value, rate, followed;
} sbri_position_follower;
void sbri_position_follower_reset(sbri_position_follower *f, sbf_vec3 at);
void sbri_position_follower_tick(sbri_position_follower *f, sbf_vec3 target, const sbri_follower_step *step);

typedef struct sbri_rotation_follower {
  sbf_quat value;
  sbf_vec3 rate; /* rotation vector per second, in the axes of the rotations */
  sbf_quat followed;
} sbri_rotation_follower;
void sbri_rotation_follower_reset(sbri_rotation_follower *f, sbf_quat at);
void sbri_rotation_follower_tick(sbri_rotation_follower *f, sbf_quat target, const sbri_follower_step *step);

#endif
