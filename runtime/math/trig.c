#include "math/trig.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Nearest whole number without a library call: adding and taking away 1.5 * 2^23 rounds to even. */
static float nearest(float x) {
  volatile float magic = 12582912.0f, sum = x + magic;
  return sum - magic;
}

void sbri_sincos(float angle, float *sine, float *cosine) {
  /* Cody and Waite: pi/2 in three parts, so that the remainder keeps its bits. */
  float quadrant = nearest(angle * 0.636619772f);
  float r = angle - quadrant * 1.5703125f;
  r = r - quadrant * 4.837512969970703125e-4f;
  r = r - quadrant * 7.54978995489188216e-8f;
  float r2 = r * r;
  float s = r + r * r2 * (-1.6666654611e-1f + r2 * (8.3321608736e-3f - r2 * 1.9515295891e-4f));
  float c = 1 - 0.5f * r2 +
            r2 * r2 * (4.166664568298827e-2f + r2 * (-1.388731625493765e-3f + r2 * 2.443315711809948e-5f));
  int32_t q = (int32_t)quadrant & 3;
  float swapped_s = q & 1 ? c : s, swapped_c = q & 1 ? s : c;
  *sine = q & 2 ? -swapped_s : swapped_s;
  *cosine = (q + 1) & 2 ? -swapped_c : swapped_c;
}

/* Of 0..1. */
static float atan_unit(float t) {
  /* Above tan(pi/8), atan t = pi/4 + atan((t - 1) / (t + 1)). */
  float offset = 0;
  if (t > 0.414213562f) {
    offset = 0.785398163f;
    t = (t - 1) / (t + 1);
  }
  float t2 = t * t;
  float p = 8.05374449538e-2f;
  p = p * t2 - 1.38776856032e-1f;
  p = p * t2 + 1.99777106478e-1f;
  p = p * t2 - 3.33329491539e-1f;
  return offset + (t + t * t2 * p);
}

float sbri_atan2(float y, float x) {
  float ax = fabsf(x), ay = fabsf(y), large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  if (!(large > 0)) return 0;
  float angle = atan_unit(small / large);
  if (ay > ax) angle = 1.57079633f - angle;
  if (x < 0) angle = 3.14159265f - angle;
  return y < 0 ? -angle : angle;
}

float sbri_acos(float x) {
  float clamped = x < -1 ? -1 : x > 1 ? 1 : x;
  return sbri_atan2(sqrtf((1 - clamped) * (1 + clamped)), clamped);
}

float sbri_exp(float x) {
  if (x > 88) x = 88;
  if (!(x >= -87)) return 0;
  float n = nearest(x * 1.44269504f);
  float r = x - n * 0.693359375f;
  r = r + n * 2.12194440e-4f;
  float p = 1.9875691500e-4f;
  p = p * r + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;
  float e = 1 + r + r * r * p;
  uint32_t bits = (uint32_t)((int32_t)n + 127) << 23;
  float power;
  memcpy(&power, &bits, sizeof power);
  return e * power;
}
