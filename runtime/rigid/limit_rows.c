/* Rows of limits: speeds, sides, and the reach of a step. */
#include "rigid/joint_rows.h"

#include "rigid/sym6.h"

static const float TURN = 6.28318530718f;
/* Stiffness of limits relative to the lighter body's inertia. The position error that this leaves is
 * corrected at the end of the step. */
static const double FIRM = 1e5;
/* Upper bound of the rate of swing and twist, as a multiple of the relative angular speed; and a margin for
 * steps of finite length. */
static const float REACH = 1.4f, REACH_MIN = 0.02f;

float sbri_row_speed(const sbri_rigid_solving *work, const sbri_rigid_model *model,
    const sbri_rigid_joint *joint, const sbri_row *row) {
  float speed = 0;
  for (int side = 0; side < SBRI_SIDES; side++) {
    const sbri_part_motion *m = sbri_side_motion(work, model, joint, side);
    const double v[6] = {m->velocity.x, m->velocity.y, m->velocity.z, m->turn.x, m->turn.y, m->turn.z};
    speed += (float)sbri_dot6_rates(row->rates[side], v);
  }
  return speed;
}

float sbri_nearest_twist(float value, float low, float high) {
  float outside = value < low ? low - value : value > high ? value - high : 0, best = value;
  for (int direction = -1; direction <= 1; direction += 2) {
    float other = value + (float)direction * TURN;
    float beyond = other < low ? low - other : other > high ? other - high : 0;
    if (beyond < outside) outside = beyond, best = other;
  }
  return best;
}

void sbri_limit_choose_side(sbri_row *row, float speed, float step_s) {
  float next = row->limit.position + step_s * speed;
  bool low = next - row->limit.lower < row->limit.upper - next;
  row->sign = low ? 1 : -1;
  row->bound = low ? row->limit.lower : row->limit.upper;
  if (row->kind != SBRI_ROW_LIMIT) return;
  float max = sbri_axis_is_angular((sbf_joint_axis)row->axis) ? SBRI_CORRECTION_RAD_S : SBRI_CORRECTION_M_S;
  float back = (row->bound - row->limit.position) / step_s;
  row->target = low ? (back > max ? max : back) : (back < -max ? -max : back);
  row->end = row->limit.position + step_s * row->target;
}

bool sbri_limit_acts(const sbri_row *row, float speed, float step_s) {
  float sign = row->sign;
  bool pushes = sign * (row->target - speed) > 0;
  return pushes &&
         (row->kind == SBRI_ROW_LIMIT || sign * (row->bound - row->limit.position - step_s * speed) > 0);
}

float sbri_max_rotation_change(float turn_rad_s, float step_s) {
  return REACH * step_s * turn_rad_s + REACH_MIN;
}

void sbri_limit_ready(const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_edge *e,
    sbri_joint_frames *joint_frames, sbri_row *row, float step_s) {
  const sbri_rigid_joint *joint = &model->joints[e->joint];
  sbri_joint_compute_gradient(joint, joint_frames, (sbf_joint_axis)row->axis, row->rates);
  row->speed = sbri_row_speed(work, model, joint, row);
  sbri_limit_choose_side(row, row->speed, step_s);
  row->compliance = (float)(sbri_row_response(&work->system, e, row) / FIRM);
}
