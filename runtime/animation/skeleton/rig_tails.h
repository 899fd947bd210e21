/* Tails: their bones, how they follow, and the depth of their skin. */
#ifndef SBRI_RIG_TAILS_H
#define SBRI_RIG_TAILS_H

#include "animation/skeleton/rig.h"

size_t sbri_rig_tails_size(const sbf_asset *asset);

/* Sets `tails` and their counts; `memory`: sbri_rig_tails_size bytes. Call after the gait and its rest pose
 * are set. */
void sbri_rig_find_tails(sbri_rig *rig, void *memory);

/* Whether the gait moves a chain as a tail. */
bool sbri_rig_moves_as_tail(const sbri_rig *rig, uint32_t chain);

#endif
