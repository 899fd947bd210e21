#include "turns.h"

#include <math.h>

sbf_quat turn_product(sbf_quat a, sbf_quat b) {
  return (sbf_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

sbf_quat turn_back(sbf_quat q) {
  return (sbf_quat){-q.x, -q.y, -q.z, q.w};
}

sbf_vec3 turn_cross(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

sbf_vec3 turned(sbf_quat q, sbf_vec3 v) {
  sbf_vec3 axis = {q.x, q.y, q.z}, once = turn_cross(axis, v);
  once = (sbf_vec3){2 * once.x, 2 * once.y, 2 * once.z};
  sbf_vec3 twice = turn_cross(axis, once);
  return (sbf_vec3){v.x + q.w * once.x + twice.x, v.y + q.w * once.y + twice.y, v.z + q.w * once.z + twice.z};
}

/* From the largest of its four numbers (Shepperd 1978). */
sbf_quat turn_of(float m[3][3]) {
  float t = m[0][0] + m[1][1] + m[2][2];
  if (t > 0) {
    float s = 2 * sqrtf(t + 1);
    return (sbf_quat){(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4};
  }
  if (m[0][0] > m[1][1] && m[0][0] > m[2][2]) {
    float s = 2 * sqrtf(1 + m[0][0] - m[1][1] - m[2][2]);
    return (sbf_quat){s / 4, (m[0][1] + m[1][0]) / s, (m[0][2] + m[2][0]) / s, (m[2][1] - m[1][2]) / s};
  }
  if (m[1][1] > m[2][2]) {
    float s = 2 * sqrtf(1 + m[1][1] - m[0][0] - m[2][2]);
    return (sbf_quat){(m[0][1] + m[1][0]) / s, s / 4, (m[1][2] + m[2][1]) / s, (m[0][2] - m[2][0]) / s};
  }
  float s = 2 * sqrtf(1 + m[2][2] - m[0][0] - m[1][1]);
  return (sbf_quat){(m[0][2] + m[2][0]) / s, (m[1][2] + m[2][1]) / s, s / 4, (m[1][0] - m[0][1]) / s};
}

sbf_vec3 placed_vector(const gd_transform *transform, sbf_vec3 v) {
  const float(*m)[3] = transform->basis;
  return (sbf_vec3){m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
      m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z, m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

gd_transform placed_in(const gd_transform *outer, const gd_transform *inner) {
  gd_transform made;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      made.basis[i][j] = outer->basis[i][0] * inner->basis[0][j] + outer->basis[i][1] * inner->basis[1][j] +
                         outer->basis[i][2] * inner->basis[2][j];
  sbf_vec3 arm = placed_vector(outer, inner->origin), o = outer->origin;
  made.origin = (sbf_vec3){o.x + arm.x, o.y + arm.y, o.z + arm.z};
  return made;
}

gd_transform upright(sbf_vec3 origin, float heading, float scale) {
  float c = cosf(heading) * scale, s = sinf(heading) * scale;
  return (gd_transform){{{c, 0, s}, {0, scale, 0}, {-s, 0, c}}, origin};
}

gd_transform placed_at(sbf_quat q, sbf_vec3 at) {
  float x = q.x, y = q.y, z = q.z, w = q.w;
  return (gd_transform){{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}},
      at};
}

bool transform_unscale(gd_transform *t) {
  for (int k = 0; k < 3; k++) {
    float length = sqrtf(
        t->basis[0][k] * t->basis[0][k] + t->basis[1][k] * t->basis[1][k] + t->basis[2][k] * t->basis[2][k]);
    if (!(length > 0)) return false;
    for (int i = 0; i < 3; i++) t->basis[i][k] /= length;
  }
  return true;
}
