/* Pins of a level of tetrahedra, whose points are not the body's own. */
#ifndef SBFI_LATTICE_PINS_H
#define SBFI_LATTICE_PINS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Gives the level, whose positions are in place, its pin sets, marked with `derivation`:
 *   each set of the body, and each explicit attachment: the level's points on the surface that lie between
 * source points all of which are in it, with the weight between theirs, and the level's point nearest to each
 * of the set's points, which so holds something however small it is: a finer lattice is held in no other
 * place. Of several sets the first has a point.
 * They are held where they are at rest: offsets, which are those of the body's points, are left out;
 *   "interior" in a body with a bone: the points at least half as deep under the surface as the body is thick
 * around them (lattice_core.h), to the tip of a tail, less those; more of them where these lie on a line, and
 * every piece of the lattice at three points that do not (lattice_hold.h);
 * attachments by a hull: the points inside it that no set before holds. False where memory runs out.
 */
bool sbfi_lattice_pins_make(
    sbf_level *level, const sbf_soft_body *body, int32_t derivation, sbf_asset *asset, sbfi_arena *scratch);

/* The first of these alone: the level's pins are the body's, less those that hold nothing; `taken` (level
 * points) receives which points they have. False where memory runs out. */
bool sbfi_lattice_pins_map(sbf_level *level, const sbf_soft_body *body, uint8_t *taken, int32_t derivation,
    sbf_asset *asset, sbfi_arena *scratch);

#endif
