/* Points of a lattice around one of its tetrahedra, in rings along its edges: close through the material,
 * so that rings in one ear do not include the other ear beside it. */
#ifndef SBFI_POINT_RINGS_H
#define SBFI_POINT_RINGS_H

#include "build/embed/tetrahedron_finder.h"

enum { SBFI_MAX_RING_POINTS = 256 };

typedef struct sbfi_point_rings {
  const sbfi_tetrahedron_finder *finder;
  uint32_t count, widened; /* number of points; of points whose neighbours are included */
  uint32_t points[SBFI_MAX_RING_POINTS];
  bool full; /* the capacity was exceeded */
} sbfi_point_rings;

/* Starts with the tetrahedron's corners. */
void sbfi_point_rings_begin(
    sbfi_point_rings *rings, const sbfi_tetrahedron_finder *finder, uint32_t tetrahedron);

/* Adds the neighbours of all points. False if there are none, or the capacity is exceeded. */
bool sbfi_point_rings_widen(sbfi_point_rings *rings);

/* Four of them far from each other: successively the farthest from the first corner, from that one, from
 * the line through both, from the plane through the three. */
void sbfi_point_rings_widest(const sbfi_point_rings *rings, uint32_t four[4]);

#endif
