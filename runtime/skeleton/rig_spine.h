/* What kinds of gait other than walking need of a rig: its bounds, the chain of its wave, its rest pose. */
#ifndef SBRI_RIG_SPINE_H
#define SBRI_RIG_SPINE_H

#include "skeleton/rig.h"

/* Bytes of the tables, and their making in a block of that size, after the bones are known. */
size_t sbri_rig_spine_size(const sbf_asset *asset);
void sbri_rig_find_spine(sbri_rig *rig, void *memory);

#endif
