#include "motion/quatd.h"

#include <math.h>
#include <string.h>

#include "mechanics/angle.h"

void sbfi_quatd_multiply(const double a[4], const double b[4], double to[4]) {
  const double p[4] = {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
      a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
      a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
      a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  memcpy(to, p, sizeof p);
}

void sbfi_quatd_conjugate(const double a[4], double to[4]) {
  for (int k = 0; k < 4; k++) to[k] = k < 3 ? -a[k] : a[k];
}

void sbfi_quatd_rotate(const double a[4], const double v[3], double to[3]) {
  const double pure[4] = {v[0], v[1], v[2], 0};
  double back[4], p[4];
  sbfi_quatd_conjugate(a, back);
  sbfi_quatd_multiply(a, pure, p);
  sbfi_quatd_multiply(p, back, p);
  memcpy(to, p, 3 * sizeof *p);
}

void sbfi_quatd_between(const double from[3], const double to[3], double rotation[4]) {
  double dot = from[0] * to[0] + from[1] * to[1] + from[2] * to[2], length = 0;
  if (dot < -0.999999) { /* opposite: about any perpendicular axis */
    const double spare[3] = {fabs(from[0]) < 0.9, fabs(from[0]) >= 0.9, 0};
    rotation[0] = from[1] * spare[2] - from[2] * spare[1];
    rotation[1] = from[2] * spare[0] - from[0] * spare[2];
    rotation[2] = from[0] * spare[1] - from[1] * spare[0];
    rotation[3] = 0;
  } else {
    rotation[0] = from[1] * to[2] - from[2] * to[1];
    rotation[1] = from[2] * to[0] - from[0] * to[2];
    rotation[2] = from[0] * to[1] - from[1] * to[0];
    rotation[3] = 1 + dot;
  }
  for (int k = 0; k < 4; k++) length += rotation[k] * rotation[k];
  for (int k = 0; k < 4; k++) rotation[k] /= sqrt(length);
}

/* For 0 <= x <= pi / 2. */
static double sine(double x) {
  double term = x, sum = x;
  for (int k = 2; k <= 20; k += 2) {
    term *= -x * x / (k * (k + 1));
    sum += term;
  }
  return sum;
}

void sbfi_quatd_slerp(const double a[4], const double b[4], double t, double to[4]) {
  double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  double sign = dot < 0 ? -1 : 1, from_a = 1 - t, from_b = t, length = 0;
  dot *= sign;
  if (dot < 1 - 1e-9) {
    double across = sqrt((1 - dot) * (1 + dot)), angle = sbfi_angle(across, dot);
    from_a = sine((1 - t) * angle) / across;
    from_b = sine(t * angle) / across;
  }
  for (int i = 0; i < 4; i++) {
    to[i] = from_a * a[i] + sign * from_b * b[i];
    length += to[i] * to[i];
  }
  length = sqrt(length);
  for (int i = 0; i < 4; i++) to[i] = length > 0 ? to[i] / length : i == 3;
}
