/* Golub & Van Loan, Matrix Computations, section 8.5: the cyclic Jacobi method. */
#include "mechanics/symmetric_eigen.h"

#include <math.h>

enum { MAX_SWEEPS = 60 };

static void rotate(int n, double *matrix, double *vectors, int p, int q) {
  double apq = matrix[p * n + q];
  double theta = (matrix[q * n + q] - matrix[p * n + p]) / (2 * apq);
  double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
  double c = 1 / sqrt(t * t + 1), s = t * c;
  for (int i = 0; i < n; i++) {
    double aip = matrix[i * n + p], aiq = matrix[i * n + q];
    matrix[i * n + p] = c * aip - s * aiq;
    matrix[i * n + q] = s * aip + c * aiq;
  }
  for (int i = 0; i < n; i++) {
    double api = matrix[p * n + i], aqi = matrix[q * n + i], vip = vectors[i * n + p],
           viq = vectors[i * n + q];
    matrix[p * n + i] = c * api - s * aqi;
    matrix[q * n + i] = s * api + c * aqi;
    vectors[i * n + p] = c * vip - s * viq;
    vectors[i * n + q] = s * vip + c * viq;
  }
  matrix[p * n + q] = matrix[q * n + p] = 0;
}

void sbfi_symmetric_compute_eigen(int n, double *matrix, double *vectors) {
  double trace = 0;
  for (int i = 0; i < n * n; i++) vectors[i] = i % (n + 1) == 0;
  for (int i = 0; i < n; i++) trace += fabs(matrix[i * n + i]);
  for (int sweep = 0; sweep < MAX_SWEEPS; sweep++) {
    double off = 0;
    for (int p = 0; p < n; p++)
      for (int q = p + 1; q < n; q++) off += fabs(matrix[p * n + q]);
    if (!(off > 1e-15 * trace)) return;
    for (int p = 0; p < n; p++)
      for (int q = p + 1; q < n; q++)
        if (fabs(matrix[p * n + q]) > 1e-18 * trace) rotate(n, matrix, vectors, p, q);
  }
}
