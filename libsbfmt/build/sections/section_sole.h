/* Soles: the lowest part of what a gait's leg stands on. The ground holds it: weights that run over from the
 * shin would slide it as the leg goes over it. */
#ifndef SBFI_SECTION_SOLE_H
#define SBFI_SECTION_SOLE_H

#include "build/sections/skin_union.h"

/* Takes from the points of soles what bones above the foot hold of them, and marks them in `soles` (points,
 * zero before). The arrays of holds are new ones, of `arena`; those before stay as they are. False where
 * memory runs out. */
bool sbfi_soles_gather(sbfi_skin_union *skin, const sbf_asset *asset, uint8_t *soles, sbfi_arena *arena);

#endif
