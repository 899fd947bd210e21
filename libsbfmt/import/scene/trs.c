#include "import/scene/trs.h"

#include <math.h>

sbfi_matrix sbfi_trs_compose(const sbfi_trs *trs) {
  double x = trs->rotation[0], y = trs->rotation[1], z = trs->rotation[2], w = trs->rotation[3];
  double rotation[3][3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
      {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
      {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)},
  };
  sbfi_matrix m = sbfi_matrix_identity();
  for (int row = 0; row < 3; row++) {
    for (int column = 0; column < 3; column++) m.at[row][column] = rotation[row][column] * trs->scale[column];
    m.at[row][3] = trs->position[row];
  }
  return m;
}

static double determinant(double m[3][3]) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Uses the largest of the four components, to avoid a division by a number near 0 (Shepperd 1978). */
static void quaternion_of(double m[3][3], double q[4]) {
  double trace = m[0][0] + m[1][1] + m[2][2];
  int i = m[1][1] > m[0][0] ? 1 : 0;
  if (m[2][2] > m[i][i]) i = 2;
  if (trace >= m[i][i]) {
    q[3] = 1 + trace;
    q[0] = m[2][1] - m[1][2];
    q[1] = m[0][2] - m[2][0];
    q[2] = m[1][0] - m[0][1];
  } else {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1 + m[i][i] - m[j][j] - m[k][k];
    q[j] = m[j][i] + m[i][j];
    q[k] = m[k][i] + m[i][k];
    q[3] = m[k][j] - m[j][k];
  }
  double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int n = 0; n < 4; n++) q[n] = length > 0 ? q[n] / length : n == 3;
}

sbfi_trs sbfi_trs_decompose(const sbfi_matrix *matrix) {
  sbfi_trs trs = {.rotation = {0, 0, 0, 1}};
  double m[3][3];
  bool flat = false;
  for (int column = 0; column < 3; column++) {
    double sum = 0;
    for (int row = 0; row < 3; row++) sum += matrix->at[row][column] * matrix->at[row][column];
    trs.scale[column] = sqrt(sum);
    flat = flat || !(trs.scale[column] > 0);
    for (int row = 0; row < 3; row++) m[row][column] = matrix->at[row][column] / trs.scale[column];
    trs.position[column] = matrix->at[column][3];
  }
  if (flat) return trs;
  if (determinant(m) < 0) {
    trs.scale[0] = -trs.scale[0];
    for (int row = 0; row < 3; row++) m[row][0] = -m[row][0];
  }
  quaternion_of(m, trs.rotation);
  return trs;
}
