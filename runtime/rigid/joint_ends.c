/* Position errors of joints at the end of a step, and restitution of limits. */
#include "rigid/joint_rows.h"

#include <string.h>

/* Maximum rates of error correction, in m/s and rad/s. */
static const float MAX_CORRECTION_M_S = 20, MAX_CORRECTION_RAD_S = 60;
/* A step is repeated if an inactive limit is violated by more than this. */
static const float MAX_VIOLATION = 2e-3f;

static sbf_vec3 along_axes(const sbri_joint_frames *joint_frames, sbf_vec3 v) {
  return sbri_add_scaled(sbri_add_scaled(sbri_scale(joint_frames->axes[0], v.x), joint_frames->axes[1], v.y),
      joint_frames->axes[2], v.z);
}

/* Position error of a ball joint. */
static float correct_ball(sbri_ball *ball, sbf_vec3 target, sbf_vec3 separation, float step_s) {
  sbf_vec3 error = sbri_sub(target, separation);
  float rates[3] = {error.x / step_s, error.y / step_s, error.z / step_s}, worst = 0;
  for (int k = 0; k < 3; k++) {
    ball->rhs[k] = (double)sbri_clamp(rates[k], -MAX_CORRECTION_M_S, MAX_CORRECTION_M_S);
    ball->attached_rhs[k] = 0;
  }
  const float parts[3] = {fabsf(error.x), fabsf(error.y), fabsf(error.z)};
  for (int k = 0; k < 3; k++) worst = parts[k] > worst ? parts[k] : worst;
  return worst;
}

static float correct_rows(
    sbri_edge *e, const sbri_rigid_joint *joint, sbri_joint_frames *joint_frames, float step_s) {
  float worst = 0;
  for (uint32_t r = 0; r < e->active_count; r++) {
    const sbri_row *row = &e->rows[e->actives[r]];
    sbf_joint_axis axis = (sbf_joint_axis)row->axis;
    e->rhs[r] = 0;
    if (row->kind > SBRI_ROW_LIMIT) continue;
    bool is_locked = row->kind == SBRI_ROW_LOCKED && joint->locked >> axis & 1;
    float now = is_locked ? sbri_joint_locked_coordinate(joint_frames, axis)
                          : sbri_joint_coordinate(joint, joint_frames, axis);
    if (axis == SBF_JOINT_AXIS_TWIST && !is_locked) now = sbri_nearest_twist(now, row->end, row->end);
    float error = row->end - now;
    if (row->kind == SBRI_ROW_LIMIT && !((float)row->sign * error > 0)) continue;
    e->rhs[r] = (double)sbri_clamped_rate(axis, error / step_s, MAX_CORRECTION_M_S, MAX_CORRECTION_RAD_S);
    worst = fabsf(error) > worst ? fabsf(error) : worst;
  }
  return worst;
}

/* Maximum violation of inactive limits, except those out of reach. */
static float find_violation(
    const sbri_edge *e, const sbri_rigid_joint *joint, sbri_joint_frames *joint_frames, float reach) {
  float worst = 0;
  for (uint32_t r = 0; r < e->row_count; r++) {
    const sbri_row *row = &e->rows[r];
    if (row->kind != SBRI_ROW_LIMIT || row->active || row->clearance > reach) continue;
    float now = sbri_joint_coordinate(joint, joint_frames, (sbf_joint_axis)row->axis);
    if (row->axis == SBF_JOINT_AXIS_TWIST) now = sbri_nearest_twist(now, row->limit.lower, row->limit.upper);
    float violation = now < row->limit.lower ? row->limit.lower - now : now - row->limit.upper;
    float violation_at_begin = row->limit.position < row->limit.lower
                                   ? row->limit.lower - row->limit.position
                                   : row->limit.position - row->limit.upper;
    if (violation > MAX_VIOLATION && violation > violation_at_begin)
      worst = violation > worst ? violation : worst;
  }
  return worst;
}

/* Maximum relative rotation of a ball joint's bodies in the step. */
static float reach_in_step(
    const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_edge *e, float step_s) {
  if (!e->ball) return 0;
  const sbri_rigid_joint *joint = &model->joints[e->joint];
  return sbri_max_rotation_change(sbri_length(sbri_sub(sbri_side_motion(work, model, joint, SBRI_B)->turn,
                                      sbri_side_motion(work, model, joint, SBRI_A)->turn)),
      step_s);
}

/* Whether only the point of a ball joint needs to be checked at the end of the step. */
static bool is_bare_ball(const sbri_edge *e, float reach) {
  if (!e->ball || e->ball->end.x != 0 || e->ball->end.y != 0 || e->ball->end.z != 0) return false;
  for (uint32_t r = 0; r < e->row_count; r++)
    if (e->rows[r].kind <= SBRI_ROW_LIMIT && !(e->rows[r].clearance > reach)) return false;
  return true;
}

float sbri_joint_rows_correct(
    const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t edge, float step_s) {
  sbri_edge *e = &work->system.edges[edge];
  const sbri_rigid_joint *joint = &t->model->joints[e->joint];
  bool any = e->ball != NULL;
  for (uint32_t r = 0; r < e->row_count; r++) /* an inactive limit may be violated */
    any = any || e->rows[r].kind == SBRI_ROW_LIMIT;
  for (uint32_t r = 0; r < e->active_count; r++) any = any || e->rows[e->actives[r]].kind <= SBRI_ROW_LIMIT;
  if (!any) {
    for (uint32_t r = 0; r < e->active_count; r++) e->rhs[r] = 0;
    return 0;
  }
  const sbr_transform *poses[SBRI_SIDES] = {&sbri_side_motion(work, t->model, joint, SBRI_A)->to,
      &sbri_side_motion(work, t->model, joint, SBRI_B)->to};
  sbf_vec3 fine = sbri_sub(sbri_side_motion(work, t->model, joint, SBRI_B)->fine_to,
      sbri_side_motion(work, t->model, joint, SBRI_A)->fine_to);
  float reach = reach_in_step(work, t->model, e, step_s);
  if (is_bare_ball(e, reach)) {
    for (uint32_t r = 0; r < e->active_count; r++) e->rhs[r] = 0;
    return correct_ball(e->ball, sbri_vec3(0, 0, 0), sbri_joint_separation(joint, poses, fine), step_s);
  }
  sbri_joint_frames joint_frames = sbri_joint_frames_of(joint, poses, &t->anchor, fine);
  float position_error = 0;
  if (e->ball)
    position_error =
        correct_ball(e->ball, along_axes(&joint_frames, e->ball->end), joint_frames.separation, step_s);
  float error = correct_rows(e, joint, &joint_frames, step_s),
        violation = find_violation(e, joint, &joint_frames, reach);
  float worst = error > violation ? error : violation;
  return worst > position_error ? worst : position_error;
}

bool sbri_joint_rows_bounce(const sbri_rigid_solving *work, sbri_edge *e, const sbri_rigid_model *model) {
  bool any = false;
  if (e->ball) {
    memset(e->ball->rhs, 0, sizeof e->ball->rhs);
    memset(e->ball->attached_rhs, 0, sizeof e->ball->attached_rhs);
  }
  for (uint32_t r = 0; r < e->active_count; r++) {
    const sbri_row *row = &e->rows[e->actives[r]];
    e->rhs[r] = 0;
    if (!(row->limit.bounce_speed > 0)) continue;
    e->rhs[r] = (float)row->sign * row->limit.bounce_speed -
                sbri_row_speed(work, model, &model->joints[e->joint], row);
    any = true;
  }
  return any;
}
