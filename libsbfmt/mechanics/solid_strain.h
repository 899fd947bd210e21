/* What strain limits, yield and tear of a tetrahedron go by: the principal stretches of F_e, and how its rest
 * shape flows. In double precision, without a library's functions but the square root, so that every machine
 * has the same bits.
 *
 * The rest shape is its metric alone, g_i.g_j of the gradients of the shape functions 1 to 3: with F = F_e
 * F_p and the energy that of F_e, nothing depends on more of F_p than F_p^-1 F_p^-T, which takes the metric
 * at rest to that of the yielded shape. */
#ifndef SBFI_SOLID_STRAIN_H
#define SBFI_SOLID_STRAIN_H

#include "mechanics/vector.h"

/* g_i.g_j for ij = 11, 22, 33, 12, 23, 31, in 1/m^2. */
typedef struct sbfi_solid_metric {
  double at[6];
} sbfi_solid_metric;

typedef struct sbfi_stretches {
  double values[3];        /* of F_e, not sorted; inside out, the least of them is below 0 */
  double directions[3][3]; /* q_k, 1/m: sum_j q_k[j] d_j = value_k times a unit vector, d_j the edges now */
} sbfi_stretches;

/* Of the edges from the first corner to the others; false where the metric is none. */
bool sbfi_stretches_find(const sbfi_solid_metric *metric, const sbfi_d3 edges[3], sbfi_stretches *found);

/* The metric after a flow towards strains within `yield_strain`, of which `fraction` of the way (1 - exp(-r
 * h)) is gone: r_i of section 10.2 of the specification. The volume stays. False, and nothing is changed,
 * where no stretch is beyond, or the element is flat or inside out. */
bool sbfi_solid_flow(
    const sbfi_stretches *stretches, double yield_strain, double fraction, sbfi_solid_metric *metric);

#endif
