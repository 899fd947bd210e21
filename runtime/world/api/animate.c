/* Public calls for animation. */
#include "animation/gait/gait_state.h"
#include "sbrun/animation.h"
#include "state/world.h"

enum { IK_TARGET_COOKIE = 0x5b72696b, CLIP_COOKIE = 0x5b72636c };

sbr_ik_target sbr_default_ik_target(void) {
  return (sbr_ik_target){.cookie = IK_TARGET_COOKIE, .rotation = {0, 0, 0, 1}};
}

sbr_clip_play sbr_default_clip_play(void) {
  return (sbr_clip_play){.cookie = CLIP_COOKIE, .weight = 1, .speed = 1, .bone_mask = SBF_NONE};
}

void sbr_character_set_ik_target(
    sbr_world *world, sbr_character_id character, uint32_t ik_chain, const sbr_ik_target *target) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c || ik_chain >= c->model->asset->ik_chains.count) return;
  if (target && target->cookie != IK_TARGET_COOKIE) return;
  if (target && target->weight <= 0) target = NULL;
  if (target && !sbri_record(world, SBRI_RECORDED_REACH,
                    (const double[]){character.value, ik_chain, target->position.x, target->position.y,
                        target->position.z, (double)target->rotation.x, (double)target->rotation.y,
                        (double)target->rotation.z, (double)target->rotation.w, (double)target->weight}))
    return;
  if (!target) sbri_record(world, SBRI_RECORDED_RELEASE, (const double[]){character.value, ik_chain});
  sbri_character_wake(c);
  sbri_limb_target *to = &sbri_limb_targets(&c->model->rig, sbri_gait(c))[ik_chain];
  *to = (sbri_limb_target){.weight = 0};
  if (!target) return;
  sbr_double3 origin = sbri_header(c)->origin;
  to->position = (sbf_vec3){(float)(target->position.x - origin.x), (float)(target->position.y - origin.y),
      (float)(target->position.z - origin.z)};
  to->rotation = sbri_quat_normalize(target->rotation);
  to->weight = sbri_clamp(target->weight, 0, 1);
}

void sbr_character_set_pivot_leg(sbr_world *world, sbr_character_id character, int32_t leg) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c || leg >= (int32_t)c->model->rig.leg_count) return;
  sbri_record(world, SBRI_RECORDED_PIVOT, (const double[]){character.value, leg});
  sbri_character_wake(c);
  ((sbri_gait_state *)sbri_gait(c))->stepping.pivot_leg = leg < 0 ? 0 : (uint32_t)leg + 1;
}

void sbr_character_play_clip(
    sbr_world *world, sbr_character_id character, uint32_t layer, int32_t clip, const sbr_clip_play *how) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c || !how || how->cookie != CLIP_COOKIE || layer >= SBRI_CLIP_LAYERS ||
      clip >= (int32_t)c->model->asset->clips.count)
    return;
  if (!sbri_record(world, SBRI_RECORDED_PLAY,
          (const double[]){character.value, layer, clip, (double)how->weight, (double)how->fade_s,
              (double)how->speed, (double)how->start_s, how->bone_mask}))
    return;
  sbri_character_wake(c);
  sbri_clip_layer *l = &((sbri_gait_state *)sbri_gait(c))->clips[layer];
  l->fade_s = how->fade_s > 0 ? how->fade_s : 0;
  l->target_weight = clip < 0 ? 0 : sbri_clamp(how->weight, 0, 1);
  if (clip < 0) return;
  if (l->clip_plus_1 != (uint32_t)clip + 1) l->time_s = how->start_s, l->weight = 0;
  l->clip_plus_1 = (uint32_t)clip + 1;
  l->mask_plus_1 = how->bone_mask < 0 ? 0 : (uint32_t)how->bone_mask + 1;
  l->speed = how->speed;
}
