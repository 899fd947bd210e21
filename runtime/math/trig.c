/* Reductions: quarter turns for sine and cosine; thirds of the first octant for the arctangent; powers of two
 * for the exponential. The series then converge within single precision in six to eight terms. */
#include "math/trig.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static const double quarter_turn = 1.57079632679489661923;
static const double quarter_turn_rest = 6.123233995736766036e-17; /* pi/2 less the constant above */

/* The nearest integer, halves away from 0; |x| < 2^62. */
static int64_t nearest(double x) {
  return (int64_t)(x < 0 ? x - 0.5 : x + 0.5);
}

/* Both for |x| <= pi/4. */
static double sine_series(double x) {
  double s = x * x;
  return x * (1 + s * (-1.0 / 6 +
                          s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880 + s * (-1.0 / 39916800))))));
}
static double cosine_series(double x) {
  double s = x * x;
  return 1 + s * (-0.5 + s * (1.0 / 24 + s * (-1.0 / 720 +
                                                 s * (1.0 / 40320 + s * (-1.0 / 3628800 + s / 479001600)))));
}

void sbri_sincos(float angle, float *sine, float *cosine) {
  double x = angle;
  if (x == 0) { /* x = 0 without rounding */
    *sine = angle, *cosine = 1;
    return;
  }
  if (fabs(x) > 1e9) x = 0;
  if (x != x) {
    *sine = *cosine = angle;
    return;
  }
  int64_t quarters = nearest(x / quarter_turn);
  double r = (x - (double)quarters * quarter_turn) - (double)quarters * quarter_turn_rest;
  double s = sine_series(r), c = cosine_series(r);
  switch (quarters & 3) {
  case 0:
    *sine = (float)s, *cosine = (float)c;
    break;
  case 1:
    *sine = (float)c, *cosine = (float)-s;
    break;
  case 2:
    *sine = (float)-s, *cosine = (float)-c;
    break;
  default:
    *sine = (float)-c, *cosine = (float)s;
    break;
  }
}

/* 0 <= x <= 1 */
static double arctangent(double x) {
  const double root3 = 1.73205080756887729353, sixth = 0.52359877559829887308;
  double base = 0;
  if (x > 0.26794919243112270647) { /* tan(pi/12) */
    x = (x * root3 - 1) / (root3 + x);
    base = sixth;
  }
  double s = x * x;
  double series =
      1 + s * (-1.0 / 3 +
                  s * (0.2 + s * (-1.0 / 7 +
                                     s * (1.0 / 9 +
                                             s * (-1.0 / 11 + s * (1.0 / 13 + s * (-1.0 / 15 + s / 17)))))));
  return base + x * series;
}

static double arctangent2(double y, double x) {
  double ax = fabs(x), ay = fabs(y);
  if (x != x || y != y) return x + y;
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? arctangent(ax > DBL_MAX ? (ay > DBL_MAX ? 1 : 0) : ay / ax)
                          : quarter_turn - arctangent(ay > DBL_MAX ? 0 : ax / ay);
  if (x < 0) angle = 2 * quarter_turn - angle;
  return y < 0 ? -angle : angle;
}

float sbri_atan2(float y, float x) {
  return (float)arctangent2(y, x);
}

float sbri_acos(float x) {
  double v = x > 1 ? 1 : x < -1 ? -1 : x;
  return (float)arctangent2(sqrt((1 - v) * (1 + v)), v);
}

float sbri_exp(float x) {
  if (x != x) return x;
  if (x < -87.0f) return 0;
  if (x > 88.7f) return FLT_MAX;
  const double ln2 = 0.69314718055994530942;
  int64_t power = nearest(x / ln2);
  double r = x - (double)power * ln2, term = 1, sum = 1;
  for (int i = 1; i <= 11; i++) {
    term *= r / i;
    sum += term;
  }
  uint64_t bits = (uint64_t)(power + 1023) << 52;
  double two_to_power;
  memcpy(&two_to_power, &bits, sizeof two_to_power);
  return (float)(sum * two_to_power);
}

float sbri_log(float x) {
  if (x != x) return x;
  if (!(x > 0)) return -87;
  if (x > FLT_MAX) return x;
  const double ln2 = 0.69314718055994530942, root2 = 1.41421356237309504880;
  double value = x;
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  int64_t power = (int64_t)(bits >> 52) - 1023;
  bits = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1023) << 52;
  memcpy(&value, &bits, sizeof value);
  if (value > root2) value *= 0.5, power++;
  /* 2 artanh((v - 1) / (v + 1)), |argument| below 0.172 */
  double s = (value - 1) / (value + 1), square = s * s, sum = 0;
  for (int i = 17; i >= 1; i -= 2) sum = sum * square + 1.0 / i;
  return (float)((double)power * ln2 + 2 * s * sum);
}

float sbri_angle_between(float a, float b) {
  const float turn = 6.28318530717958647692f;
  float difference = a - b;
  if (difference > 0.5f * turn) return difference - turn;
  return difference < -0.5f * turn ? difference + turn : difference;
}
