/* Conversion of rotations to rotation vectors and back: axis times angle in rad. */
#ifndef SBRI_QUAT_LOG_H
#define SBRI_QUAT_LOG_H

#include "math/quat.h"
#include "math/trig.h"

/* Rotation vector of q along the shorter arc: its length is within [0, pi]. */
static inline sbf_vec3 sbri_quat_log(sbf_quat q) {
  float sign = q.w < 0 ? -1.0f : 1.0f;
  sbf_vec3 v = {sign * q.x, sign * q.y, sign * q.z};
  float sine = sbri_length(v), cosine = sign * q.w;
  if (sine < 1e-6f) return sbri_scale(v, 2);
  return sbri_scale(v, 2 * sbri_atan2(sine, cosine) / sine);
}

static inline sbf_quat sbri_quat_exp(sbf_vec3 v) {
  float angle = sbri_length(v), s, c;
  if (angle < 1e-6f) return sbri_quat_normalize((sbf_quat){0.5f * v.x, 0.5f * v.y, 0.5f * v.z, 1});
  sbri_sincos(0.5f * angle, &s, &c);
  s /= angle;
  return (sbf_quat){v.x * s, v.y * s, v.z * s, c};
}

/* About a unit axis. */
static inline sbf_quat sbri_quat_about(sbf_vec3 axis, float angle_rad) {
  float s, c;
  sbri_sincos(0.5f * angle_rad, &s, &c);
  return (sbf_quat){axis.x * s, axis.y * s, axis.z * s, c};
}

#endif
