#include "math/follower.h"

static const float TWO_PI = 6.28318531f;

sbri_follower_step sbri_follower_step_of(float f, float z, float r, float h) {
  float w = TWO_PI * f, angle = w * h, root2 = 1 - z * z;
  float cosine, sine; /* C and w S, times E = exp(-z w h) */
  if (root2 > 1e-6f) {
    float root = sqrtf(root2), s, c, decay = sbri_exp(-z * angle);
    sbri_sincos(root * angle, &s, &c);
    cosine = decay * c, sine = decay * s / root;
  } else if (root2 > -1e-6f) {
    float decay = sbri_exp(-z * angle);
    cosine = decay, sine = decay * angle;
  } else { /* two decays; the exponent of the slower one is z - root without cancellation */
    float root = sqrtf(-root2), slow = sbri_exp(-angle / (z + root)), fast = sbri_exp(-angle * (z + root));
    cosine = 0.5f * (slow + fast), sine = 0.5f * (slow - fast) / root;
  }
  return (sbri_follower_step){.a = cosine + z * sine,
      .b = sine / w,
      .c = -w * sine,
      .d = cosine - z * sine,
      .ahead_s = (r - 2) * z / w,
      .h = h};
}

void sbri_lag_tick(sbri_lag *lag, float target, const sbri_follower_step *step) {
  float e = lag->value - target, rate = lag->rate;
  lag->value = target + step->a * e + step->b * rate;
  lag->rate = step->c * e + step->d * rate;
}

void sbri_position_follower_reset(sbri_position_follower *f, sbf_vec3 at) {
  *f = (sbri_position_follower){at, {0, 0, 0}, at};
}

void sbri_position_follower_tick(sbri_position_follower *f, sbf_vec3 target, const sbri_follower_step *s) {
  if (s->h <= 0) return;
  sbf_vec3 speed = sbri_scale(sbri_sub(target, f->followed), 1 / s->h), ahead = sbri_scale(speed, s->ahead_s);
  sbf_vec3 e = sbri_sub(sbri_sub(f->value, f->followed), ahead), de = sbri_sub(f->rate, speed);
  sbf_vec3 next = sbri_add(sbri_scale(e, s->a), sbri_scale(de, s->b));
  f->rate = sbri_add(speed, sbri_add(sbri_scale(e, s->c), sbri_scale(de, s->d)));
  f->value = sbri_add(target, sbri_add(next, ahead));
  f->followed = target;
}

void sbri_rotation_follower_reset(sbri_rotation_follower *f, sbf_quat at) {
  *f = (sbri_rotation_follower){at, {0, 0, 0}, at};
}

void sbri_rotation_follower_tick(sbri_rotation_follower *f, sbf_quat target, const sbri_follower_step *s) {
  if (s->h <= 0) return;
  sbf_quat moved = sbri_quat_multiply(target, sbri_quat_conjugate(f->followed));
  sbf_quat off = sbri_quat_multiply(f->value, sbri_quat_conjugate(f->followed));
  sbf_vec3 speed = sbri_scale(sbri_quat_log(moved), 1 / s->h), ahead = sbri_scale(speed, s->ahead_s);
  sbf_vec3 e = sbri_sub(sbri_quat_log(off), ahead), de = sbri_sub(f->rate, speed);
  sbf_vec3 next = sbri_add(sbri_add(sbri_scale(e, s->a), sbri_scale(de, s->b)), ahead);
  f->rate = sbri_add(speed, sbri_add(sbri_scale(e, s->c), sbri_scale(de, s->d)));
  f->value = sbri_quat_normalize(sbri_quat_multiply(sbri_quat_exp(next), target));
  f->followed = target;
}
