/* The scene that a file would have held in which the input's objects hang in the rig's node tree. */
#ifndef SBFI_RIGGED_SCENE_H
#define SBFI_RIGGED_SCENE_H

#include "import/rigging/rigging.h"

/* Makes it of what `r` says and puts it into the conversion, memory of whose scratch it is; nodes of the rig
 * keep their numbers. False where memory runs out. */
bool sbfi_rigged_scene_take(const sbfi_rigging *r);

#endif
