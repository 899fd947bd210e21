/* Nodes of a lattice grid inside a surface. */
#ifndef SBFI_LATTICE_SIGNS_H
#define SBFI_LATTICE_SIGNS_H

#include "build/geometry/winding_number.h"
#include "build/lattice/lattice_grid.h"

/* `inside` (grid->node_count) receives 1 or 0. `cut` has the bits of edges that are cut by the surface and
 * caps, from sbfi_lattice_cross.
 *
 * Surface and caps have a constant winding number in every region that they bound, so nodes connected by
 * uncut edges are equal, and one evaluation is enough for each region. The contribution of the caps is
 * evaluated at every node where it may matter. Memory of `arena`; returns false if it runs out. */
bool sbfi_lattice_signs(const sbfi_lattice_grid *grid, const sbfi_winding *winding, const uint8_t *cut,
    uint8_t *inside, sbfi_arena *arena);

#endif
