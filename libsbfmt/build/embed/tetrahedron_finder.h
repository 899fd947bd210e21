/* Finds the tetrahedron around a point, or the best one to embed it from outside. */
#ifndef SBFI_TETRAHEDRON_FINDER_H
#define SBFI_TETRAHEDRON_FINDER_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/base.h"

/* Precomputed data for a tetrahedron's weights: that of corner k, the first three, is the dot product of
 * `cofactors[k]` with the offset from the last corner, divided by `volume`. */
typedef struct sbfi_solved_tetrahedron {
  sbfi_d3 cofactors[3]; /* m^2 */
  double volume;        /* m^3, six times its volume; 0: nearly degenerate */
} sbfi_solved_tetrahedron;

/* A grid of bins of tetrahedra by centre. A tetrahedron around a point has its centre no farther away than
 * the maximum distance of a corner from its centre. */
typedef struct sbfi_tetrahedron_finder {
  const sbf_vec3 *positions;
  const sbf_uint4 *tetrahedra;
  sbfi_d3 origin;
  double width, radius; /* m, of a bin; maximum distance from a centre to a corner */
  double spread;        /* m, maximum root of the sum of squares of these distances */
  double rounding;      /* m, rounding error of a centre */
  uint32_t counts[3];
  uint32_t *begins;                /* (bins + 1) */
  uint32_t *items;                 /* tetrahedra, sorted by bin */
  sbf_vec3 *middles;               /* of the items, relative to the origin */
  sbfi_solved_tetrahedron *solved; /* of each tetrahedron; NULL: each search computes them */
} sbfi_tetrahedron_finder;

/* Positions and tetrahedra, at least one, must outlive the finder. `searches` is the expected number: for
 * many it precomputes more, with equal results. Allocates from `arena`; false if memory runs out. */
bool sbfi_tetrahedron_finder_make(sbfi_tetrahedron_finder *finder, const sbf_vec3 *positions,
    const sbf_uint4 *tetrahedra, uint32_t count, uint32_t searches, sbfi_arena *arena);

typedef struct sbfi_found_tetrahedron {
  uint32_t tetrahedron;
  double distance; /* m, of the point from the nearest of all; 0: it is inside one */
} sbfi_found_tetrahedron;

/* The tetrahedron around the point, the first of several; for a point outside, among those not much
 * farther than the nearest (by half a radius) the one with the smallest weights. */
sbfi_found_tetrahedron sbfi_tetrahedron_find(const sbfi_tetrahedron_finder *finder, sbf_vec3 point);

/* Weights of the point at the corners, summing to one; false if the tetrahedron is nearly degenerate. */
bool sbfi_tetrahedron_weigh(
    const sbf_vec3 *positions, const uint32_t corners[4], sbfi_d3 point, double weights[4]);

typedef void sbfi_tetrahedron_visitor(void *user, uint32_t tetrahedron);

/* Visits each tetrahedron with the given point as a corner. */
void sbfi_find_tetrahedra_about(
    const sbfi_tetrahedron_finder *finder, uint32_t corner, sbfi_tetrahedron_visitor *visit, void *user);

#endif
