/* Parts of a lattice that are connected to the rest by a point or an edge only, about which they would swing
 * freely. */
#ifndef SBFI_LATTICE_HINGES_H
#define SBFI_LATTICE_HINGES_H

#include "base/memory.h"
#include "build/lattice/lattice_grid.h"

/* `states` are those of sbfi_lattice_stuff. Tetrahedra of one inner node share faces; tetrahedra of two inner
 * nodes connected by an edge do too; parts without such a connection meet at nodes on the surface only. Marks
 * these nodes as inside and forced in `inside` (lattice_limbs.h). `*count` receives their number. Returns
 * false if memory runs out. */
bool sbfi_lattice_join_hinges(const sbfi_lattice_grid *grid, const uint8_t *states, uint8_t *inside,
    uint32_t *count, sbfi_arena *scratch);

#endif
