/* Symmetric 6x6 matrices: mass matrix of a body, with attached bodies. Lower halves. Double precision,
 * because single precision would lose a light body between heavy ones. */
#ifndef SBRI_SYM6_H
#define SBRI_SYM6_H

#include <math.h>

/* A = L L^T in place, with inverse pivots on the diagonal. A pivot that is lost in rounding gets the inverse
 * 0: that motion is blocked. */
static inline void sbri_sym6_factor(double a[6][6]) {
  for (int k = 0; k < 6; k++) {
    double pivot = a[k][k], inverse = 0;
    for (int j = 0; j < k; j++) pivot -= a[k][j] * a[k][j];
    if (pivot > 1e-15 * a[k][k]) inverse = 1 / sqrt(pivot);
    for (int i = k + 1; i < 6; i++) {
      double sum = a[i][k];
      for (int j = 0; j < k; j++) sum -= a[i][j] * a[k][j];
      a[i][k] = sum * inverse;
    }
    a[k][k] = inverse;
  }
}

/* L y = b, in place. */
static inline void sbri_sym6_solve_forward(double l[6][6], double b[6]) {
  for (int i = 0; i < 6; i++) {
    double sum = b[i];
    for (int j = 0; j < i; j++) sum -= l[i][j] * b[j];
    b[i] = sum * l[i][i];
  }
}

/* L^T x = y, in place. */
static inline void sbri_sym6_solve_back(double l[6][6], double y[6]) {
  for (int i = 5; i >= 0; i--) {
    double sum = y[i];
    for (int j = i + 1; j < 6; j++) sum -= l[j][i] * y[j];
    y[i] = sum * l[i][i];
  }
}

static inline double sbri_dot6(const double a[6], const double b[6]) {
  return ((a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])) + (a[4] * b[4] + a[5] * b[5]);
}

/* The same for the rates of a row. */
static inline double sbri_dot6_rates(const float a[6], const double b[6]) {
  return ((a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])) + (a[4] * b[4] + a[5] * b[5]);
}

static inline void sbri_add6_rates(double to[6], const float a[6], double s) {
  for (int i = 0; i < 6; i++) to[i] += a[i] * s;
}

static inline void sbri_add6(double to[6], const double a[6], double s) {
  for (int i = 0; i < 6; i++) to[i] += a[i] * s;
}

#endif
