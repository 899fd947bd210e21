/* Proposes a gait from a rig: which bones are legs, head and tail, and the step lengths. Everything is
 * marked as proposed, for a person to confirm or change. */
#ifndef SBFI_PROPOSE_GAIT_H
#define SBFI_PROPOSE_GAIT_H

#include "import/convert/conversion.h"

/* Adds a gait with ik chains and chains to an asset that has none. Uses the kind in c->locomotion;
 * searches for legs if that is NULL. Legs are limbs of one side that reach the ground; left is +X; each is
 * named after its foot. Head and tail are found by name first, then by shape. Kind none adds no gait and
 * warns. */
sbf_status sbfi_propose_gait(sbfi_conversion *c);

/* Before the asset is rotated to face ahead: warns if bones named as legs do not point down. */
sbf_status sbfi_report_lying(sbfi_conversion *c);
/* After the gait: warns of skeletons of other characters, which no gait moves. */
sbf_status sbfi_report_other_skeletons(sbfi_conversion *c);

#endif
