#include "mechanics/neo_hookean.h"

#include "mechanics/symmetric_eigen.h"

bool sbfi_tetrahedron_make(sbfi_tetrahedron *made, const sbfi_d3 rest[4], sbfi_lame lame) {
  sbfi_d3 a = sbfi_d3_sub(rest[1], rest[0]), b = sbfi_d3_sub(rest[2], rest[0]),
          c = sbfi_d3_sub(rest[3], rest[0]);
  double determinant = sbfi_d3_dot(a, sbfi_d3_cross(b, c));
  made->volume = determinant / 6;
  made->lame = lame;
  if (!(determinant > 0)) return false;
  made->gradients[1] = sbfi_d3_scale(sbfi_d3_cross(b, c), 1 / determinant);
  made->gradients[2] = sbfi_d3_scale(sbfi_d3_cross(c, a), 1 / determinant);
  made->gradients[3] = sbfi_d3_scale(sbfi_d3_cross(a, b), 1 / determinant);
  made->gradients[0] =
      sbfi_d3_scale(sbfi_d3_add(sbfi_d3_add(made->gradients[1], made->gradients[2]), made->gradients[3]), -1);
  return true;
}

double sbfi_tetrahedron_volume_ratio(const sbfi_tetrahedron *t, const sbfi_d3 x[4]) {
  sbfi_columns f = sbfi_tetrahedron_gradient(t, x);
  return sbfi_determinant(&f);
}

/* lambda (J - gamma): the pressure-like factor of cof F. */
static double tension(const sbfi_tetrahedron *t, double j) {
  return t->lame.lambda * (j - 1) - t->lame.mu;
}

/* Uses H = F - 1 to avoid cancellation at small strains: J - 1 = tr H + h + det H with h the sum of H's
 * principal minors; the terms with only tr H cancel. */
double sbfi_tetrahedron_energy(const sbfi_tetrahedron *t, const sbfi_d3 x[4]) {
  sbfi_columns f = sbfi_tetrahedron_gradient(t, x);
  f.at[0].x -= 1, f.at[1].y -= 1, f.at[2].z -= 1;
  double squares = 0, determinant = sbfi_determinant(&f);
  for (int k = 0; k < 3; k++) squares += sbfi_d3_dot(f.at[k], f.at[k]);
  double minors = f.at[0].x * f.at[1].y - f.at[1].x * f.at[0].y + f.at[1].y * f.at[2].z -
                  f.at[2].y * f.at[1].z + f.at[2].z * f.at[0].x - f.at[0].z * f.at[2].x;
  double more = f.at[0].x + f.at[1].y + f.at[2].z + minors + determinant;
  double deviation = 0.5 * squares - minors - determinant;
  return t->volume * (t->lame.mu * deviation + 0.5 * t->lame.lambda * more * more);
}

void sbfi_tetrahedron_compute_forces(const sbfi_tetrahedron *t, const sbfi_d3 x[4], sbfi_d3 forces[4]) {
  sbfi_columns f = sbfi_tetrahedron_gradient(t, x), cofactors = sbfi_cofactors(&f), p;
  double s = tension(t, sbfi_d3_dot(f.at[0], cofactors.at[0]));
  for (int k = 0; k < 3; k++)
    p.at[k] = sbfi_d3_add(sbfi_d3_scale(f.at[k], t->lame.mu), sbfi_d3_scale(cofactors.at[k], s));
  for (int i = 1; i < 4; i++) forces[i] = sbfi_d3_scale(sbfi_columns_times(&p, t->gradients[i]), -t->volume);
  forces[0] = sbfi_d3_scale(sbfi_d3_add(sbfi_d3_add(forces[1], forces[2]), forces[3]), -1);
}

