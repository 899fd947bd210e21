/* The skeleton as the runtime uses it: constant tables of a rig, and a pose.
 *
 * Bone frames are as in the asset: +Y from head to tail. A pose holds every bone's frame in world axes,
 * relative to the character's origin, already scaled. */
#ifndef SBRI_RIG_H
#define SBRI_RIG_H

#include "sbrun/sbrun.h"

typedef struct sbri_rig {
  const sbf_asset *asset;
  uint32_t bone_count;
  const int32_t *parents;          /* bone_count; -1: root */
  const sbr_transform *rest;       /* bone_count, asset space */
  const sbr_transform *rest_local; /* bone_count, relative to the parent's rest frame */
} sbri_rig;

#endif
