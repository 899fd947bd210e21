/* Builds a rig from an asset: bones and their order, roles, legs, tails, chains; then the results of each
 * rig_*.h. */
#ifndef SBRI_RIG_MAKE_H
#define SBRI_RIG_MAKE_H

#include "animation/skeleton/rig.h"

/* Size of the tables in bytes; and the build in a block of that size. The asset must outlive the rig. Ignores
 * legs whose chain is neither thigh, shin, foot and optional toe, nor a single bone and its foot. */
size_t sbri_rig_size(const sbf_asset *asset);
void sbri_rig_init(sbri_rig *rig, const sbf_asset *asset, void *memory);

#endif
