/* Makes another pose of the rig its bind pose. */
#ifndef SBFI_MOVED_BONES_H
#define SBFI_MOVED_BONES_H

#include "import/rigging/rigging.h"

/* Moves the asset's bones and a copy of the rig's nodes, which replaces its scene. `motions` (bones) are
 * rotations and offsets in asset space. False if memory runs out. */
bool sbfi_rig_move_bones(sbfi_rigging *r, const sbfi_matrix *motions);

/* Rotates the rig's whole space, with the asset's bones and the aligned input. */
void sbfi_rig_turn(sbfi_rigging *r, const sbfi_matrix *turn);

#endif
