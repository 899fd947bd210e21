/* The hinges by which a sheet bends: one at each side between two triangles, of the plate's rigidity. */
#ifndef SBRI_HINGES_H
#define SBRI_HINGES_H

#include "prepare/prepare.h"
#include "sbfmt/mechanics.h"

/* Those of the body's surface at rest, none where it is no sheet; they live in `keep`. False where memory
 * runs out. */
bool sbri_hinges_find(const sbri_island *island, const sbri_body *body, sbfi_arena *keep, sbfi_arena *scratch,
    const sbri_hinge **hinges, uint32_t *hinge_count);

/* Adds them to a network over the island's slots, linearised at rest: also those of a sheet that bends by
 * flexion springs, which resist no small bending of a flat sheet. False where memory runs out. */
bool sbri_hinges_add(
    const sbri_island *island, const sbri_body *body, sbfi_arena *scratch, sbf_spring_network *network);

#endif