void sbfi_tetrahedron_product(
    const sbfi_tetrahedron *t, const sbfi_d3 x[4], const sbfi_d3 u[4], sbfi_d3 products[4]) {
  sbfi_columns f = sbfi_tetrahedron_gradient(t, x), d = sbfi_tetrahedron_gradient(t, u), p;
  sbfi_columns cofactors = sbfi_cofactors(&f);
  double s = tension(t, sbfi_d3_dot(f.at[0], cofactors.at[0])), change = 0;
  for (int k = 0; k < 3; k++) change += sbfi_d3_dot(cofactors.at[k], d.at[k]);
  for (int k = 0; k < 3; k++) {
    int m = (k + 1) % 3, n = (k + 2) % 3;
    sbfi_d3 turned = sbfi_d3_add(sbfi_d3_cross(d.at[m], f.at[n]), sbfi_d3_cross(f.at[m], d.at[n]));
    p.at[k] = sbfi_d3_add(sbfi_d3_add(sbfi_d3_scale(d.at[k], t->lame.mu), sbfi_d3_scale(turned, s)),
        sbfi_d3_scale(cofactors.at[k], t->lame.lambda * change));
  }
  for (int i = 1; i < 4; i++) products[i] = sbfi_d3_scale(sbfi_columns_times(&p, t->gradients[i]), t->volume);
  products[0] = sbfi_d3_scale(sbfi_d3_add(sbfi_d3_add(products[1], products[2]), products[3]), -1);
}

/* Block of corners i and j: mu g_i.g_j 1 + lambda c_i c_j^T + s d^2 J / dx_i dx_j with c = cof F g. The
 * last term is u -> u x F (g_i x g_j): set g_i = a x b in cof F (a x b) = F a x F b and vary F by u g_j^T. */
void sbfi_tetrahedron_compute_hessian(const sbfi_tetrahedron *t, const sbfi_d3 x[4], double blocks[4][4][9]) {
  sbfi_columns f = sbfi_tetrahedron_gradient(t, x), cofactors = sbfi_cofactors(&f);
  double s = tension(t, sbfi_d3_dot(f.at[0], cofactors.at[0])), v = t->volume;
  sbfi_d3 c[4];
  for (int i = 0; i < 4; i++) c[i] = sbfi_columns_times(&cofactors, t->gradients[i]);
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) {
      double *block = blocks[i][j], along = v * t->lame.mu * sbfi_d3_dot(t->gradients[i], t->gradients[j]);
      sbfi_d3 w =
          sbfi_d3_scale(sbfi_columns_times(&f, sbfi_d3_cross(t->gradients[i], t->gradients[j])), v * s);
      const double ci[3] = {c[i].x, c[i].y, c[i].z}, cj[3] = {c[j].x, c[j].y, c[j].z};
      for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
          block[3 * row + column] = v * t->lame.lambda * ci[row] * cj[column] + (row == column ? along : 0);
      block[1] += w.z, block[3] -= w.z;
      block[2] -= w.y, block[6] += w.y;
      block[5] += w.x, block[7] -= w.x;
    }
}

sbfi_strains sbfi_tetrahedron_strains(const sbfi_tetrahedron *t, const sbfi_d3 x[4]) {
  sbfi_columns f = sbfi_tetrahedron_gradient(t, x);
  double squares[9], vectors[9];
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) squares[3 * i + k] = sbfi_d3_dot(f.at[i], f.at[k]);
  sbfi_symmetric_compute_eigen(3, squares, vectors);
  int min = 0;
  for (int i = 1; i < 3; i++)
    if (squares[4 * i] < squares[4 * min]) min = i;
  sbfi_strains strains = {0, -1};
  for (int i = 0; i < 3; i++) {
    double value = sqrt(squares[4 * i] > 0 ? squares[4 * i] : 0);
    if (i == min && sbfi_determinant(&f) < 0) value = -value; /* inverted along that axis */
    if (fabs(value - 1) > strains.max) strains.max = fabs(value - 1);
    if (value - 1 > strains.stretch) strains.stretch = value - 1;
  }
  return strains;
}
