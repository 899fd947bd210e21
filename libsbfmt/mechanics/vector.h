/* Vectors of three doubles, used for the sums in this folder. */
#ifndef SBFI_MECHANICS_VECTOR_H
#define SBFI_MECHANICS_VECTOR_H

#include <math.h>

#include "sbfmt/base.h"

typedef struct sbfi_d3 {
  double x, y, z;
} sbfi_d3;

static inline sbfi_d3 sbfi_d3_of(sbf_vec3 a) {
  return (sbfi_d3){a.x, a.y, a.z};
}
static inline sbf_vec3 sbfi_d3_rounded(sbfi_d3 a) {
  return (sbf_vec3){(float)a.x, (float)a.y, (float)a.z};
}
static inline sbfi_d3 sbfi_d3_add(sbfi_d3 a, sbfi_d3 b) {
  return (sbfi_d3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline sbfi_d3 sbfi_d3_sub(sbfi_d3 a, sbfi_d3 b) {
  return (sbfi_d3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline sbfi_d3 sbfi_d3_scale(sbfi_d3 a, double s) {
  return (sbfi_d3){a.x * s, a.y * s, a.z * s};
}
static inline double sbfi_d3_dot(sbfi_d3 a, sbfi_d3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline sbfi_d3 sbfi_d3_cross(sbfi_d3 a, sbfi_d3 b) {
  return (sbfi_d3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double sbfi_d3_length(sbfi_d3 a) {
  return sqrt(sbfi_d3_dot(a, a));
}
static inline sbfi_d3 sbfi_d3_normal(sbfi_d3 a) {
  double length = sbfi_d3_length(a);
  return length > 0 ? sbfi_d3_scale(a, 1 / length) : (sbfi_d3){0, 0, 0};
}

#endif
