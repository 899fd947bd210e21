/* Loops over vectors of doubles that compilers vectorize, with a fixed order of summation. */
#ifndef SBFI_VECTOR_SUMS_H
#define SBFI_VECTOR_SUMS_H

#include <stddef.h>

/* Dot product in four independent partial sums. */
static inline double sbfi_sum_of_products(const double *a, const double *b, size_t count) {
  double sums[4] = {0};
  size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (size_t k = 0; k < 4; k++) sums[k] += a[i + k] * b[i + k];
  for (; i < count; i++) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/* v -= s a. */
static inline void sbfi_subtract_scaled(
    double *restrict v, const double *restrict a, double s, size_t count) {
  size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (size_t k = 0; k < 4; k++) v[i + k] -= a[i + k] * s;
  for (; i < count; i++) v[i] -= a[i] * s;
}

#endif
