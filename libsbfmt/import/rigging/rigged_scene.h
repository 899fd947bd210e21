/* Builds the scene of a hypothetical file in which the input's objects are part of the rig's node tree. */
#ifndef SBFI_RIGGED_SCENE_H
#define SBFI_RIGGED_SCENE_H

#include "import/rigging/rigging.h"

/* Builds it from `r` and stores it in the conversion, whose scratch owns the memory. Nodes of the rig keep
 * their indices. False if memory runs out. */
bool sbfi_rigged_scene_build(const sbfi_rigging *r);

#endif
