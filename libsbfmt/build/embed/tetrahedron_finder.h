/* Which of many tetrahedra is around a point, or embeds it best from outside. */
#ifndef SBFI_TETRAHEDRON_FINDER_H
#define SBFI_TETRAHEDRON_FINDER_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/base.h"

/* What a tetrahedron's corners say about the weights of points: of corner k, the first three, the dot product
 * of `cofactors[k]` with the way from the last corner, divided by `volume`. */
typedef struct sbfi_solved_tetrahedron {
  sbfi_d3 cofactors[3]; /* m^2 */
  double volume;        /* m^3, six times its own; 0: it is as good as flat */
} sbfi_solved_tetrahedron;

/* A grid of bins, each with the tetrahedra whose middles lie in it. What is around a point has its middle no
 * farther from it than any corner is from its tetrahedron's middle. */
typedef struct sbfi_tetrahedron_finder {
  const sbf_vec3 *positions;
  const sbf_uint4 *tetrahedra;
  sbfi_d3 origin;
  double width, radius; /* m, of a bin; from a middle to a corner at most */
  double spread;        /* m, root of the sum of the squares of these ways, at most */
  double rounding;      /* m, by which a middle may be off */
  uint32_t counts[3];
  uint32_t *begins;                /* (bins + 1) */
  uint32_t *items;                 /* tetrahedra, bin by bin */
  sbf_vec3 *middles;               /* of the items, from the origin */
  sbfi_solved_tetrahedron *solved; /* of each tetrahedron; NULL: each search does it again */
} sbfi_tetrahedron_finder;

/* Positions and tetrahedra, at least one, must outlive the finder. About so many `searches` are to come: for
 * many it prepares more; what they find is the same. Memory of `arena`; false where it runs out. */
bool sbfi_tetrahedron_finder_make(sbfi_tetrahedron_finder *finder, const sbf_vec3 *positions,
    const sbf_uint4 *tetrahedra, uint32_t count, uint32_t searches, sbfi_arena *arena);

typedef struct sbfi_found_tetrahedron {
  uint32_t tetrahedron;
  double distance; /* m, of the point from the nearest of all; 0: it is inside one */
} sbfi_found_tetrahedron;

/* The tetrahedron around the point, the first of several; for a point outside, of those hardly farther from
 * it than the nearest (by half a radius) the one with the smallest weights. */
sbfi_found_tetrahedron sbfi_tetrahedron_find(const sbfi_tetrahedron_finder *finder, sbf_vec3 point);

/* Weights of the point at the corners, summing to one; false where the tetrahedron is as good as flat. */
bool sbfi_tetrahedron_weigh(
    const sbf_vec3 *positions, const uint32_t corners[4], sbfi_d3 point, double weights[4]);

typedef void sbfi_tetrahedron_visitor(void *user, uint32_t tetrahedron);

/* Calls for each tetrahedron that has the point of that number as a corner. */
void sbfi_find_tetrahedra_about(
    const sbfi_tetrahedron_finder *finder, uint32_t corner, sbfi_tetrahedron_visitor *visit, void *user);

#endif
