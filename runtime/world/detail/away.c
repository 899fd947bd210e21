/* Offscreen characters: gait without a body. The position follows the command over the ground; the last pose
 * moves along; nothing is stepped. */
#include "coupling/ragdoll/ragdoll.h"
#include "math/quat.h"
#include "soft/soft.h"
#include "state/pose/frames.h"
#include "world/detail/detail_levels.h"

static void move_frame(
    sbr_transform *frame, const sbr_transform *from, const sbr_transform *to, sbf_quat rotation) {
  sbf_vec3 arm = sbri_sub(frame->position, from->position);
  frame->position = sbri_add(to->position, sbri_rotate(rotation, arm));
  frame->rotation = sbri_quat_normalize(sbri_quat_multiply(rotation, frame->rotation));
}

void sbri_away_tick(const sbr_world *world, sbri_character *c) {
  const sbr_model *model = c->model;
  sbr_transform *pose = sbri_pose(c);
  uint32_t root = sbri_root_frame(model), anchor = sbri_anchor_frame(model);
  sbr_transform from = pose[root];
  sbri_surroundings around;
  sbri_gait_input input = sbri_gait_input_of(world, c, &around);
  sbri_gait_travel(&model->rig, sbri_gait(c), &input);
  sbr_transform to = sbri_current_root_frame(c, input.ground);
  if (from.position.x == to.position.x && from.position.y == to.position.y &&
      from.position.z == to.position.z && from.rotation.y == to.rotation.y &&
      from.rotation.w == to.rotation.w)
    return;
  sbf_quat rotation =
      sbri_quat_normalize(sbri_quat_multiply(to.rotation, sbri_quat_conjugate(from.rotation)));
  for (uint32_t f = 0; f < model->frame_count; f++)
    if (f != root && f != anchor) move_frame(&pose[f], &from, &to, rotation);
  pose[root] = to;
}

void sbri_away_arrive(const sbr_world *world, sbri_character *c) {
  sbri_surroundings around;
  sbri_gait_input input = sbri_gait_input_of(world, c, &around);
  sbr_transform *pose = sbri_pose(c);
  sbri_gait_arrive(&c->model->rig, sbri_gait(c), &input);
  sbri_gait_pose(&c->model->rig, sbri_gait(c), &input, true, pose);
  pose[sbri_root_frame(c->model)] = sbri_current_root_frame(c, input.ground);
  sbri_rigid_frames_follow(c, pose);
  sbri_rigid_move_with_pose(c);
  sbri_character_stop(c);
}
