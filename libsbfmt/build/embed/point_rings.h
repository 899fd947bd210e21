/* Points of a lattice around one of its tetrahedra, ring after ring along its sides: near by the way through
 * the matter, so that an ear's are its own and not those of the other ear beside it. */
#ifndef SBFI_POINT_RINGS_H
#define SBFI_POINT_RINGS_H

#include "build/embed/tetrahedron_finder.h"

enum { SBFI_MAX_RING_POINTS = 256 };

typedef struct sbfi_point_rings {
  const sbfi_tetrahedron_finder *finder;
  uint32_t count, widened; /* of the points; of those whose neighbours are among them */
  uint32_t points[SBFI_MAX_RING_POINTS];
  bool full; /* one more had no place */
} sbfi_point_rings;

/* The tetrahedron's corners. */
void sbfi_point_rings_begin(
    sbfi_point_rings *rings, const sbfi_tetrahedron_finder *finder, uint32_t tetrahedron);

/* The neighbours of all of them are taken in. False where there are none, or more than have a place. */
bool sbfi_point_rings_widen(sbfi_point_rings *rings);

/* Four of them far from each other: one after the other the farthest from the first corner, from that one,
 * from the line through both, from the plane through the three. */
void sbfi_point_rings_widest(const sbfi_point_rings *rings, uint32_t four[4]);

#endif
