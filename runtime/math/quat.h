/* Unit quaternions (x, y, z, w): rotations, right-handed. */
#ifndef SBRI_QUAT_H
#define SBRI_QUAT_H

#include "math/vec3.h"

static inline sbf_quat sbri_quat_identity(void) {
  return (sbf_quat){0, 0, 0, 1};
}
static inline sbf_quat sbri_quat_conjugate(sbf_quat q) {
  return (sbf_quat){-q.x, -q.y, -q.z, q.w};
}

/* First b, then a. */
static inline sbf_quat sbri_quat_multiply(sbf_quat a, sbf_quat b) {
  return (sbf_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

static inline sbf_vec3 sbri_rotate(sbf_quat q, sbf_vec3 v) {
  sbf_vec3 u = {q.x, q.y, q.z}, t = sbri_scale(sbri_cross(u, v), 2);
  return sbri_add(sbri_add_scaled(v, t, q.w), sbri_cross(u, t));
}

/* The axes of its frame: the images of +X, +Y and +Z. */
static inline sbf_vec3 sbri_quat_x(sbf_quat q) {
  float y = 2 * q.y, z = 2 * q.z;
  return (sbf_vec3){1 - (q.y * y + q.z * z), q.x * y + q.w * z, q.x * z - q.w * y};
}
static inline sbf_vec3 sbri_quat_y(sbf_quat q) {
  float x = 2 * q.x, z = 2 * q.z;
  return (sbf_vec3){q.y * x - q.w * z, 1 - (q.x * x + q.z * z), q.y * z + q.w * x};
}
static inline sbf_vec3 sbri_quat_z(sbf_quat q) {
  float x = 2 * q.x, y = 2 * q.y;
  return (sbf_vec3){q.z * x + q.w * y, q.z * y - q.w * x, 1 - (q.x * x + q.y * y)};
}

static inline sbf_quat sbri_quat_normalize(sbf_quat q) {
  float length = sqrtf(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(length > 1e-12f)) return sbri_quat_identity();
  float s = 1 / length;
  return (sbf_quat){q.x * s, q.y * s, q.z * s, q.w * s};
}

/* Normalised linear interpolation along the shorter arc, exact at both ends. */
static inline sbf_quat sbri_quat_blend(sbf_quat a, sbf_quat b, float t) {
  float sign = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -1.0f : 1.0f, u = t * sign, s = 1 - t;
  return sbri_quat_normalize(
      (sbf_quat){a.x * s + b.x * u, a.y * s + b.y * u, a.z * s + b.z * u, a.w * s + b.w * u});
}

/* The shortest rotation that takes one unit vector to another. */
static inline sbf_quat sbri_quat_between(sbf_vec3 from, sbf_vec3 to) {
  float w = 1 + sbri_dot(from, to);
  sbf_vec3 axis = sbri_cross(from, to);
  if (w < 1e-6f) { /* opposite: half a turn about any perpendicular axis */
    axis = sbri_cross(from, fabsf(from.x) < 0.9f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 1, 0));
    w = 0;
  }
  return sbri_quat_normalize((sbf_quat){axis.x, axis.y, axis.z, w});
}

/* Rotation whose frame has these three orthonormal, right-handed axes (Shepperd 1978). */
static inline sbf_quat sbri_quat_from_axes(sbf_vec3 x, sbf_vec3 y, sbf_vec3 z) {
  float t = x.x + y.y + z.z;
  sbf_quat q;
  if (t >= 0)
    q = (sbf_quat){y.z - z.y, z.x - x.z, x.y - y.x, 1 + t};
  else if (x.x >= y.y && x.x >= z.z)
    q = (sbf_quat){1 + x.x - y.y - z.z, x.y + y.x, x.z + z.x, y.z - z.y};
  else if (y.y >= z.z)
    q = (sbf_quat){x.y + y.x, 1 - x.x + y.y - z.z, y.z + z.y, z.x - x.z};
  else
    q = (sbf_quat){z.x + x.z, y.z + z.y, 1 - x.x - y.y + z.z, x.y - y.x};
  return sbri_quat_normalize(q);
}

#endif
