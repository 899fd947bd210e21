/* How much room a body takes: balls in it, which walls keep out. */
#ifndef SBRI_RIG_GIRTH_H
#define SBRI_RIG_GIRTH_H

#include "skeleton/rig.h"

/* Sets `girth`, after legs, tails and the gait's rest pose are known. */
void sbri_rig_find_girth(sbri_rig *rig);

#endif
