/* Volume, center and inertia of collision shapes: sums of volume integrals. */
#include <math.h>

#include "import/physics/physics.h"
#include "import/scene/trs.h"
#include "mechanics/symmetric_eigen.h"

void sbfi_moments_add(sbfi_moments *to, const sbfi_moments *local, const sbfi_matrix *to_asset) {
  const double(*m)[4] = to_asset->at;
  double scale = fabs(sbfi_matrix_determinant(to_asset)), volume = local->volume * scale;
  double first[3], turned[3][3];
  for (int r = 0; r < 3; r++) {
    first[r] = 0;
    for (int k = 0; k < 3; k++) {
      first[r] += scale * m[r][k] * local->first[k];
      turned[r][k] = 0;
      for (int i = 0; i < 3; i++) turned[r][k] += scale * m[r][i] * local->second[i][k];
    }
  }
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) {
      double second = 0;
      for (int k = 0; k < 3; k++) second += turned[r][k] * m[c][k];
      to->second[r][c] += second + first[r] * m[c][3] + m[r][3] * first[c] + volume * m[r][3] * m[c][3];
    }
  for (int r = 0; r < 3; r++) to->first[r] += first[r] + volume * m[r][3];
  to->volume += volume;
}

void sbfi_moments_conclude(const sbfi_moments *moments, sbf_vec3 *center, sbf_vec3 *inertia, sbf_quat *axes) {
  double at[3], about[9], vectors[9], trace = 0;
  for (int k = 0; k < 3; k++) at[k] = moments->first[k] / moments->volume;
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) about[3 * r + c] = -(moments->second[r][c] - moments->volume * at[r] * at[c]);
  for (int k = 0; k < 3; k++) trace -= about[4 * k];
  for (int k = 0; k < 3; k++) about[4 * k] += trace;
  sbfi_symmetric_compute_eigen(3, about, vectors);
  sbfi_matrix frame = sbfi_matrix_identity();
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) frame.at[r][c] = vectors[3 * r + c];
  if (sbfi_matrix_determinant(&frame) < 0)
    for (int r = 0; r < 3; r++) frame.at[r][2] = -frame.at[r][2];
  sbfi_trs trs = sbfi_trs_decompose(&frame);
  *center = (sbf_vec3){(float)at[0], (float)at[1], (float)at[2]};
  *inertia = (sbf_vec3){(float)about[0], (float)about[4], (float)about[8]};
  *axes = (sbf_quat){
      (float)trs.rotation[0], (float)trs.rotation[1], (float)trs.rotation[2], (float)trs.rotation[3]};
}
