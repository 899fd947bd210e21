/* Pieces of a level that hang on nothing while others do: crumbs of a lattice of a surface with holes or of
 * one finer than its cell. Statics has no answer for them: they would give without end. */
#ifndef SBFI_LOOSE_PIECES_H
#define SBFI_LOOSE_PIECES_H

#include "base/memory.h"
#include "sbfmt/mechanics.h"

/* Takes the masses (point_count), which are the network's own, off every piece that nothing holds, so that it
 * counts as held where it is; where nothing is `pinned` at all, off every piece but the heaviest. `*loose_kg`
 * receives what that took. False where memory runs out. */
bool sbfi_loose_pieces_hold(
    const sbf_spring_network *network, bool pinned, float *masses, double *loose_kg, sbfi_arena *scratch);

/* Whether a piece with some free point is held at points of one line alone, within 1e-4 of `size_m`, or at
 * one: it turns about them, and no load that is not balanced about them finds an answer. Pieces that nothing
 * holds do not count. False where memory runs out. */
bool sbfi_pieces_turn(const sbf_spring_network *network, double size_m, bool *turn, sbfi_arena *scratch);

#endif
