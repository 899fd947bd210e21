/* Makes a rig of an asset: bones and their order, roles, legs, tails, chains; then what each rig_*.h finds.
 */
#ifndef SBRI_RIG_MAKE_H
#define SBRI_RIG_MAKE_H

#include "skeleton/rig.h"

/* Bytes the tables take, and their making in a block of that size. The asset must outlive the rig. A leg
 * whose chain is neither thigh, shin, foot and, it may be, toe, nor a peg and its foot is left out. */
size_t sbri_rig_size(const sbf_asset *asset);
void sbri_rig_init(sbri_rig *rig, const sbf_asset *asset, void *memory);

#endif
