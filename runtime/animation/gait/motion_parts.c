/* Common parts of the kinds of gait: the speed of the state, and bones rotated within their limits. */
#include "animation/gait/motion_kinds.h"

bool sbri_has_motion(const sbri_rig *rig) {
  return rig->gait && (rig->gait->kind != SBF_GAIT_KIND_WALK || rig->gait->idle_clip != SBF_NONE ||
                          rig->gait->move_clip != SBF_NONE);
}

bool sbri_is_afloat(const sbri_rig *rig) {
  return sbri_is_kind(rig, SBF_GAIT_KIND_SWIM) || sbri_is_kind(rig, SBF_GAIT_KIND_FLY);
}

float sbri_motion_speed(const sbri_rig *rig, const sbri_gait_state *state) {
  float up = sbri_is_afloat(rig) ? sbri_motion(rig, (sbri_gait_state *)(uintptr_t)state)->up : 0;
  float level =
      state->motion.forward * state->motion.forward + state->motion.sideways * state->motion.sideways;
  return sqrtf(level + up * up) * state->stepping.speed_fraction;
}

sbf_quat sbri_motion_parent_rotation(
    const sbri_rig *rig, uint32_t bone, const sbr_transform *root, const sbr_transform *pose) {
  int32_t parent = rig->bones.parents[bone];
  if (parent < 0) return root->rotation;
  return sbri_quat_multiply(pose[parent].rotation, sbri_quat_conjugate(rig->bones.rest[parent].rotation));
}

void sbri_motion_rotate_bone(
    const sbri_rig *rig, uint32_t bone, sbf_quat to, const sbr_transform *root, sbr_transform *pose) {
  if (rig->bones.limits[bone].active) {
    sbf_quat parent =
        rig->bones.parents[bone] >= 0 ? pose[rig->bones.parents[bone]].rotation : root->rotation;
    sbf_quat local = sbri_quat_multiply(sbri_quat_conjugate(parent), to);
    to = sbri_quat_multiply(parent, sbri_joint_limit_clamp(&rig->bones.limits[bone], local));
  }
  to = sbri_quat_normalize(to);
  sbri_rig_rotate_bone(rig, bone, sbri_quat_multiply(to, sbri_quat_conjugate(pose[bone].rotation)), pose);
  pose[bone].rotation = to;
}
