/* Where a surface cuts the edges of a lattice grid. */
#ifndef SBFI_LATTICE_CROSSINGS_H
#define SBFI_LATTICE_CROSSINGS_H

#include "build/geometry/soup.h"
#include "build/lattice/lattice_grid.h"

/* Number of an edge: 8 * node that owns it + which of the node's seven. */
typedef struct sbfi_lattice_crossing {
  uint32_t edge;
  float fraction; /* of the way from the owner to the other end */
} sbfi_lattice_crossing;

/* Appends every cut of a triangle of the surface and an edge to `crossings` (items of that type), and sets
 * the bit of each edge that surface or caps cut at its owner in `cut` (grid->node_count, zeros). A cut next
 * to a node counts for both edges of its line there, and one through the side of two triangles may count for
 * both, so that nowhere a line slips through. False where memory runs out. */
bool sbfi_lattice_cross(
    const sbfi_lattice_grid *grid, const sbfi_soup *soup, uint8_t *cut, sbfi_array *crossings);

#endif
