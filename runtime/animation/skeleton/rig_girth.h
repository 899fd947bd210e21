/* Collision volume of a body: spheres that walls keep out. */
#ifndef SBRI_RIG_GIRTH_H
#define SBRI_RIG_GIRTH_H

#include "animation/skeleton/rig.h"

/* Sets `girth`, after legs, tails and the gait's rest pose are known. */
void sbri_rig_find_girth(sbri_rig *rig);

#endif
