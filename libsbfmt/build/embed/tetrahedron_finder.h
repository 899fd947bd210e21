/* Which of many tetrahedra is around a point, or carries it best from outside. */
#ifndef SBFI_TETRAHEDRON_FINDER_H
#define SBFI_TETRAHEDRON_FINDER_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/base.h"

/* A grid of bins, each with the tetrahedra whose middles lie in it; twice as wide as the farthest corner lies
 * from its tetrahedron's middle, so that eight bins hold all that may be around a point. */
typedef struct sbfi_tetrahedron_finder {
  const sbf_vec3 *positions;
  const sbf_uint4 *tetrahedra;
  sbfi_d3 origin;
  double width, radius; /* m, of a bin; from a middle to a corner at most */
  uint32_t counts[3];
  uint32_t *begins;  /* (bins + 1) */
  uint32_t *items;   /* tetrahedra, bin by bin */
  sbf_vec3 *middles; /* of the items, from the origin */
} sbfi_tetrahedron_finder;

/* Positions and tetrahedra, at least one, must outlive the finder. Memory of `arena`; false where it runs
 * out. */
bool sbfi_tetrahedron_finder_make(sbfi_tetrahedron_finder *finder, const sbf_vec3 *positions,
    const sbf_uint4 *tetrahedra, uint32_t count, sbfi_arena *arena);

typedef struct sbfi_found_tetrahedron {
  uint32_t tetrahedron;
  double distance; /* m, of the point from the nearest of all; 0: it is inside one */
} sbfi_found_tetrahedron;

/* The tetrahedron around the point, the first of several; for a point outside, of those hardly farther from
 * it than the nearest (by a quarter of a bin) the one with the smallest weights. */
sbfi_found_tetrahedron sbfi_tetrahedron_find(const sbfi_tetrahedron_finder *finder, sbf_vec3 point);

/* Weights of the point at the corners, summing to one; false where the tetrahedron is as good as flat. */
bool sbfi_tetrahedron_weigh(
    const sbf_vec3 *positions, const uint32_t corners[4], sbfi_d3 point, double weights[4]);

#endif
