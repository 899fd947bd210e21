/* A gait guessed from a rig: which bones are legs, head and tail, and how far they step. Everything made here
 * is marked as proposed, for a person to confirm or change. */
#ifndef SBFI_PROPOSE_GAIT_H
#define SBFI_PROPOSE_GAIT_H

#include "import/convert/conversion.h"

/* Adds a gait of the kind that was judged (c->locomotion; legs are looked for where it was not) to an asset
 * that has none, with ik chains and chains. Legs are limbs of one side that come down to the ground, left
 * those on +X, each named after its foot; head and tail go by name first, then by shape. Kind none gets no
 * gait, and a warning says so. */
sbf_status sbfi_propose_gait(sbfi_conversion *c);

#endif
