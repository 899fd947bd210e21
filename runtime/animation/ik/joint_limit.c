#include "animation/ik/joint_limit.h"

static const float PI = 3.14159265f;
static const float MAX_TWIST = 3.1f; /* rad: a bound beyond this needs arctangents */
static const float SLACK = 1e-5f;    /* rad: tolerance of clamped angles against rounding */

sbri_swing_twist sbri_swing_twist_of(sbf_quat q) {
  float sign = q.w < 0 ? -1.0f : 1.0f;
  q = (sbf_quat){sign * q.x, sign * q.y, sign * q.z, sign * q.w};
  float size = sqrtf(q.x * q.x + q.w * q.w);
  sbri_swing_twist parts = {0, 0, 0};
  if (size < 1e-9f) { /* swing of half a turn: the twist is undefined */
    float half_turn = PI / sqrtf(q.y * q.y + q.z * q.z + 1e-30f);
    parts.swing_y = q.y * half_turn, parts.swing_z = q.z * half_turn;
    return parts;
  }
  float x = q.x / size, w = q.w / size;
  parts.twist = 2 * sbri_atan2(x, w);
  if (parts.twist > PI) parts.twist -= 2 * PI;
  if (parts.twist <= -PI) parts.twist += 2 * PI;
  /* S = Q T^-1; its x is 0 and its w is `size`. */
  float y = w * q.y - x * q.z, z = w * q.z + x * q.y;
  float sine = sqrtf(y * y + z * z);
  float rate = sine < 1e-7f ? 2 : 2 * sbri_atan2(sine, size) / sine;
  parts.swing_y = y * rate, parts.swing_z = z * rate;
  return parts;
}

sbf_quat sbri_swing_twist_join(sbri_swing_twist parts) {
  sbf_quat swing = sbri_quat_exp(sbri_vec3(0, parts.swing_y, parts.swing_z));
  return sbri_quat_multiply(swing, sbri_quat_about(sbri_vec3(1, 0, 0), parts.twist));
}

/* Distance of `angle` from the range; `bound` receives the nearer bound, on the circle. */
static float outside(float angle, const float range[2], float *bound) {
  if (angle >= range[0] && angle <= range[1]) return 0;
  float below = range[0] - angle, above = angle - range[1];
  if (below < 0) below += 2 * PI;
  if (above < 0) above += 2 * PI;
  *bound = below < above ? range[0] : range[1];
  return below < above ? below : above;
}

static sbf_quat seen_as(const sbri_joint_limit *limit, sbf_quat local) {
  return sbri_quat_multiply(sbri_quat_multiply(limit->before, local), limit->after);
}

static sbri_swing_twist seen(const sbri_joint_limit *limit, sbf_quat local) {
  return sbri_swing_twist_of(seen_as(limit, local));
}

/* Tangent of half an angle below half a turn. */
static float half_tangent(float angle) {
  float s, c;
  sbri_sincos(0.5f * sbri_clamp(angle, -MAX_TWIST, MAX_TWIST), &s, &c);
  return s / c;
}

void sbri_joint_limit_ready(sbri_joint_limit *limit) {
  float s, c, spare = 0.5f * SLACK;
  const float *y = limit->swing_y, *z = limit->swing_z;
  limit->twist_tangents[0] = half_tangent(limit->twist[0] - spare);
  limit->twist_tangents[1] = half_tangent(limit->twist[1] + spare);
  sbri_sincos(0.5f * sbri_clamp(limit->cone + spare, 0, PI), &s, &c);
  limit->cone_square = y[0] <= 0 && y[1] >= 0 && z[0] <= 0 && z[1] >= 0 ? s * s : 0;
}

/* Sufficient test that q is within the limit, or beyond it by at most half of the tolerance. With s the sine
 * of half the swing angle, 1 <= asin(s) / s <= 1 + (pi/2 - 1) s^2, since its series has no negative term.
 * False means nothing. */
static bool is_surely_within(const sbri_joint_limit *limit, sbf_quat q) {
  float size2 = q.x * q.x + q.w * q.w, sine2 = q.y * q.y + q.z * q.z;
  if (sine2 > limit->cone_square || size2 < 0.1f) return false;
  float sign = q.w < 0 ? -1.0f : 1.0f, x = sign * q.x, w = sign * q.w;
  if (x < limit->twist_tangents[0] * w || x > limit->twist_tangents[1] * w) return false;
  /* Upper bounds of the swing's y and z; all multiplied by the root of size2. */
  float rate = 2 + 1.1416f * sine2, size = sqrtf(size2), spare = 0.5f * SLACK;
  float y = rate * (q.w * q.y - q.x * q.z), z = rate * (q.w * q.z + q.x * q.y);
  return y >= size * (limit->swing_y[0] - spare) && y <= size * (limit->swing_y[1] + spare) &&
         z >= size * (limit->swing_z[0] - spare) && z <= size * (limit->swing_z[1] + spare);
}

static float larger(float a, float b) {
  return a > b ? a : b;
}

float sbri_joint_limit_excess(const sbri_joint_limit *limit, sbf_quat local) {
  if (!limit || !limit->active) return 0;
  sbri_swing_twist p = seen(limit, local);
  float unused, swing = sqrtf(p.swing_y * p.swing_y + p.swing_z * p.swing_z);
  float max = larger(0, swing - limit->cone);
  max = larger(max, outside(p.twist, limit->twist, &unused));
  max = larger(max, outside(p.swing_y, limit->swing_y, &unused));
  return larger(max, outside(p.swing_z, limit->swing_z, &unused));
}

bool sbri_joint_limit_holds(const sbri_joint_limit *limit, sbf_quat local, float slack) {
  if (!limit || !limit->active || is_surely_within(limit, seen_as(limit, local))) return true;
  return sbri_joint_limit_excess(limit, local) <= slack;
}

sbf_quat sbri_joint_limit_clamp(const sbri_joint_limit *limit, sbf_quat local) {
  if (sbri_joint_limit_holds(limit, local, SLACK)) return local;
  sbri_swing_twist p = seen(limit, local);
  (void)outside(p.twist, limit->twist, &p.twist);
  p.swing_y = sbri_clamp(p.swing_y, limit->swing_y[0], limit->swing_y[1]);
  p.swing_z = sbri_clamp(p.swing_z, limit->swing_z[0], limit->swing_z[1]);
  float swing = sqrtf(p.swing_y * p.swing_y + p.swing_z * p.swing_z);
  if (swing > limit->cone) { /* a box without 0 has priority over the cone */
    float fraction = limit->cone / swing;
    p.swing_y = sbri_clamp(p.swing_y * fraction, limit->swing_y[0], limit->swing_y[1]);
    p.swing_z = sbri_clamp(p.swing_z * fraction, limit->swing_z[0], limit->swing_z[1]);
  }
  sbf_quat q = sbri_quat_multiply(sbri_quat_conjugate(limit->before), sbri_swing_twist_join(p));
  return sbri_quat_normalize(sbri_quat_multiply(q, sbri_quat_conjugate(limit->after)));
}
