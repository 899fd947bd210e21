/* Limbs thinner than a lattice's cell, which would lie between the nodes. */
#ifndef SBFI_LATTICE_LIMBS_H
#define SBFI_LATTICE_LIMBS_H

#include "base/memory.h"
#include "build/geometry/winding_number.h"
#include "build/lattice/lattice_grid.h"

/* Bits of `inside`. */
enum { SBFI_LATTICE_INSIDE = 1, SBFI_LATTICE_FORCED = 2 };

/* Finds the nodes that represent thin parts: of an edge with both ends outside and a middle part inside, the
 * nearer end; and nodes inside that their cuts would warp onto the surface. If such a node has no neighbour
 * well inside, or is a neighbour of one of those, it is marked as inside and forced: cuts must keep a
 * distance from it. A limb thus keeps a row of nodes and two elements across, but becomes thicker than it
 * should be. Ridges, which are next to nodes well inside, do not change. `crossings` are those of
 * sbfi_lattice_cross.
 * `*count` receives the number of forced nodes. False if memory runs out. */
bool sbfi_lattice_preserve_limbs(const sbfi_lattice_grid *grid, const sbfi_winding *winding,
    const sbfi_array *crossings, uint8_t *inside, uint32_t *count, sbfi_arena *scratch);

#endif
