/* Limbs thinner than a lattice's cell, which would fall between the nodes. */
#ifndef SBFI_LATTICE_LIMBS_H
#define SBFI_LATTICE_LIMBS_H

#include "base/memory.h"
#include "build/geometry/winding_number.h"
#include "build/lattice/lattice_grid.h"

/* Bits of `inside`. */
enum { SBFI_LATTICE_INSIDE = 1, SBFI_LATTICE_FORCED = 2 };

/* Finds the nodes that stand for thin parts: the nearer ends of edges with both ends outside and a middle
 * part inside, and nodes inside that their cuts would warp onto the surface. Those with no neighbour that is
 * well inside, and those that join them to the rest, are taken in as inside and forced: their cuts are to
 * keep away from them. So a limb keeps a row of nodes, and with it two elements across, at the price of being
 * thicker than it should be; ridges, which stand on nodes well inside, are left as they are. `crossings` are
 * those of sbfi_lattice_cross. `*count` receives how many nodes were forced. False where memory runs out. */
bool sbfi_lattice_preserve_limbs(const sbfi_lattice_grid *grid, const sbfi_winding *winding,
    const sbfi_array *crossings, uint8_t *inside, uint32_t *count, sbfi_arena *scratch);

#endif
