/* Soles: the lowest part of what a gait's leg stands on. What stands is held by the ground, with all the
 * weight of the character on it; neither weights that run over from the shin nor its own flesh move it. */
#ifndef SBFI_SECTION_SOLE_H
#define SBFI_SECTION_SOLE_H

#include "build/sections/skin_union.h"

/* Takes from the points of soles what bones above the foot hold of them, and marks them in `soles` (points,
 * zero before). False where memory runs out. */
bool sbfi_soles_gather(sbfi_skin_union *skin, const sbf_asset *asset, uint8_t *soles, sbfi_arena *arena);

/* Marks in `held` the level's points that carry the sole of a section, where it is one's: the bone holds
 * them. The level has its tetrahedra. */
void sbfi_section_sole_hold(
    const sbf_asset *asset, const sbf_soft_body *body, const sbf_level *level, uint8_t *held);

#endif
