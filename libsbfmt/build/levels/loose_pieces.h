/* Finds unpinned pieces of a level whose other pieces are pinned: fragments of a lattice of a surface with
 * holes or details below its cell size. Statics has no solution for them: their displacement is unbounded. */
#ifndef SBFI_LOOSE_PIECES_H
#define SBFI_LOOSE_PIECES_H

#include "base/memory.h"
#include "sbfmt/mechanics.h"

/* Sets the masses (point_count) of the network's unpinned pieces to 0, so that they count as pinned; if
 * nothing is `pinned`, of every piece but the heaviest. `*loose_kg` receives the removed mass. False if
 * memory runs out. */
bool sbfi_loose_pieces_pin(
    const sbf_spring_network *network, bool pinned, float *masses, double *loose_kg, sbfi_arena *scratch);

/* Whether a piece with free points is pinned only at one point or along one line, within 1e-4 of `size_m`:
 * it can rotate about that, so most loads have no solution. Ignores unpinned pieces. False if memory runs
 * out. */
bool sbfi_pieces_can_rotate(
    const sbf_spring_network *network, double size_m, bool *can_rotate, sbfi_arena *scratch);

#endif
