/* Parts of a humanoid that retarget chains name, as a VRM file does: they need not be guessed. */
#ifndef SBFI_NAMED_CHAINS_H
#define SBFI_NAMED_CHAINS_H

#include "import/gait/gait_draft.h"
#include "import/gait/rest_pose.h"

/* Whether both legs are named: chains leg_left and leg_right of thigh, shin and foot, each the parent of the
 * next. */
bool sbfi_has_named_legs(const sbf_asset *asset);
/* Sets the draft's legs to them; false if they are not named. */
bool sbfi_draft_named_legs(sbfi_gait_draft *d);
/* Sets `arms` (2) to chains arm_left and arm_right of upper arm, forearm and hand, after a shoulder or not;
 * returns their number, 0 if one of them is not named. */
uint32_t sbfi_draft_named_arms(const sbf_asset *asset, sbfi_arm_draft arms[2]);
/* The last bone of the chain head, or SBF_NONE. */
int32_t sbfi_chain_head(const sbf_asset *asset);

#endif
