/* Cuts of the edges of a lattice grid by a surface. */
#ifndef SBFI_LATTICE_CROSSINGS_H
#define SBFI_LATTICE_CROSSINGS_H

#include "build/geometry/soup.h"
#include "build/lattice/lattice_grid.h"

/* Index of an edge: 8 * owner node + its index among the node's seven. */
typedef struct sbfi_lattice_crossing {
  uint32_t edge;
  float fraction; /* position on the edge, from the owner to the other end */
} sbfi_lattice_crossing;

/* Appends every cut of an edge by a triangle of the surface to `crossings` (items of that type), and sets the
 * bit of each edge that is cut by the surface or caps at its owner in `cut` (grid->node_count, zeros). A cut
 * at a node counts for both edges of its line there, and one through a common edge of two triangles may count
 * for both, so that no line slips through. Returns false if memory runs out. */
bool sbfi_lattice_cross(
    const sbfi_lattice_grid *grid, const sbfi_soup *soup, uint8_t *cut, sbfi_array *crossings);

#endif
