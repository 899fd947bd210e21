/* What has to have ground under a foot. */
#ifndef SBRI_RIG_SOLES_H
#define SBRI_RIG_SOLES_H

#include "skeleton/rig.h"

/* The leg's `sole`, `home`, `ankle` and what follows of them, of bodies and skins that hang on its foot. */
void sbri_rig_find_sole(const sbri_rig *rig, sbri_leg *leg);

#endif
