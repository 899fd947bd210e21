/* Constraint rows between two iterations: their targets, their velocity changes, and which of them are
 * active. */
#include "rigid/joint_rows.h"

#include <string.h>

#include "rigid/sym6.h"

void sbri_joint_rows_set_targets(sbri_edge *e) {
  sbri_edge_list_active(e);
  if (e->ball)
    memset(e->ball->impulse, 0, sizeof e->ball->impulse), memset(e->ball->moment, 0, sizeof e->ball->moment);
  for (uint32_t r = 0; r < e->row_count; r++) {
    sbri_row *row = &e->rows[r];
    if (!row->is_saturated) row->impulse = 0;
    row->change.target = row->target - row->speed;
  }
  for (uint32_t r = 0; r < e->active_count; r++) e->rhs[r] = (double)e->rows[e->actives[r]].change.target;
}

/* The drive's part of its row's impulse: the rest is joint damping at the velocity after the solve. */
static float drive_impulse(const sbri_row *row) {
  return row->impulse + row->attached_mass * (row->target - row->compliance * row->impulse);
}

/* A drive at its limit becomes a constant impulse on the right-hand side. If the joint has damping as well,
 * the row stays in the system for the damping alone. */
static void saturate_drive(sbri_rigid_solving *work, const sbri_edge *e, sbri_row *row) {
  if (row->attached_mass > 0) {
    float max = drive_impulse(row) > 0 ? row->max : -row->max;
    row->compliance = 1 / row->attached_mass;
    row->target = row->compliance * max;
    row->max = 0;
    return;
  }
  row->impulse = row->impulse > 0 ? row->max : -row->max;
  row->is_saturated = true;
  row->active = false;
  for (int side = 0; side < SBRI_SIDES; side++)
    if (e->nodes[side] >= 0)
      sbri_add6_rates(work->system.nodes[e->nodes[side]].known_impulse, row->rates[side], row->impulse);
}

/* Changes of the relative angular velocity by the previous iteration and by the last one. */
static void find_relative_changes(
    const sbri_rigid_system *s, const sbri_edge *e, sbf_vec3 *previous, sbf_vec3 *now) {
  static const double none[6] = {0, 0, 0, 0, 0, 0};
  const int32_t a = e->nodes[SBRI_A], b = e->nodes[SBRI_B];
  const double *a_previous = a >= 0 ? s->nodes[a].previous : none,
               *b_previous = b >= 0 ? s->nodes[b].previous : none, *a_now = a >= 0 ? s->nodes[a].x : none,
               *b_now = b >= 0 ? s->nodes[b].x : none;
  *previous = sbri_vec3((float)(b_previous[3] - a_previous[3]), (float)(b_previous[4] - a_previous[4]),
      (float)(b_previous[5] - a_previous[5]));
  *now = sbri_vec3((float)(b_now[3] - a_now[3]), (float)(b_now[4] - a_now[4]), (float)(b_now[5] - a_now[5]));
}

/* Initialises a limit that is close to its bound now, as if it had been active since the beginning of the
 * step. */
static void activate_limit(sbri_rigid_solving *work, const sbri_rigid_model *model, sbri_edge *e,
    sbri_row *row, sbf_vec3 previous, float step_s) {
  sbri_joint_frames *joint_frames = &work->joint_frames[e - work->system.edges];
  row->clearance = 0;
  row->limit.position =
      sbri_joint_coordinate(&model->joints[e->joint], joint_frames, (sbf_joint_axis)row->axis);
  if (row->axis == SBF_JOINT_AXIS_TWIST)
    row->limit.position = sbri_nearest_twist(row->limit.position, row->limit.lower, row->limit.upper);
  sbri_limit_ready(work, model, e, joint_frames, row, step_s);
  row->change.target = row->target - row->speed;
  row->change.last =
      sbri_dot(sbri_vec3(row->rates[SBRI_B][3], row->rates[SBRI_B][4], row->rates[SBRI_B][5]), previous);
}

/* Upper bound of the friction torque as a multiple of the static torque: it matters in impacts. */
static const float MAX_DRY_FACTOR = 2;

