/* Points to pin so that no piece of a lattice can rotate about a point or a line. */
#ifndef SBFI_LATTICE_HOLD_H
#define SBFI_LATTICE_HOLD_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Adds to `core` (room for all points of the level; `*count` in and out, in ascending order) the fewest
 * points with which every piece of the lattice, a piece being what tetrahedra join, is held at three points
 * that reach `width` m from every line through two of them: those nearest to the middle of what holds it
 * already, which are the core and what the level's pins hold; in a piece that nothing holds, first the
 * deepest. `depths2` are the points' squared distances from the surface; points that are `taken` are other
 * sets' and are not added. A piece so small that no point reaches so far stays as it is. False where memory
 * runs out. */
bool sbfi_lattice_hold_pieces(const sbf_level *level, const double *depths2, const uint8_t *taken,
    double width, uint32_t *core, uint32_t *count, sbfi_arena *scratch);

#endif
