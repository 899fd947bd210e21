/* Vector arithmetic for drawing; matrices are column-major, as in OpenGL. */
#ifndef RENDER_DRAW_MATH_H
#define RENDER_DRAW_MATH_H

#include <math.h>

#include "sbfmt/base.h"

static inline sbf_vec3 v3(float x, float y, float z) {
  return (sbf_vec3){x, y, z};
}
static inline sbf_vec3 v3_add(sbf_vec3 a, sbf_vec3 b) {
  return v3(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline sbf_vec3 v3_sub(sbf_vec3 a, sbf_vec3 b) {
  return v3(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline sbf_vec3 v3_scale(sbf_vec3 a, float s) {
  return v3(a.x * s, a.y * s, a.z * s);
}
static inline float v3_dot(sbf_vec3 a, sbf_vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline float v3_length(sbf_vec3 a) {
  return sqrtf(v3_dot(a, a));
}

static inline sbf_vec3 v3_cross(sbf_vec3 a, sbf_vec3 b) {
  return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* `fallback` if `a` has no direction. */
static inline sbf_vec3 v3_unit(sbf_vec3 a, sbf_vec3 fallback) {
  float length = v3_length(a);
  return length > 1e-20f ? v3_scale(a, 1 / length) : fallback;
}

/* A unit vector perpendicular to the unit vector `a`. */
static inline sbf_vec3 v3_side(sbf_vec3 a) {
  return v3_unit(v3_cross(a, fabsf(a.y) < 0.9f ? v3(0, 1, 0) : v3(1, 0, 0)), v3(1, 0, 0));
}

static inline sbf_vec3 v3_rotate(sbf_quat q, sbf_vec3 a) {
  sbf_vec3 axis = {q.x, q.y, q.z};
  sbf_vec3 t = v3_scale(v3_cross(axis, a), 2);
  return v3_add(a, v3_add(v3_scale(t, q.w), v3_cross(axis, t)));
}

typedef struct matrix4 {
  float at[16]; /* at[4 * column + row] */
} matrix4;

matrix4 matrix4_product(const matrix4 *a, const matrix4 *b);
matrix4 matrix4_view(
    sbf_vec3 eye, sbf_vec3 back, sbf_vec3 up); /* `back`: unit vector from the subject to the eye */
matrix4 matrix4_perspective(
    float half_height, float aspect, float near, float far); /* tangent of half the angle */
matrix4 matrix4_orthographic(float left, float right, float bottom, float top, float near, float far);

/* Axis-aligned box; empty if min > max. */
typedef struct box3 {
  sbf_vec3 min, max;
} box3;

static inline box3 box3_empty(void) {
  return (box3){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}
static inline bool box3_is_empty(const box3 *box) {
  return !(box->min.x <= box->max.x);
}

/* Ignores points that are not finite, so that a broken simulation can still be drawn. */
static inline void box3_add(box3 *box, sbf_vec3 p) {
  if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) return;
  box->min = v3(fminf(box->min.x, p.x), fminf(box->min.y, p.y), fminf(box->min.z, p.z));
  box->max = v3(fmaxf(box->max.x, p.x), fmaxf(box->max.y, p.y), fmaxf(box->max.z, p.z));
}

#endif
