/* A vector of three and an unused fourth number, in one SIMD register if available: for loops from one body
 * to the next, where lanes cannot hold several bodies. Each operation is the IEEE one, and sums have the
 * order of sbri_dot, so that the bits are the same everywhere. */
#ifndef SBRI_FOUR_H
#define SBRI_FOUR_H

#include "math/vec3.h"

#if defined(__GNUC__)
/* Aligned like a float. */
typedef float sbri_four __attribute__((vector_size(16), aligned(4)));

static inline sbri_four sbri_four_of(sbf_vec3 v) {
  return (sbri_four){v.x, v.y, v.z, 0};
}
static inline sbri_four sbri_four_add(sbri_four a, sbri_four b) {
  return a + b;
}
static inline sbri_four sbri_four_sub(sbri_four a, sbri_four b) {
  return a - b;
}
static inline sbri_four sbri_four_mul(sbri_four a, sbri_four b) {
  return a * b;
}
static inline sbri_four sbri_four_scale(sbri_four a, float s) {
  return a * s;
}
/* y, z, x. */
static inline sbri_four sbri_four_yzx(sbri_four a) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3);
}
static inline float sbri_four_at(sbri_four a, int k) {
  return a[k];
}
#else
typedef struct sbri_four {
  float at[4];
} sbri_four;

static inline sbri_four sbri_four_of(sbf_vec3 v) {
  return (sbri_four){{v.x, v.y, v.z, 0}};
}
static inline sbri_four sbri_four_add(sbri_four a, sbri_four b) {
  return (sbri_four){{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2], 0}};
}
static inline sbri_four sbri_four_sub(sbri_four a, sbri_four b) {
  return (sbri_four){{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2], 0}};
}
static inline sbri_four sbri_four_mul(sbri_four a, sbri_four b) {
  return (sbri_four){{a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2], 0}};
}
static inline sbri_four sbri_four_scale(sbri_four a, float s) {
  return (sbri_four){{a.at[0] * s, a.at[1] * s, a.at[2] * s, 0}};
}
static inline sbri_four sbri_four_yzx(sbri_four a) {
  return (sbri_four){{a.at[1], a.at[2], a.at[0], 0}};
}
static inline float sbri_four_at(sbri_four a, int k) {
  return a.at[k];
}
#endif

static inline sbf_vec3 sbri_four_xyz(sbri_four a) {
  return sbri_vec3(sbri_four_at(a, 0), sbri_four_at(a, 1), sbri_four_at(a, 2));
}
static inline sbri_four sbri_four_add_scaled(sbri_four a, sbri_four b, float s) {
  return sbri_four_add(a, sbri_four_scale(b, s));
}
static inline float sbri_four_dot(sbri_four a, sbri_four b) {
  sbri_four m = sbri_four_mul(a, b);
  return sbri_four_at(m, 0) + sbri_four_at(m, 1) + sbri_four_at(m, 2);
}
/* A matrix, by its columns, times v. */
static inline sbri_four sbri_four_times(const sbri_four columns[3], sbri_four v) {
  sbri_four sum = sbri_four_scale(columns[0], sbri_four_at(v, 0));
  sum = sbri_four_add_scaled(sum, columns[1], sbri_four_at(v, 1));
  return sbri_four_add_scaled(sum, columns[2], sbri_four_at(v, 2));
}

#endif
