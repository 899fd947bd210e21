/* Points of the body that are kept above the ground. */
#ifndef SBRI_RIG_BELLY_H
#define SBRI_RIG_BELLY_H

#include "animation/skeleton/rig.h"

/* Sets the rig's `belly`, after the roles of the bones are known. */
void sbri_rig_find_belly(sbri_rig *rig);

#endif
