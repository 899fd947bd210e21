/* Chains that swing as pendulums, and the shapes that they collide with. */
#ifndef SBRI_RIG_SPRINGS_H
#define SBRI_RIG_SPRINGS_H

#include "animation/skeleton/rig.h"

/* Memory for the rig's springs, bytes. */
size_t sbri_rig_springs_size(const sbf_asset *asset);

/* Fills rig->springs. A chain that the gait moves as a tail does not swing. */
void sbri_rig_find_springs(sbri_rig *rig, void *memory);

#endif
