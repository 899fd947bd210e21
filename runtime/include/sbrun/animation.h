/* Animation: targets for limbs, clips, and measures of a pose.
 *
 * Rules are those of sbrun.h: setters ignore invalid handles, getters then return zeros. No call allocates.
 * Everything set here is state, stored in snapshots. */
#ifndef SBRUN_ANIMATION_H
#define SBRUN_ANIMATION_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Targets for limbs -------------------------------------------------------------------------------- */

/* Target of an IK chain's end. Begin with the default. */
typedef struct sbr_ik_target {
  uint32_t cookie;      /* set by sbr_default_ik_target; without it the call does nothing */
  sbr_double3 position; /* world: target of the end bone's head */
  sbf_quat rotation;    /* world: target rotation, weighted by the chain's copy_rotation */
  float weight;         /* 0 to 1: blend from the pose without the target to the solved one */
} sbr_ik_target;
/* Position at the world's origin, no rotation, weight 0. */
SBF_API sbr_ik_target sbr_default_ik_target(void);

/* Sets the target of one of the asset's ik_chains from the next tick on; NULL removes it. It acts on the
 * finished pose, walking legs included, with the chain's own solver, pole, comfort pose and tolerance, within
 * the joints' limits. FABRIK chains with a common root are solved as one tree. Chains of more than 64 bones
 * are ignored. */
SBF_API void sbr_character_set_ik_target(
    sbr_world *world, sbr_character_id character, uint32_t ik_chain, const sbr_ik_target *target);

/* Sets the leg of the gait, from 0, about whose planted foot the character rotates; -1: about the body's
 * centre. */
SBF_API void sbr_character_set_pivot_leg(sbr_world *world, sbr_character_id character, int32_t leg);

/* ---- Clips -------------------------------------------------------------------------------------------- */

/* Settings of a clip. Begin with the default. */
typedef struct sbr_clip_play {
  uint32_t cookie;   /* set by sbr_default_clip_play; without it the call does nothing */
  float weight;      /* 0 to 1: weight of the layer over lower layers */
  float fade_s;      /* time of the change to this weight; 0: at once */
  float speed;       /* 1: as keyed; negative: backwards */
  float start_s;     /* start time in the clip; ignored if it already plays in the layer */
  int32_t bone_mask; /* of the asset's bone_masks; SBF_NONE: all bones */
} sbr_clip_play;
/* Weight 1, at once, as keyed, from its start, all bones. */
SBF_API sbr_clip_play sbr_default_clip_play(void);

/* Plays a clip of the asset in one of four layers (from 0; higher layers override lower ones), below the
 * gait: heads, tails, chains, legs and limbs with targets still move on top of it. The gait keeps the body
 * bone's motion along the ground; scales are not played. SBF_NONE fades the layer's clip out. */
SBF_API void sbr_character_play_clip(
    sbr_world *world, sbr_character_id character, uint32_t layer, int32_t clip, const sbr_clip_play *how);

/* Retargets the clips of another asset's skeleton to this asset's bones and adds them to its clips, for
 * sbr_character_play_clip. One library of motion can thus move every character. `asset` may be a loaded one;
 * no model may have been made from it, and no other thread may use it during the call.
 *
 * Bones correspond by retarget_chains of the same name, in the order of their fractions along the chain; else
 * by equal names, or by names for the same part of the same side (LeftUpLeg, thigh.L). Each bone rotates from
 * its rest pose as its counterpart does. Thighs, shins, upper and lower arms point in the same direction as
 * their counterparts, whatever the two rest poses are. The hips travel in proportion to their height. Bones
 * without a counterpart follow their parents.
 *
 * `name` (may be NULL) is the source of the clips, for messages and for clips without a name. `report` (may
 * be NULL) receives each clip (IMPORT_MOTION) and the bones without a counterpart (IMPORT_MOTION_UNMATCHED).
 * SBF_BAD_INPUT: `from` has no clip, or no bone with a counterpart. SBF_FAILED: memory ran out. On failure
 * the asset keeps the clips it had. */
SBF_API sbf_status sbr_asset_retarget_clips(sbf_asset *asset, const sbf_asset *from, const char *name,
    void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user, sbf_diagnostic *error);

/* ---- Measures of a pose -----------------------------------------------------------------------------------
 */

/* Maximum violation of a joint limit over all bones after the last tick, rad; 0: none. */
SBF_API float sbr_character_get_limit_violation(const sbr_world *world, sbr_character_id character);
/* Centre of mass after the last tick, relative to the origin. A bone has the mass of the soft bodies on it,
 * or of the skin that follows it. False if the bones have neither. */
SBF_API bool sbr_character_get_center_of_mass(
    const sbr_world *world, sbr_character_id character, sbf_vec3 *center);

#ifdef __cplusplus
}
#endif
#endif
