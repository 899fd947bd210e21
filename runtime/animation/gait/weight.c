/* Weight: a bone follows its position in the world with a lag. The vertical lag lowers or raises it; the
 * horizontal lag makes it lean in that direction, for any heading of the body. */
#include "animation/gait/gait_state.h"
#include "math/quat.h"

static bool is_weight(const sbri_rig *rig, const sbf_follower *source) {
  return source->channel == SBF_FOLLOWER_CHANNEL_WEIGHT && rig->bones.roles[source->bone] != SBRI_ROLE_LEG;
}

/* The lag in lengths of the bone, smoothly limited in any direction. */
static sbf_vec3 limited_lag(
    const sbf_follower *source, const sbri_position_follower *follower, float length) {
  sbf_vec3 lag = sbri_scale(sbri_sub(follower->value, follower->followed), source->strength / length);
  return sbri_scale(lag, source->limit / (source->limit + sbri_length(lag)));
}

/* Vertical displacement: downwards at most by the belly's clearance. */
static float vertical_shift(const sbri_rig *rig, const sbri_gait_state *state, float lag) {
  float clearance = rig->leg_count ? state->balance.clearance.value - state->posture.lowered : -lag;
  return lag < -clearance ? -(clearance > 0 ? clearance : 0) : lag;
}

/* Rotation by the length of the horizontal vector `aside`, in rad, that leans the bone in its direction. */
static sbf_quat tilt_towards(sbf_vec3 aside) {
  return sbri_quat_exp(sbri_vec3(aside.z, 0, -aside.x));
}

/* Moves a bone and its children. Bones below a thigh are posed later. */
static void move_bone(const sbri_rig *rig, uint32_t bone, sbf_quat lean, float up, sbr_transform *pose) {
  sbf_vec3 head = pose[bone].position;
  for (uint32_t k = rig->bones.subtree_begin[bone]; k < rig->bones.subtree_end[bone]; k++) {
    uint32_t b = rig->bones.subtree[k];
    if (rig->bones.roles[b] == SBRI_ROLE_LEG) continue;
    pose[b].position = sbri_add(head, sbri_rotate(lean, sbri_sub(pose[b].position, head)));
    pose[b].position.y += up;
    pose[b].rotation = sbri_quat_normalize(sbri_quat_multiply(lean, pose[b].rotation));
  }
}

bool sbri_weights_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose) {
  sbri_bone_follower *followers = sbri_bone_followers(rig, state);
  bool moved = false;
  for (uint32_t i = 0; i < rig->asset->followers.count; i++) {
    const sbf_follower *source = &rig->asset->followers.at[i];
    uint32_t b = (uint32_t)source->bone;
    float length = rig->asset->bones.at[b].length * input->scale;
    sbri_position_follower *follower = &followers[i].position;
    if (!is_weight(rig, source)) continue;
    if (advance == SBRI_ADVANCE_RESET) {
      sbri_position_follower_reset(follower, pose[b].position);
    } else if (advance == SBRI_ADVANCE_TICK) {
      sbri_follower_step step =
          sbri_follower_step_of(source->frequency, source->damping_ratio, source->response, input->tick_s);
      sbri_position_follower_tick(follower, pose[b].position, &step);
    }
    if (input->keeps_rest_pose || !(length > 0)) continue;
    sbf_vec3 lag = limited_lag(source, follower, length);
    if (lag.x == 0 && lag.y == 0 && lag.z == 0) continue;
    move_bone(rig, b, tilt_towards(lag), vertical_shift(rig, state, lag.y * length), pose);
    moved = true;
  }
  return moved;
}