static bool slip_ball(const sbri_rigid_system *s, sbri_edge *e) {
  sbri_ball *ball = e->ball;
  if (!(ball->dry_friction > 0)) return false;
  sbf_vec3 previous, now;
  find_relative_changes(s, e, &previous, &now);
  const double *initial = ball->attached_rhs;
  double relative_speed = (double)sbri_length(
      sbri_vec3(now.x - (float)initial[0], now.y - (float)initial[1], now.z - (float)initial[2]));
  if (!(ball->dry_friction * relative_speed > (double)MAX_DRY_FACTOR * ball->max_dry_friction)) return false;
  double dry = ball->max_dry_friction / relative_speed;
  ball->attached_inertia += dry - ball->dry_friction;
  ball->dry_friction = dry;
  return true;
}

static bool slip_row(sbri_row *row) {
  if (!row->active || !(row->dry_friction > 0)) return false;
  float relative_speed = fabsf(row->target - row->compliance * row->impulse),
        force = row->target / row->compliance;
  if (!(row->dry_friction * relative_speed > MAX_DRY_FACTOR * row->max_dry_friction)) return false;
  float dry = row->max_dry_friction / relative_speed, rate = 1 / row->compliance + dry - row->dry_friction;
  row->attached_mass += dry - row->dry_friction;
  row->dry_friction = dry;
  row->compliance = 1 / rate;
  row->target = row->compliance * force;
  return true;
}

static void move_ball(sbri_rigid_solving *work, const sbri_rigid_model *model, sbri_edge *e, float step_s) {
  const double *initial =
      e->ball->attached_rhs; /* minus their relative angular velocity at the beginning of the step */
  sbf_vec3 previous, now;
  find_relative_changes(&work->system, e, &previous, &now);
  sbf_vec3 relative = {now.x - (float)initial[0], now.y - (float)initial[1], now.z - (float)initial[2]};
  float reach = sbri_max_rotation_change(sbri_length(relative), step_s);
  for (uint32_t r = 0; r < e->row_count; r++) {
    sbri_row *row = &e->rows[r];
    if (row->clearance > 0 && row->clearance <= reach) activate_limit(work, model, e, row, previous, step_s);
    if (!row->sign) continue;
    row->change.previous = row->change.last;
    row->change.last =
        sbri_dot(sbri_vec3(row->rates[SBRI_B][3], row->rates[SBRI_B][4], row->rates[SBRI_B][5]), now);
  }
}

void sbri_joint_rows_move(sbri_rigid_solving *work, const sbri_rigid_model *model, float step_s) {
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    sbri_edge *e = &work->system.edges[i];
    if (e->ball) move_ball(work, model, e, step_s);
    for (uint32_t r = 0; r < e->row_count && !e->ball; r++) {
      sbri_row *row = &e->rows[r];
      if (!row->sign) continue;
      row->change.previous = row->change.last;
      row->change.last = (float)sbri_row_rate_change(&work->system, e, row);
    }
  }
}

bool sbri_joint_rows_agree(const sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    for (uint32_t r = 0; r < e->row_count; r++) {
      const sbri_row *row = &e->rows[r];
      if (row->kind == SBRI_ROW_LIMIT &&
          row->active != ((float)row->sign * (row->change.target - row->change.last) > 0))
        return false;
    }
  }
  return true;
}

void sbri_joint_rows_scale_back(sbri_rigid_solving *work, float fraction) {
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    for (uint32_t r = 0; r < e->row_count; r++) {
      sbri_row *row = &e->rows[r];
      row->change.last = row->change.previous + fraction * (row->change.last - row->change.previous);
    }
  }
}

bool sbri_joint_rows_check(const sbri_rigid_tick *t, sbri_rigid_solving *work, sbri_edge *e, float step_s) {
  bool changed = false, slips = false;
  for (uint32_t r = 0; r < e->row_count; r++) {
    sbri_row *row = &e->rows[r];
    if (row->sign) {
      bool previous = row->active;
      float speed = row->speed;
      if (!previous && row->kind == SBRI_ROW_LIMIT)
        sbri_limit_choose_side(row, speed + row->change.last, step_s);
      row->change.target = row->target - speed;
      row->active = sbri_limit_acts(row, speed + row->change.last, step_s);
      if (!row->active) row->impulse = 0;
      changed = changed || row->active != previous;
    } else if (row->active && row->max > 0 && fabsf(drive_impulse(row)) > row->max * 1.0001f) {
      saturate_drive(work, e, row);
      changed = true;
    } else if (slip_row(row)) {
      slips = true;
    }
  }
  if (e->ball && slip_ball(&work->system, e)) slips = true;
  return changed || (slips && !t->coarse);
}
