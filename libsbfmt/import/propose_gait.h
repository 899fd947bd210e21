/* A gait guessed from a rig: which bones are legs, head and tail, and how far they step. Everything made here
 * is marked as proposed, for a person to confirm or change. */
#ifndef SBFI_PROPOSE_GAIT_H
#define SBFI_PROPOSE_GAIT_H

#include "base/diagnostic.h"
#include "sbfmt/asset.h"

/* Adds ik chains, chains and a gait to an asset that has none of its own. Legs are chains of thigh, shin and
 * foot whose foot is near the lowest point of the body, in pairs left and right of the middle; head and tail
 * go by name first, then by shape. A rig without legs gets no gait, and a warning says so. */
sbf_status sbfi_propose_gait(sbf_asset *asset, sbfi_reporter *reporter, sbf_diagnostic *error);

#endif
