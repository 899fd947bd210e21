/* Soles: the lowest parts of a gait's feet. They must not slide on the ground, which they would with
 * weights of the shin. */
#ifndef SBFI_SECTION_SOLE_H
#define SBFI_SECTION_SOLE_H

#include "build/sections/skin_union.h"

/* Removes weights of bones above the foot from the points of soles, and marks these in `soles` (points,
 * initially zero). The arrays of weights are new ones from `arena`; the old ones do not change. False if
 * memory runs out. */
bool sbfi_soles_gather(sbfi_skin_union *skin, const sbf_asset *asset, uint8_t *soles, sbfi_arena *arena);

#endif
