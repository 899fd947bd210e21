/* Shape matching region in double precision: the reference for all schemes, the tests and `build`. The
 * runtime's kernel (runtime/soft/solvers/region_forces.h) processes eight regions in single precision and is
 * tested against it.
 *
 * With weights a_i in kg, c and c0 their current and rest centres, r_i = X_i - c0 and R the rotation that
 * minimizes sum a_i |x_i - c - R r_i|^2,
 *
 *   U = w^2/2 sum a_i |x_i - c - R r_i|^2,   f_i = -a_i w^2 (x_i - c - R r_i),
 *
 * Forces and moments sum to 0 (the optimal R is where the moment vanishes). Shape matching is from Mueller,
 * Heidelberger, Teschner and Gross, Meshless Deformations Based on Shape Matching, 2005; overlapping regions
 * on a lattice from Rivers and James, FastLSM, 2007. Here it is an energy with a frequency instead of a
 * fraction of the distance to the goal, so its stiffness depends neither on the step nor on the iterations.
 *
 * R is the quaternion of the largest eigenvalue of Horn's symmetric 4 x 4 matrix (Horn, Closed-form
 * Solution of Absolute Orientation Using Unit Quaternions, 1987), a proper rotation for mirrored positions
 * too.
 *
 * As a material: under a small strain tensor e evenly overlapping regions have the energy density
 * rho w^2 s^2 / 2 (e:e), where s^2 is the mean square of the points' distances from their region's centre
 * along an axis. That is an isotropic material with Poisson's ratio 0 and Young's modulus E = rho w^2 s^2. */
#ifndef SBFI_SHAPE_REGION_H
#define SBFI_SHAPE_REGION_H

#include <stddef.h>

#include "mechanics/vector.h"

/* Centre c = sum a x / sum a for `count` weights above 0. */
sbfi_d3 sbfi_region_center(const double *weights, const sbfi_d3 *positions, size_t count);

/* Sums for R and c. Initialize with {0}, then add every point of the region. */
typedef struct sbfi_region_sums {
  double weight;
  sbfi_d3 position;  /* sum a x */
  double moments[9]; /* sum a r x^T, one row per component of r; no centre needed because the a r sum to 0 */
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
