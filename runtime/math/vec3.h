/* Vectors of three: arithmetic shared by the runtime. The only library function is sqrtf. */
#ifndef SBRI_VEC3_H
#define SBRI_VEC3_H

#include <math.h>

#include "sbfmt/base.h"

static inline sbf_vec3 sbri_vec3(float x, float y, float z) {
  return (sbf_vec3){x, y, z};
}
static inline sbf_vec3 sbri_add(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline sbf_vec3 sbri_sub(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline sbf_vec3 sbri_scale(sbf_vec3 a, float s) {
  return (sbf_vec3){a.x * s, a.y * s, a.z * s};
}
static inline sbf_vec3 sbri_add_scaled(sbf_vec3 a, sbf_vec3 b, float s) {
  return sbri_add(a, sbri_scale(b, s));
}
static inline float sbri_dot(sbf_vec3 a, sbf_vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline sbf_vec3 sbri_cross(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline float sbri_length(sbf_vec3 a) {
  return sqrtf(sbri_dot(a, a));
}
static inline sbf_vec3 sbri_lerp(sbf_vec3 a, sbf_vec3 b, float t) {
  return sbri_add_scaled(a, sbri_sub(b, a), t);
}

/* Unit vector; `otherwise` if `a` is too short. */
static inline sbf_vec3 sbri_normalize(sbf_vec3 a, sbf_vec3 otherwise) {
  float length = sbri_length(a);
  return length > 1e-12f ? sbri_scale(a, 1 / length) : otherwise;
}

static inline float sbri_clamp(float value, float low, float high) {
  return value < low ? low : value > high ? high : value;
}

/* Remainder by a period greater than 0, in [0, period]; 0 if the value's rounding exceeds the period. */
static inline float sbri_wrap(float value, float period) {
  float periods = value / period;
  if (!(fabsf(periods) < 0x1p24f)) return 0;
  value -= period * (float)(int32_t)periods;
  return value < 0 ? value + period : value;
}

#endif
