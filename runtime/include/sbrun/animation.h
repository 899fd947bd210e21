/* The animation layer beyond driving: targets for limbs, and what a pose is judged by.
 *
 * The same rules as in sbrun.h: handles that name nothing are ignored, getters then return zeros; nothing
 * allocates; everything set here is state, which snapshots hold. */
#ifndef SBRUN_ANIMATION_H
#define SBRUN_ANIMATION_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Targets for limbs -------------------------------------------------------------------------------- */

/* What the end of an IK chain reaches for. Begin with zeros and rotation {0, 0, 0, 1}. */
typedef struct sbr_ik_target {
  sbr_double3 position; /* world: where the end bone's head should be */
  sbf_quat rotation;    /* world: what the end bone takes as much of as the chain's copy_rotation says */
  float weight;         /* 0 (none) to 1: between the pose without it and the solved one */
} sbr_ik_target;

/* Gives one of the asset's ik_chains a target from the next tick on, until it is given another; NULL takes it
 * away. It acts on the finished pose, legs that walk included, with the chain's own method, pole, comforts
 * and tolerance, within the joints' limits. Chains that share their root and name FABRIK reach as one tree. A
 * chain of more than 64 bones has no effect. */
SBF_API void sbr_character_ik_target(
    sbr_world *world, sbr_character_id character, uint32_t ik_chain, const sbr_ik_target *target);

/* Turns about the foot of a leg of the gait, from 0, which stays planted as the others walk round it; -1:
 * about the body's middle again. */
SBF_API void sbr_character_pivot(sbr_world *world, sbr_character_id character, int32_t leg);

/* ---- Clips -------------------------------------------------------------------------------------------- */

/* How a clip is played. Begin with zeros and weight, speed 1. */
typedef struct sbr_clip_play {
  float weight;      /* 0 to 1, of the layer over those below */
  float fade_s;      /* over which the weight goes there from what it is; 0: at once */
  float speed;       /* 1: as keyed; negative: backwards */
  float start_s;     /* where in the clip it begins, if it is not the one that plays in the layer already */
  int32_t bone_mask; /* of the asset's bone_masks; SBF_NONE: all bones */
} sbr_clip_play;

/* Plays a clip of the asset in one of four layers (from 0; higher ones over lower ones), under the gait:
 * heads, tails, chains, legs and limbs with targets move as ever on top of it. What a clip does to the gait's
 * body bone along the ground is left to the gait; scales are not played. SBF_NONE fades the layer's clip out.
 */
SBF_API void sbr_character_play(
    sbr_world *world, sbr_character_id character, uint32_t layer, int32_t clip, const sbr_clip_play *how);

/* Carries the clips of another asset's skeleton over to this one's bones and adds them to its clips, for
 * sbr_character_play: a library of motion, loaded once, moves every character. It changes `asset`, which no
 * model may have been made of yet, and which no other thread may use meanwhile; it may be a loaded one.
 *
 * Bones stand for each other by retarget_chains of one name, bone by bone by their share of the chain; else
 * by their names, or by names that mean the same part of the same side (LeftUpLeg, thigh.L). Each turns away
 * from its rest pose as its counterpart does; thighs, shins, upper and lower arms point as their counterparts
 * do, whatever the two rest poses. The hips travel in proportion to their height. Bones without a counterpart
 * go along with their parents.
 *
 * `name` (may be NULL) says where the clips come from, in messages and for clips without a name. `report`
 * (may be NULL) is told of each clip (IMPORT_MOTION) and of bones without a counterpart
 * (IMPORT_MOTION_UNMATCHED). SBF_BAD_INPUT: `from` has no clip, or no bone that stands for one; SBF_FAILED:
 * memory ran out. The asset then has the clips that it had. */
SBF_API sbf_status sbr_carry_clips(sbf_asset *asset, const sbf_asset *from, const char *name,
    void (*report)(void *user, const sbf_diagnostic *finding), void *user, sbf_diagnostic *error);

/* ---- Judging a pose ----------------------------------------------------------------------------------- */

/* By how much the worst bone breaks its joint's limits, rad, as of the last tick; 0: none does. */
SBF_API float sbr_character_limit_excess(const sbr_world *world, sbr_character_id character);
/* The centre of mass as of the last tick, relative to the origin: bones weigh as much as the soft bodies on
 * them, or as the skin that follows them. False where nothing hangs on the bones. */
SBF_API bool sbr_character_center(const sbr_world *world, sbr_character_id character, sbf_vec3 *center);

#ifdef __cplusplus
}
#endif
#endif
