/* Builds the walks of a rig. */
#ifndef SBRI_RIG_WALKS_H
#define SBRI_RIG_WALKS_H

#include "animation/skeleton/rig.h"

/* Size of the tables in bytes; and the build there, after bones and legs of the rig. */
size_t sbri_walks_size(const sbf_asset *asset);
void sbri_walks_init(sbri_walks *walks, const sbri_rig *rig, void *memory);

/* The bone at the mirrored position in the plane x = 0; itself if there is none. */
uint32_t sbri_mirror_bone(const sbri_rig *rig, uint32_t bone);

#endif
