/* Followers: bones that follow their own animated pose as second-order systems. */
#include "animation/gait/gait_state.h"

/* animation/gait/squash.c, animation/gait/weight.c */
static bool in_world(const sbf_follower *source) {
  return source->channel == SBF_FOLLOWER_CHANNEL_SQUASH || source->channel == SBF_FOLLOWER_CHANNEL_WEIGHT;
}

void sbri_followers_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift) {
  sbri_bone_follower *followers = sbri_bone_followers(rig, state);
  for (uint32_t i = 0; i < rig->asset->followers.count; i++) {
    if (!in_world(&rig->asset->followers.at[i])) continue;
    sbri_position_follower *follower = &followers[i].position;
    follower->value = sbri_sub(follower->value, shift);
    follower->followed = sbri_sub(follower->followed, shift);
  }
}

void sbri_followers_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbri_advance advance, sbr_transform *pose) {
  sbri_bone_follower *followers = sbri_bone_followers(rig, state);
  for (uint32_t i = 0; i < rig->asset->followers.count; i++) {
    const sbf_follower *source = &rig->asset->followers.at[i];
    uint32_t b = (uint32_t)source->bone;
    if (in_world(source)) continue;
    const sbr_transform *parent = rig->bones.parents[b] >= 0 ? &pose[rig->bones.parents[b]] : root;
    sbf_quat back = sbri_quat_conjugate(parent->rotation);
    sbf_vec3 position = sbri_rotate(back, sbri_sub(pose[b].position, parent->position));
    position = sbri_scale(position, 1 / input->scale);
    sbf_quat rotation = sbri_quat_normalize(sbri_quat_multiply(back, pose[b].rotation));
    if (advance == SBRI_ADVANCE_RESET) {
      sbri_position_follower_reset(&followers[i].position, position);
      sbri_rotation_follower_reset(&followers[i].turn, rotation);
    } else if (advance == SBRI_ADVANCE_TICK) {
      sbri_follower_step step =
          sbri_follower_step_of(source->frequency, source->damping_ratio, source->response, input->tick_s);
      sbri_position_follower_tick(&followers[i].position, position, &step);
      sbri_rotation_follower_tick(&followers[i].turn, rotation, &step);
    }
    if (source->channel != SBF_FOLLOWER_CHANNEL_POSITION) {
      sbf_quat to = sbri_quat_multiply(parent->rotation, followers[i].turn.value);
      sbri_rig_rotate_bone(rig, b, sbri_quat_multiply(to, sbri_quat_conjugate(pose[b].rotation)), pose);
    }
    if (source->channel != SBF_FOLLOWER_CHANNEL_ROTATION) {
      sbf_vec3 at = sbri_scale(followers[i].position.value, input->scale);
      at = sbri_add(parent->position, sbri_rotate(parent->rotation, at));
      sbri_rig_shift(rig, b, sbri_sub(at, pose[b].position), pose);
    }
  }
}
