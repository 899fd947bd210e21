/* The area under a foot that needs ground. */
#ifndef SBRI_RIG_SOLES_H
#define SBRI_RIG_SOLES_H

#include "animation/skeleton/rig.h"

/* Sets the leg's `sole`, `home`, `ankle` and what depends on them, from bodies and skins on its foot. */
void sbri_rig_find_sole(const sbri_rig *rig, sbri_leg *leg);

#endif
