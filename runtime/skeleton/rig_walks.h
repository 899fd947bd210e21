/* Makes the walks of a rig. */
#ifndef SBRI_RIG_WALKS_H
#define SBRI_RIG_WALKS_H

#include "skeleton/rig.h"

/* Bytes that the tables take, and their making there; after bones and legs of the rig. */
size_t sbri_walks_size(const sbf_asset *asset);
void sbri_walks_init(sbri_walks *walks, const sbri_rig *rig, void *memory);

/* The bone that stands where another's mirror image in the plane x = 0 would; itself where none does. */
uint32_t sbri_mirror_bone(const sbri_rig *rig, uint32_t bone);

#endif
