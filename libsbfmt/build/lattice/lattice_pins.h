/* Pins of a level of tetrahedra, whose points are not the body's own. */
#ifndef SBFI_LATTICE_PINS_H
#define SBFI_LATTICE_PINS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Creates the level's pin sets, marked with `derivation`; its positions must be set.
 *
 * One set for each set of the body and each explicit attachment. It pins points of the level on the surface
 * whose source points are all in the set, with the interpolated weight. It also pins the level's point
 * nearest to each of the set's points, so that even a small set pins something, and a finer lattice is pinned
 * at the same positions. A point belongs to the first set that pins it. Points are pinned at their rest
 * positions: offsets are omitted, since they are those of the body's points.
 *
 * "interior", if the body has a bone: the other points at least half as deep below the surface as the body is
 * thick around them (lattice_core.h), up to the tip of a tail. If these are on a line, it has more of them.
 * In every piece of the lattice it pins three points that are not (lattice_piece_pins.h).
 *
 * A set for each attachment by a hull: the points inside the hull that no earlier set pins. False if memory
 * runs out. */
bool sbfi_lattice_pins_make(
    sbf_level *level, const sbf_soft_body *body, int32_t derivation, sbf_asset *asset, sbfi_arena *scratch);

/* Creates only the body's sets, without empty ones; `taken` (level points) receives 1 for points that they
 * pin. False if memory runs out. */
bool sbfi_lattice_pins_map(sbf_level *level, const sbf_soft_body *body, uint8_t *taken, int32_t derivation,
    sbf_asset *asset, sbfi_arena *scratch);

#endif
