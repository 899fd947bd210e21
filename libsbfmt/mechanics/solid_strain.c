#include "mechanics/solid_strain.h"

#include <math.h>

#include "mechanics/symmetric_eigen.h"

/* An element flatter than this fraction of its rest height does not flow. */
static const double MIN_STRETCH = 0.01;

/* base^exponent, base > 0 and |exponent| <= 1: repeated square roots bring the base near 1, then series
 * for logarithm and exponential. */
static double power(double base, double exponent) {
  double root = base, factor = 2, term, sum = 0, result = 1;
  for (int i = 0; i < 40 && fabs(root - 1) > 0.02; i++) root = sqrt(root), factor *= 2;
  double t = (root - 1) / (root + 1);
  term = t;
  for (int k = 1; k < 20; k += 2, term *= t * t) sum += term / k;
  double left = factor * sum * exponent;
  int halvings = 0;
  for (; fabs(left) > 0.1; left *= 0.5) halvings++;
  term = 1;
  for (int k = 1; k < 12; k++) term *= left / k, result += term;
  for (; halvings > 0; halvings--) result *= result;
  return result;
}

bool sbfi_stretches_find(const sbfi_solid_metric *metric, const sbfi_d3 edges[3], sbfi_stretches *found) {
  /* L with metric = L L^T; the columns of D L have F_e's lengths and angles. */
  const double *m = metric->at;
  if (!(m[0] > 0)) return false;
  double l00 = sqrt(m[0]), l10 = m[3] / l00, l20 = m[5] / l00, square = m[1] - l10 * l10;
  if (!(square > 0)) return false;
  double l11 = sqrt(square), l21 = (m[4] - l20 * l10) / l11;
  square = m[2] - l20 * l20 - l21 * l21;
  if (!(square > 0)) return false;
  const double l[3][3] = {{l00, 0, 0}, {l10, l11, 0}, {l20, l21, sqrt(square)}};
  sbfi_d3 columns[3];
  double squares[9], vectors[9];
  for (int c = 0; c < 3; c++) {
    columns[c] = sbfi_d3_scale(edges[0], l[0][c]);
    for (int r = 1; r < 3; r++) columns[c] = sbfi_d3_add(columns[c], sbfi_d3_scale(edges[r], l[r][c]));
  }
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) squares[3 * i + k] = sbfi_d3_dot(columns[i], columns[k]);
  sbfi_symmetric_compute_eigen(3, squares, vectors);
  int min = 0;
  for (int k = 0; k < 3; k++) {
    double value = squares[4 * k];
    found->values[k] = value > 0 ? sqrt(value) : 0;
    if (found->values[k] < found->values[min]) min = k;
    for (int j = 0; j < 3; j++) {
      found->directions[k][j] = 0;
      for (int c = 0; c < 3; c++) found->directions[k][j] += l[j][c] * vectors[3 * c + k];
    }
  }
  if (sbfi_d3_dot(edges[0], sbfi_d3_cross(edges[1], edges[2])) < 0) found->values[min] = -found->values[min];
  return true;
}

bool sbfi_solid_flow(
    const sbfi_stretches *stretches, double yield_strain, double fraction, sbfi_solid_metric *metric) {
  double grown[3], product = 1;
  bool beyond = false;
  for (int k = 0; k < 3; k++) {
    double value = stretches->values[k], bound = value;
    if (!(value > MIN_STRETCH)) return false;
    if (value > 1 + yield_strain) bound = 1 + yield_strain;
    if (value < 1 - yield_strain) bound = 1 - yield_strain;
    beyond = beyond || bound != value;
    grown[k] = bound != value ? power(value / bound, fraction) : 1;
    product *= grown[k];
  }
  if (!beyond) return false;
  double even = power(product, 1.0 / 3);
  static const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  for (int i = 0; i < 6; i++) {
    metric->at[i] = 0;
    for (int k = 0; k < 3; k++) {
      double r = grown[k] / even;
      const double *q = stretches->directions[k];
      metric->at[i] += q[pairs[i][0]] * q[pairs[i][1]] / (r * r);
    }
  }
  return true;
}
