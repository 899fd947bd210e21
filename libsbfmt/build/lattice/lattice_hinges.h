/* Parts of a lattice that hang on the rest by a point or by one side of a tetrahedron: they would swing about
 * it as if nothing held them. */
#ifndef SBFI_LATTICE_HINGES_H
#define SBFI_LATTICE_HINGES_H

#include "base/memory.h"
#include "build/lattice/lattice_grid.h"

/* `states` are those of sbfi_lattice_stuff. Tetrahedra of one node inside share faces, and so do those of two
 * that an edge joins; parts with no such way between them meet at nodes on the surface alone. Takes these in
 * as inside and forced, in `inside` (lattice_limbs.h). `*count` receives how many. False where memory runs
 * out. */
bool sbfi_lattice_join_hinges(const sbfi_lattice_grid *grid, const uint8_t *states, uint8_t *inside,
    uint32_t *count, sbfi_arena *scratch);

#endif
