/* Neo-Hookean tetrahedron in double precision: the reference for all schemes, the tests and `build`. The
 * schemes' own kernels (runtime/soft/solvers) process eight lanes in single precision and are tested against
 * it.
 *
 * With F the deformation gradient, J = det F, V the rest volume in m^3, and E in Pa and nu for small strains,
 *
 *   U = V (mu/2 (F:F - 3) + lambda/2 (J - gamma)^2 - mu^2 / (2 lambda))
 *   mu = E / (2 (1 + nu)),   lambda = E / (2 (1 + nu) (1 - 2 nu)),   gamma = 1 + mu / lambda
 *
 * This is Smith, de Goes and Kim, Stable Neo-Hookean Flesh Simulation, ACM Transactions on Graphics 37 (2),
 * 2018, without the logarithm of their equation 14, with which the rest state has no closed form. Their
 * reparametrization lambda = lambda_Lame + mu and gamma above make F = 1 the rest state and the second
 * derivatives there exactly Hooke's law with E and nu. U is a polynomial in the positions, finite and smooth
 * for inverted elements. The logarithm would make F = 0 a saddle. Without it an element shrunk equally along
 * all three axes below the ratio a with lambda a (1 + a + a^2) = mu (a sixth for nu = 0.4) collapses to a
 * point. Flat, inverted and randomly deformed elements recover.
 *
 * F = sum_i x_i g_i^T with g_i the gradients of the four linear shape functions at rest, P = dU/dF / V = mu F
 * + lambda (J - gamma) cof F, and the force on corner i is -V P g_i. J is linear in each corner, so the
 * diagonal block of second derivatives of a corner, V (mu |g|^2 1 + lambda (cof F g)(cof F g)^T), is
 * positive definite in every state. */
#ifndef SBFI_NEO_HOOKEAN_H
#define SBFI_NEO_HOOKEAN_H

#include "mechanics/vector.h"

typedef struct sbfi_lame {
  double mu, lambda; /* Pa, as above: lambda is Lame's first parameter plus mu */
} sbfi_lame;

/* `young_pa` above 0, `poisson` in (-1, 0.5). */
static inline sbfi_lame sbfi_lame_of(double young_pa, double poisson) {
  return (sbfi_lame){young_pa / (2 * (1 + poisson)), young_pa / (2 * (1 + poisson) * (1 - 2 * poisson))};
}

typedef struct sbfi_tetrahedron {
  sbfi_d3 gradients[4]; /* 1/m, of the shape functions at rest; they sum to 0 */
  double volume;        /* m^3 at rest */
  sbfi_lame lame;
} sbfi_tetrahedron;

/* A 3 x 3 matrix by columns. */
typedef struct sbfi_columns {
  sbfi_d3 at[3];
} sbfi_columns;

/* From the rest positions of the corners; false if the tetrahedron is flat or inverted (then volume is not
 * above 0 and nothing else is set). */
bool sbfi_tetrahedron_make(sbfi_tetrahedron *made, const sbfi_d3 rest[4], sbfi_lame lame);

/* sum_i v_i g_i^T: F for positions, dF for displacements. */
static inline sbfi_columns sbfi_tetrahedron_gradient(const sbfi_tetrahedron *t, const sbfi_d3 v[4]) {
  sbfi_d3 a = sbfi_d3_sub(v[1], v[0]), b = sbfi_d3_sub(v[2], v[0]), c = sbfi_d3_sub(v[3], v[0]);
  const sbfi_d3 *g = t->gradients;
  const double weights[3][3] = {{g[1].x, g[2].x, g[3].x}, {g[1].y, g[2].y, g[3].y}, {g[1].z, g[2].z, g[3].z}};
  sbfi_columns f;
  for (int k = 0; k < 3; k++)
    f.at[k] = sbfi_d3_add(sbfi_d3_add(sbfi_d3_scale(a, weights[k][0]), sbfi_d3_scale(b, weights[k][1])),
        sbfi_d3_scale(c, weights[k][2]));
  return f;
}

static inline sbfi_columns sbfi_cofactors(const sbfi_columns *f) {
  return (sbfi_columns){{sbfi_d3_cross(f->at[1], f->at[2]), sbfi_d3_cross(f->at[2], f->at[0]),
      sbfi_d3_cross(f->at[0], f->at[1])}};
}
static inline double sbfi_determinant(const sbfi_columns *f) {
  return sbfi_d3_dot(f->at[0], sbfi_d3_cross(f->at[1], f->at[2]));
}
static inline sbfi_d3 sbfi_columns_times(const sbfi_columns *m, sbfi_d3 v) {
  return sbfi_d3_add(
      sbfi_d3_add(sbfi_d3_scale(m->at[0], v.x), sbfi_d3_scale(m->at[1], v.y)), sbfi_d3_scale(m->at[2], v.z));
}

/* J at positions `x`: below 0 if inverted. */
double sbfi_tetrahedron_volume_ratio(const sbfi_tetrahedron *t, const sbfi_d3 x[4]);
/* U in J: 0 at rest, otherwise not below. */
double sbfi_tetrahedron_energy(const sbfi_tetrahedron *t, const sbfi_d3 x[4]);
/* Forces on the corners in N; force and moment sum to 0. */
void sbfi_tetrahedron_compute_forces(const sbfi_tetrahedron *t, const sbfi_d3 x[4], sbfi_d3 forces[4]);
/* Second derivatives at `x` times displacements u, in N: minus the change of the forces. */
void sbfi_tetrahedron_product(
    const sbfi_tetrahedron *t, const sbfi_d3 x[4], const sbfi_d3 u[4], sbfi_d3 products[4]);
/* v times the second derivatives at rest times u, in J: work of the forces of small displacements u along
 * v. */
static inline double sbfi_tetrahedron_rest_work(
    const sbfi_tetrahedron *t, const sbfi_d3 u[4], const sbfi_d3 v[4]) {
  sbfi_columns d = sbfi_tetrahedron_gradient(t, u), e = sbfi_tetrahedron_gradient(t, v);
  double along = d.at[0].x * e.at[0].x + d.at[1].y * e.at[1].y + d.at[2].z * e.at[2].z;
  double across = (d.at[0].y + d.at[1].x) * (e.at[0].y + e.at[1].x) +
                  (d.at[1].z + d.at[2].y) * (e.at[1].z + e.at[2].y) +
                  (d.at[2].x + d.at[0].z) * (e.at[2].x + e.at[0].z);
  double traces = (d.at[0].x + d.at[1].y + d.at[2].z) * (e.at[0].x + e.at[1].y + e.at[2].z);
  return t->volume * (t->lame.mu * (2 * along + across) + (t->lame.lambda - t->lame.mu) * traces);
}
/* Full matrix of second derivatives by blocks of corners i and j, N/m: blocks[i][j][3 * row + column]. */
void sbfi_tetrahedron_compute_hessian(const sbfi_tetrahedron *t, const sbfi_d3 x[4], double blocks[4][4][9]);
/* Largest |s - 1| over the singular values s of F, and largest s - 1, for yield and tear. */
typedef struct sbfi_strains {
  double max, stretch;
} sbfi_strains;
sbfi_strains sbfi_tetrahedron_strains(const sbfi_tetrahedron *t, const sbfi_d3 x[4]);

#endif
