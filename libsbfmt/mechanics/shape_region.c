#include "mechanics/shape_region.h"

#include "mechanics/symmetric_eigen.h"

sbfi_d3 sbfi_region_center(const double *weights, const sbfi_d3 *positions, size_t count) {
  sbfi_d3 sum = {0, 0, 0};
  double whole = 0;
  for (size_t i = 0; i < count; i++) {
    sum = sbfi_d3_add(sum, sbfi_d3_scale(positions[i], weights[i]));
    whole += weights[i];
  }
  return sbfi_d3_scale(sum, 1 / whole);
}

/* Columns of the rotation of a unit quaternion, real part first. */
static void columns_of(const double q[4], sbfi_d3 columns[3]) {
  double w = q[0], x = q[1], y = q[2], z = q[3];
  columns[0] = (sbfi_d3){1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  columns[1] = (sbfi_d3){2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
  columns[2] = (sbfi_d3){2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}

void sbfi_region_add(sbfi_region_sums *sums, double weight, sbfi_d3 offset, sbfi_d3 position) {
  const double r[3] = {offset.x, offset.y, offset.z}, x[3] = {position.x, position.y, position.z};
  sums->weight += weight;
  sums->position = sbfi_d3_add(sums->position, sbfi_d3_scale(position, weight));
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) sums->moments[3 * a + b] += weight * r[a] * x[b];
}

sbfi_region_fit sbfi_region_fit_of(const sbfi_region_sums *sums) {
  sbfi_region_fit fit = {.center = sbfi_d3_scale(sums->position, 1 / sums->weight)};
  double s[3][3];
  for (int i = 0; i < 9; i++) s[i / 3][i % 3] = sums->moments[i];
  double m[16] = {s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0],
      s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2], s[2][0] - s[0][2],
      s[0][1] + s[1][0], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1], s[0][1] - s[1][0], s[2][0] + s[0][2],
      s[1][2] + s[2][1], s[2][2] - s[0][0] - s[1][1]};
  double vectors[16], q[4];
  sbfi_symmetric_compute_eigen(4, m, vectors);
  int best = 0;
  for (int i = 1; i < 4; i++)
    if (m[5 * i] > m[5 * best]) best = i;
  for (int i = 0; i < 4; i++) q[i] = vectors[4 * i + best];
  columns_of(q, fit.columns);
  return fit;
}

sbfi_d3 sbfi_region_goal(const sbfi_region_fit *fit, sbfi_d3 offset) {
  sbfi_d3 rotated = sbfi_d3_add(
      sbfi_d3_add(sbfi_d3_scale(fit->columns[0], offset.x), sbfi_d3_scale(fit->columns[1], offset.y)),
      sbfi_d3_scale(fit->columns[2], offset.z));
  return sbfi_d3_add(fit->center, rotated);
}
