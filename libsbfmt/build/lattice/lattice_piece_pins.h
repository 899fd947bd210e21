/* Additional pinned points, so that no piece of a lattice can rotate about a point or a line. */
#ifndef SBFI_LATTICE_PIECE_PINS_H
#define SBFI_LATTICE_PIECE_PINS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Adds points to `core` (capacity for all points of the level; `*count` in and out, ascending). A piece is a
 * connected component of the tetrahedra. After this, every piece has three pinned points, not within `width`
 * m of one line. Adds as few points as possible, in each piece those nearest to the centre of its pinned
 * points, which are the core and those of the level's pins. In a piece without pinned points the deepest
 * point comes first. `depths2` are the points' squared distances from the surface. Points that are `taken`
 * belong to other sets and are not added. A piece that is too small for the width keeps fewer points. False
 * if memory runs out. */
bool sbfi_lattice_pin_pieces(const sbf_level *level, const double *depths2, const uint8_t *taken,
    double width, uint32_t *core, uint32_t *count, sbfi_arena *scratch);

#endif
