/* Tables of a rig for kinds of gait other than walking: bounds, chain of the wave, rest pose. */
#ifndef SBRI_RIG_SPINE_H
#define SBRI_RIG_SPINE_H

#include "animation/skeleton/rig.h"

/* Size of the tables in bytes; and the build in a block of that size, after the bones are known. */
size_t sbri_rig_spine_size(const sbf_asset *asset);
void sbri_rig_find_spine(sbri_rig *rig, void *memory);

#endif
