/* Rest positions and rotations in double precision. */
#ifndef SBFI_POSE_H
#define SBFI_POSE_H

#include "mechanics/extent.h"
#include "mechanics/vector.h"
#include "sbfmt/model.h"

typedef struct sbfi_rotation {
  sbfi_d3 v;
  double w;
} sbfi_rotation;

/* Normalized; the identity if the quaternion has length 0, as in the specification. */
static inline sbfi_rotation sbfi_rotation_of(sbf_quat q) {
  double length = sqrt((double)q.x * q.x + (double)q.y * q.y + (double)q.z * q.z + (double)q.w * q.w);
  if (!(length > 0)) return (sbfi_rotation){{0, 0, 0}, 1};
  return (sbfi_rotation){{q.x / length, q.y / length, q.z / length}, q.w / length};
}

static inline sbfi_d3 sbfi_rotated(sbfi_rotation q, sbfi_d3 v) {
  sbfi_d3 t = sbfi_d3_scale(sbfi_d3_cross(q.v, v), 2);
  return sbfi_d3_add(v, sbfi_d3_add(sbfi_d3_scale(t, q.w), sbfi_d3_cross(q.v, t)));
}

static inline sbfi_rotation sbfi_rotation_inverse(sbfi_rotation q) {
  return (sbfi_rotation){sbfi_d3_scale(q.v, -1), q.w};
}

static inline sbfi_rotation sbfi_rotation_product(sbfi_rotation a, sbfi_rotation b) {
  sbfi_d3 v = sbfi_d3_add(sbfi_d3_scale(b.v, a.w), sbfi_d3_scale(a.v, b.w));
  return (sbfi_rotation){sbfi_d3_add(v, sbfi_d3_cross(a.v, b.v)), a.w * b.w - sbfi_d3_dot(a.v, b.v)};
}

/* Whether the quaternion has unit length, within the rounding of three digits. */
static inline bool sbfi_is_unit(sbf_quat q) {
  return fabs((double)q.x * q.x + (double)q.y * q.y + (double)q.z * q.z + (double)q.w * q.w - 1) < 1e-3;
}

#endif
