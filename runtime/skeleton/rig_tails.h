/* Tails: their bones, how they follow, and how far their skin hangs down. */
#ifndef SBRI_RIG_TAILS_H
#define SBRI_RIG_TAILS_H

#include "skeleton/rig.h"

size_t sbri_rig_tails_size(const sbf_asset *asset);

/* Sets `tails` and their counts; `memory`: sbri_rig_tails_size bytes. The rig has a gait, and its rest pose.
 */
void sbri_rig_find_tails(sbri_rig *rig, void *memory);

#endif
