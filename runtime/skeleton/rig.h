/* The skeleton as the runtime uses it: constant tables of a rig, shared by all characters of a model.
 *
 * Bone frames are as in the asset: +Y from head to tail. A pose holds every bone's frame in world axes,
 * relative to the character's origin, already scaled. */
#ifndef SBRI_RIG_H
#define SBRI_RIG_H

#include "sbrun/sbrun.h"

/* A leg as the gait uses it: three bones of the chain, and what the rest pose says of it. Or two, a peg: the
 * upper one swings the foot, and how far the foot is from it says nothing of how far the leg may reach. */
typedef struct sbri_leg {
  int32_t upper, lower, foot; /* bones: thigh, shin (-1: a peg), and the one whose head is the ankle */
  sbf_vec3 pole;              /* asset space, rest pose */
  int32_t pole_bone;          /* the pole moves with it; -1: with the root */
  sbf_vec3 home;              /* ankle at rest, asset space, y above the sole's ground */
  float upper_length, lower_length;
  uint32_t group;
  bool hind; /* hangs on the hips; else on the chest */
  float copy_rotation, soft_reach;
} sbri_leg;

typedef struct sbri_tail {
  const uint32_t *bones; /* bone_count, from the leading one */
  uint32_t bone_count;
  uint32_t first_state; /* place of its first bone among all tails' bones */
  float frequency, damping_ratio, limit;
} sbri_tail;

enum { SBRI_MOST_LEGS = 16 };

typedef struct sbri_rig {
  const sbf_asset *asset;
  uint32_t bone_count;
  const int32_t *parents;          /* bone_count; -1: root */
  const sbr_transform *rest;       /* bone_count, asset space */
  const sbr_transform *rest_local; /* bone_count, in the parent's rest frame; a root's as it is */
  const float *spine_share; /* bone_count: 0 turns with the hips, 1 with the chest, -1 with its parent */

  const sbf_gait *gait; /* the asset's first; NULL: the character is moved as a whole */
  sbri_leg legs[SBRI_MOST_LEGS];
  uint32_t leg_count;
  const sbri_tail *tails;
  uint32_t tail_count, tail_bone_count;
  float hind_z, fore_z; /* mean z of the homes of hind and fore legs, asset space */
  float half_width;     /* mean |x| of the homes */
} sbri_rig;

/* Bytes the tables take, and their making in a block of that size. The asset must outlive the rig. A leg
 * whose chain is neither thigh, shin and foot nor a peg and its foot is left out. */
size_t sbri_rig_size(const sbf_asset *asset);
void sbri_rig_init(sbri_rig *rig, const sbf_asset *asset, void *memory);

/* Turns a bone, and all that hangs on it, about the bone's head. */
void sbri_rig_turn(const sbri_rig *rig, uint32_t bone, sbf_quat turn, sbr_transform *pose);

/* Moves a bone, and all that hangs on it. */
void sbri_rig_shift(const sbri_rig *rig, uint32_t bone, sbf_vec3 by, sbr_transform *pose);

#endif
