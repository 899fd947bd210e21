/* A region that keeps its shape, in double precision: what every scheme, the tests and `build` take it to be.
 * The runtime's kernel (runtime/solvers/region_forces.h) is written out for eight regions in single precision
 * and is tested against this.
 *
 * With weights a_i in kg, c and c0 their centres now and at rest, r_i = X_i - c0 and R the rotation that
 * makes sum a_i |x_i - c - R r_i|^2 least,
 *
 *   U = w^2/2 sum a_i |x_i - c - R r_i|^2,   f_i = -a_i w^2 (x_i - c - R r_i),
 *
 * whose forces sum to 0 in force and moment (R is where the moment vanishes). Shape matching is of Mueller,
 * Heidelberger, Teschner and Gross, Meshless Deformations Based on Shape Matching, 2005; overlapping regions
 * on a lattice of Rivers and James, FastLSM, 2007. Here it is an energy with a frequency instead of a share
 * of the way to the goal, so that its stiffness depends neither on the step nor on the sweeps.
 *
 * R is found as the quaternion of the greatest eigenvalue of Horn's symmetric 4 x 4 matrix (Horn, Closed-form
 * Solution of Absolute Orientation Using Unit Quaternions, 1987), proper for mirrored places too.
 *
 * In numbers of matter: regions that overlap evenly, strained by the small tensor e, hold the energy rho w^2
 * s^2 / 2 (e:e) a volume, s^2 the mean square of the points' distances from their region's centre along an
 * axis. That is isotropic matter with Poisson's ratio 0 and Young's modulus E = rho w^2 s^2. */
#ifndef SBFI_SHAPE_REGION_H
#define SBFI_SHAPE_REGION_H

#include <stddef.h>

#include "mechanics/vector.h"

/* Centre c = sum a x / sum a of `count` weights above 0. */
sbfi_d3 sbfi_region_center(const double *weights, const sbfi_d3 *positions, size_t count);

/* What R and c are found from. Begins empty ({0}); then every point of the region is added. */
typedef struct sbfi_region_sums {
  double weight;
  sbfi_d3 position;  /* sum a x */
  double moments[9]; /* sum a r x^T, row of r by row: the a r sum to 0, so that it needs no centre */
} sbfi_region_sums;
void sbfi_region_add(sbfi_region_sums *sums, double weight, sbfi_d3 offset, sbfi_d3 position);

typedef struct sbfi_region_fit {
  sbfi_d3 center;     /* c */
  sbfi_d3 columns[3]; /* of R */
} sbfi_region_fit;
sbfi_region_fit sbfi_region_fit_of(const sbfi_region_sums *sums);

/* c + R r. */
sbfi_d3 sbfi_region_goal(const sbfi_region_fit *fit, sbfi_d3 offset);

#endif
