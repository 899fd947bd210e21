/* Squash and stretch: everything on a bone follows its head on a spring. It is long while the bone
 * accelerates away and short while the bone brakes; its volume stays constant. */
#include "animation/gait/gait_state.h"
#include "math/quat.h"

static bool is_squash(const sbf_follower *source) {
  return source->channel == SBF_FOLLOWER_CHANNEL_SQUASH;
}

sbf_vec3 sbri_squash_axis(const sbf_follower *source) {
  return sbri_vec3(
      source->axis == SBF_BONE_AXIS_X, source->axis == SBF_BONE_AXIS_Y, source->axis == SBF_BONE_AXIS_Z);
}

/* The scale for a lag in lengths of the bone; saturates smoothly at the limits. */
static float stretch_of(float lag, float limit) {
  float eased = limit * lag / (limit + fabsf(lag));
  return eased >= 0 ? 1 + eased : 1 / (1 - eased);
}

/* Position of a point on a squashed bone, world axes. */
static sbf_vec3 squashed_point(const sbr_transform *bone, sbf_vec3 axis, float stretch, sbf_vec3 position) {
  sbf_vec3 offset = sbri_sub(position, bone->position);
  float across = 1 / sqrtf(stretch);
  sbf_vec3 at = sbri_add_scaled(bone->position, offset, across);
  return sbri_add_scaled(at, axis, (stretch - across) * sbri_dot(axis, offset));
}

/* Child bones move along unscaled; bones below a thigh are posed later. */
static void shift_children(
    const sbri_rig *rig, uint32_t bone, sbf_vec3 axis, float stretch, sbr_transform *pose) {
  sbf_vec3 shift = {0, 0, 0};
  for (uint32_t k = rig->bones.subtree_begin[bone] + 1; k < rig->bones.subtree_end[bone]; k++) {
    uint32_t b = rig->bones.subtree[k];
    if (rig->bones.roles[b] == SBRI_ROLE_LEG) continue;
    if (rig->bones.parents[b] == (int32_t)bone)
      shift = sbri_sub(squashed_point(&pose[bone], axis, stretch, pose[b].position), pose[b].position);
    pose[b].position = sbri_add(pose[b].position, shift);
  }
}

void sbri_squashes_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose) {
  sbri_bone_follower *followers = sbri_bone_followers(rig, state);
  for (uint32_t i = 0; i < rig->asset->followers.count; i++) {
    const sbf_follower *source = &rig->asset->followers.at[i];
    uint32_t b = (uint32_t)source->bone;
    sbri_bone_follower *follower = &followers[i];
    float length = rig->asset->bones.at[b].length;
    if (!is_squash(source)) continue;
    sbf_vec3 axis = sbri_rotate(pose[b].rotation, sbri_squash_axis(source));
    if (advance == SBRI_ADVANCE_RESET) {
      sbri_position_follower_reset(&follower->position, pose[b].position);
      follower->stretch = follower->stretch_before = 1;
    } else if (advance == SBRI_ADVANCE_TICK) {
      sbri_follower_step step =
          sbri_follower_step_of(source->frequency, source->damping_ratio, source->response, input->tick_s);
      sbri_position_follower_tick(&follower->position, pose[b].position, &step);
      float lag = sbri_dot(axis, sbri_sub(follower->position.value, pose[b].position));
      follower->stretch =
          length > 0 ? stretch_of(source->strength * lag / (length * input->scale), source->limit) : 1;
    }
    if (!input->keeps_rest_pose && follower->stretch != 1)
      shift_children(rig, b, axis, follower->stretch, pose);
  }
}

void sbri_gait_begin_tick(const sbri_rig *rig, void *state) {
  sbri_bone_follower *followers = sbri_bone_followers(rig, state);
  for (uint32_t i = 0; i < rig->asset->followers.count; i++)
    followers[i].stretch_before = followers[i].stretch;
}

float sbri_gait_stretch(const sbri_rig *rig, const void *state, uint32_t follower, float fraction) {
  const sbf_follower *source = &rig->asset->followers.at[follower];
  if (!is_squash(source)) return 1;
  const sbri_bone_follower *f = sbri_bone_followers(rig, (sbri_gait_state *)(uintptr_t)state) + follower;
  return fraction >= 1 ? f->stretch : f->stretch_before + (f->stretch - f->stretch_before) * fraction;
}
