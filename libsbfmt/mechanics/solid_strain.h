/* Principal stretches of F_e for strain limits, yield and tear of a tetrahedron, and plastic flow of its rest
 * shape. Double precision with only the square root from libm, so that every machine has the same bits.
 *
 * The rest shape is represented by its metric, g_i.g_j of the gradients of the shape functions 1 to 3:
 * with F = F_e F_p and the energy of F_e, only F_p^-1 F_p^-T matters, which maps the metric at rest to
 * that of the yielded shape. */
#ifndef SBFI_SOLID_STRAIN_H
#define SBFI_SOLID_STRAIN_H

#include "mechanics/vector.h"

/* g_i.g_j for ij = 11, 22, 33, 12, 23, 31, in 1/m^2. */
typedef struct sbfi_solid_metric {
  double at[6];
} sbfi_solid_metric;

typedef struct sbfi_stretches {
  double values[3];        /* of F_e, not sorted; the smallest is negative if inverted */
  double directions[3][3]; /* q_k, 1/m: sum_j q_k[j] d_j = value_k times a unit vector, with d_j the current
                              edges */
} sbfi_stretches;

/* From the edges from the first corner to the others; false if the metric is invalid. */
bool sbfi_stretches_find(const sbfi_solid_metric *metric, const sbfi_d3 edges[3], sbfi_stretches *found);

/* Metric after a flow towards strains within `yield_strain`, by a `fraction` (1 - exp(-r h)) of the
 * distance: r_i of section 10.2 of the specification. Preserves the volume. False, without any change, if
 * no stretch is beyond, or the element is flat or inverted. */
bool sbfi_solid_flow(
    const sbfi_stretches *stretches, double yield_strain, double fraction, sbfi_solid_metric *metric);

#endif
