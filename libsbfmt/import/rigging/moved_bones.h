/* Another pose of the rig as the one that skins are bound in. */
#ifndef SBFI_MOVED_BONES_H
#define SBFI_MOVED_BONES_H

#include "import/rigging/rigging.h"

/* Moves the asset's bones and a copy of the rig's nodes, which takes the place of its scene. `motions`
 * (bones) are in asset space: rotations and offsets. False where memory runs out. */
bool sbfi_rig_move_bones(sbfi_rigging *r, const sbfi_matrix *motions);

#endif
