/* What of the body is kept off the ground. */
#ifndef SBRI_RIG_BELLY_H
#define SBRI_RIG_BELLY_H

#include "skeleton/rig.h"

/* The rig's `belly`, once the bones' roles are known. */
void sbri_rig_find_belly(sbri_rig *rig);

#endif
