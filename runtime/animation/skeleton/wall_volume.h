/* Collision volume of a body: spheres that walls keep out. */
#ifndef SBRI_WALL_VOLUME_H
#define SBRI_WALL_VOLUME_H

#include "animation/skeleton/rig.h"

/* Sets `wall_volume`, after legs, tails and the gait's rest pose are known. */
void sbri_rig_find_wall_volume(sbri_rig *rig);

#endif
