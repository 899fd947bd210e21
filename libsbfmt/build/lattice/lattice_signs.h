/* Which nodes of a lattice grid lie inside a surface. */
#ifndef SBFI_LATTICE_SIGNS_H
#define SBFI_LATTICE_SIGNS_H

#include "build/geometry/winding_number.h"
#include "build/lattice/lattice_grid.h"

/* `inside` (grid->node_count) receives 1 or 0. `cut` has the bits of the edges that surface and caps cut,
 * from sbfi_lattice_cross.
 *
 * Surface and caps have one winding number in every part of space that they divide off, so nodes that uncut
 * edges join are alike, and one evaluation tells for all of them. What the caps add is evaluated at every
 * node near enough to them for it to matter. Memory of `arena`; false where it runs out. */
bool sbfi_lattice_signs(const sbfi_lattice_grid *grid, const sbfi_winding *winding, const uint8_t *cut,
    uint8_t *inside, sbfi_arena *arena);

#endif
