/* What a joint asks of its bodies in a substep, row by row.
 *
 * A row aims at the substep's end: a coordinate that is held is to be at its value then, one that is limited
 * not beyond its bound. Springs and dampers act with the force that they have at the end as well, linearised:
 * h (k (c0 - c - h c') + d (v0 - c')) is a row with the give 1 / (h^2 k + h d), stable at any stiffness. */
#include "math/trig.h"
#include "mechanics/joint_freedom.h"
#include "rigid/rigid_work.h"
#include "rigid/sym6.h"

static const float TURN = 6.28318530718f;

/* What is off when a step begins, as of a character that is placed so, is put right no faster than this, in
 * m/s and rad/s. */
static const float MEND_M_S = 1, MEND_RAD_S = 4;
/* And what is off at its end, no faster than that. */
static const float MOST_MEND_M_S = 20, MOST_MEND_RAD_S = 60;
/* A limit that is broken by more, having been found to be free, makes a step one to be taken again. */
static const float MISSED = 2e-3f;
/* How much stiffer limits are than the lighter of their bodies is heavy; what they give way by is put right
 * at the step's end. */
static const double FIRM = 1e5;
/* Slower than this nothing bounces off a limit. */
static const float BOUNCE_FROM = 0.05f;

static float speed_of(const sbri_rigid_solving *work, const sbri_rigid_model *model,
    const sbri_rigid_joint *joint, const sbri_row *row) {
  float speed = 0;
  for (int side = 0; side < SBRI_SIDES; side++) {
    const sbri_part_motion *m = sbri_side_motion(work, model, joint, side);
    const double v[6] = {m->velocity.x, m->velocity.y, m->velocity.z, m->turn.x, m->turn.y, m->turn.z};
    speed += (float)sbri_dot6_rates(row->rates[side], v);
  }
  return speed;
}

/* Of the angles that mean the same twist the one least outside of the range. */
static float nearest_turn(float value, float low, float high) {
  float outside = value < low ? low - value : value > high ? value - high : 0, best = value;
  for (int way = -1; way <= 1; way += 2) {
    float other = value + (float)way * TURN;
    float beyond = other < low ? low - other : other > high ? other - high : 0;
    if (beyond < outside) outside = beyond, best = other;
  }
  return best;
}

typedef struct row_maker {
  const sbri_rigid_tick *tick;
  sbri_rigid_solving *work;
  const sbri_rigid_joint *joint;
  sbri_joint_place *place;
  sbri_edge *edge;
  float step_s;
} row_maker;

static sbri_row *add_row(row_maker *m, sbri_row_kind kind, sbf_joint_axis axis) {
  sbri_row *row = &m->edge->rows[m->edge->row_count++];
  sbri_joint_gradient(m->joint, m->place, axis, row->rates);
  row->target = row->give = row->most = row->bound = row->bounce = row->impulse = row->flesh = 0;
  row->wanted = row->was = row->moved = 0;
  row->sign = 0;
  row->kind = (uint8_t)kind, row->axis = (uint8_t)axis;
  row->active = true, row->full = false;
  return row;
}

static float clamped(sbf_joint_axis axis, float rate, float most_m_s, float most_rad_s) {
  float most = sbri_axis_turns(axis) ? most_rad_s : most_m_s;
  return sbri_clamp(rate, -most, most);
}

static void aim(sbri_row *row, float off, float step_s) {
  row->target = clamped((sbf_joint_axis)row->axis, off / step_s, MEND_M_S, MEND_RAD_S);
}

static void add_held(row_maker *m, sbf_joint_axis axis) {
  float now = sbri_joint_held_coordinate(m->place, axis);
  sbri_row *row = add_row(m, SBRI_ROW_HELD, axis);
  aim(row, -now, m->step_s);
  row->end = now + m->step_s * row->target;
}

/* A coordinate kept at a value that need not be 0. */
static void add_kept(row_maker *m, sbf_joint_axis axis, float value) {
  float now = sbri_joint_coordinate(m->joint, m->place, axis);
  if (axis == SBF_JOINT_AXIS_TWIST) now = nearest_turn(now, value, value);
  sbri_row *row = add_row(m, SBRI_ROW_HELD, axis);
  row->bound = value;
  aim(row, value - now, m->step_s);
  row->end = now + m->step_s * row->target;
}

static void soften(
    const row_maker *m, sbri_row *row, float stiffness, float damping, float off, float velocity) {
  float kick_s = m->work->kick_s;
  row->give = 1 / (kick_s * (m->step_s * stiffness + damping));
  row->target = row->give * kick_s * (stiffness * off + damping * velocity);
}

/* The bound that the coordinate comes nearer to at that speed. */
static void choose_side(sbri_row *row, float speed, float step_s) {
  float next = row->now + step_s * speed;
  bool low = next - row->low < row->high - next;
  row->sign = low ? 1 : -1;
  row->bound = low ? row->low : row->high;
  if (row->kind != SBRI_ROW_LIMIT) return;
  float most = sbri_axis_turns((sbf_joint_axis)row->axis) ? MEND_RAD_S : MEND_M_S;
  float back = (row->bound - row->now) / step_s;
  row->target = low ? (back > most ? most : back) : (back < -most ? -most : back);
  row->end = row->now + step_s * row->target;
}

/* A spring acts beyond its bound only, and pushes only. */
static bool acts(const sbri_row *row, float speed, float step_s) {
  float sign = row->sign;
  bool pushes = sign * (row->target - speed) > 0;
  return pushes && (row->kind == SBRI_ROW_LIMIT || sign * (row->bound - row->now - step_s * speed) > 0);
}

static void add_limit(row_maker *m, const sbf_limit *limit) {
  sbf_joint_axis axis = limit->target;
  bool soft = limit->stiffness > 0;
  if (limit->min == limit->max && !soft) {
    add_kept(m, axis, limit->min);
    return;
  }
  float now = sbri_joint_coordinate(m->joint, m->place, axis);
  if (axis == SBF_JOINT_AXIS_TWIST) now = nearest_turn(now, limit->min, limit->max);
  sbri_row *row = add_row(m, soft ? SBRI_ROW_SPRING : SBRI_ROW_LIMIT, axis);
  float speed = speed_of(m->work, m->tick->model, m->joint, row);
  row->now = now, row->low = limit->min, row->high = limit->max;
  /* A length is never below 0: there it has no direction either, and must hold nothing. */
  if ((axis == SBF_JOINT_AXIS_SWING || axis == SBF_JOINT_AXIS_DISTANCE) && limit->min <= 0)
    row->low = -INFINITY;
  choose_side(row, speed, m->step_s);
  if (soft)
    soften(m, row, limit->stiffness, limit->damping, row->bound - now, 0);
  else
    row->give = (float)(sbri_row_alone(&m->work->system, m->edge, row) / FIRM);
  bool pressed = m->tick->joints[m->edge->joint].pressed >> ((m->edge->row_count - 1) & 31) & 1;
  row->active = pressed || acts(row, speed, m->step_s);
  float into = -(float)row->sign * speed;
  if (!soft && row->active && into > BOUNCE_FROM) row->bounce = limit->restitution * into;
}

static void add_drive(row_maker *m, const sbf_drive *drive) {
  if (!(drive->stiffness > 0 || drive->damping > 0)) return;
  float now = sbri_joint_coordinate(m->joint, m->place, drive->target), off = drive->position - now;
  if (drive->target == SBF_JOINT_AXIS_TWIST) off = sbri_angle_between(drive->position, now);
  sbri_row *row = add_row(m, SBRI_ROW_DRIVE, drive->target);
  soften(m, row, drive->stiffness, drive->damping, off, drive->velocity);
  row->most = drive->maximum * m->work->kick_s;
}

/* Between bones: the flesh about the joint damps it, and where it is driven draws it towards what the
 * animation has the two bodies turned against each other; about the axes that turn. */
static void add_track(row_maker *m) {
  const sbri_rigid_tick *t = m->tick;
  const sbri_rigid_joint *joint = m->joint;
  int32_t a = joint->bodies[SBRI_A], b = joint->bodies[SBRI_B], owner = m->edge->nodes[SBRI_B] < 0 ? a : b;
  if (a < 0 || b < 0 || t->model->bodies[a].source->bone < 0 || t->model->bodies[b].source->bone < 0) return;
  bool driven = t->bodies[owner].mode == SBR_RIGID_DRIVEN;
  float share = driven ? t->bodies[owner].share : 0, w = TURN * t->drive->frequency_hz;
  float inertia = joint->reach_inertia, stiffness = share * inertia * w * w;
  float flesh = t->drive->joint_damping_1_s * inertia;
  float damping = 2 * t->drive->damping_ratio * share * inertia * w + flesh;
  if (!(stiffness > 0 || damping > 0)) return;
  sbf_vec3 off = {0, 0, 0};
  if (stiffness > 0) {
    sbf_quat wanted = sbri_quat_multiply(m->work->motions[a].from.rotation,
        sbri_quat_multiply(sbri_quat_conjugate(t->targets[a].rotation), t->targets[b].rotation));
    off = sbri_quat_log(sbri_quat_multiply(wanted, sbri_quat_conjugate(m->work->motions[b].from.rotation)));
  }
  for (int k = 0; k < 3; k++) {
    if (joint->held >> (SBF_JOINT_AXIS_TWIST + k) & 1) continue;
    sbri_row *row = add_row(m, SBRI_ROW_TRACK, SBF_JOINT_AXIS_TWIST);
    const sbf_vec3 *u = &m->place->axes[k];
    const float along[6] = {0, 0, 0, u->x, u->y, u->z};
    for (int i = 0; i < 6; i++) row->rates[SBRI_B][i] = along[i], row->rates[SBRI_A][i] = -along[i];
    soften(m, row, stiffness, damping, sbri_dot(off, *u), 0);
    row->most = share * t->drive->strength * joint->hold_torque * m->work->kick_s;
    row->flesh = flesh * m->work->kick_s;
  }
}

void sbri_joint_rows_make(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t edge, float step_s) {
  sbri_edge *e = &work->system.edges[edge];
  const sbri_rigid_joint *joint = &t->model->joints[e->joint];
  const sbf_joint *source = joint->source;
  row_maker m = {t, work, joint, &work->places[edge], e, step_s};
  const sbr_transform *poses[SBRI_SIDES] = {&sbri_side_motion(work, t->model, joint, SBRI_A)->from,
      &sbri_side_motion(work, t->model, joint, SBRI_B)->from};
  sbf_vec3 fine = sbri_sub(sbri_side_motion(work, t->model, joint, SBRI_B)->fine_from,
      sbri_side_motion(work, t->model, joint, SBRI_A)->fine_from);
  *m.place = sbri_joint_place_of(joint, poses, &t->anchor, fine);
  e->row_count = 0;
  for (int axis = SBF_JOINT_AXIS_LINEAR_X; axis <= SBF_JOINT_AXIS_SWING_Z; axis++)
    if (joint->held >> axis & 1) add_held(&m, (sbf_joint_axis)axis);
  bool bounded = false;
  for (uint32_t i = 0; i < source->limits.count; i++) {
    const sbf_limit *limit = &source->limits.at[i];
    if (!sbfi_joint_is_free(source->kind, limit->target)) continue;
    bounded = bounded || limit->target == SBF_JOINT_AXIS_DISTANCE;
    add_limit(&m, limit);
  }
  if (!bounded && source->kind == SBF_JOINT_KIND_DISTANCE)
    add_kept(&m, SBF_JOINT_AXIS_DISTANCE, joint->rest_distance);
  if (!bounded && source->kind == SBF_JOINT_KIND_PULLEY)
    add_limit(
        &m, &(sbf_limit){.target = SBF_JOINT_AXIS_DISTANCE, .min = -INFINITY, .max = joint->rest_distance});
  for (uint32_t i = 0; i < source->drives.count; i++)
    if (sbfi_joint_is_free(source->kind, source->drives.at[i].target)) add_drive(&m, &source->drives.at[i]);
  add_track(&m);
}

void sbri_joint_rows_aim(const sbri_rigid_solving *work, sbri_edge *e, const sbri_rigid_model *model) {
  const sbri_rigid_joint *joint = &model->joints[e->joint];
  sbri_edge_list_active(e);
  for (uint32_t r = 0; r < e->row_count; r++) {
    sbri_row *row = &e->rows[r];
    if (!row->full) row->impulse = 0;
    if (row->sign) row->wanted = row->target - speed_of(work, model, joint, row);
  }
  for (uint32_t r = 0; r < e->active_count; r++) {
    const sbri_row *row = &e->rows[e->actives[r]];
    e->rhs[r] = row->target - speed_of(work, model, joint, row);
  }
}

/* What a drive gives of its row's impulse: all but what the flesh takes at the speed that the row leaves. */
static float of_drive(const sbri_row *row) {
  return row->impulse + row->flesh * (row->target - row->give * row->impulse);
}

/* A drive's greatest impulse goes into the motions at once; it then takes no part. Where there is flesh as
 * well the row goes on as that, with the greatest impulse on top. */
static void give_most(sbri_rigid_solving *work, const sbri_edge *e, sbri_row *row) {
  if (row->flesh > 0) {
    float most = of_drive(row) > 0 ? row->most : -row->most;
    row->give = 1 / row->flesh;
    row->target = row->give * most;
    row->most = 0;
    return;
  }
  row->impulse = row->impulse > 0 ? row->most : -row->most;
  row->full = true;
  row->active = false;
  for (int side = 0; side < SBRI_SIDES; side++)
    if (e->nodes[side] >= 0)
      sbri_add6_rates(work->system.nodes[e->nodes[side]].push, row->rates[side], row->impulse);
}

void sbri_joint_rows_move(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    for (uint32_t r = 0; r < e->row_count; r++) {
      sbri_row *row = &e->rows[r];
      if (!row->sign) continue;
      row->was = row->moved;
      row->moved = (float)sbri_row_moved(&work->system, e, row);
    }
  }
}

void sbri_joint_rows_hold_back(sbri_rigid_solving *work, float share) {
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    for (uint32_t r = 0; r < e->row_count; r++) {
      sbri_row *row = &e->rows[r];
      row->moved = row->was + share * (row->moved - row->was);
    }
  }
}

bool sbri_joint_rows_judge(
    sbri_rigid_solving *work, sbri_edge *e, const sbri_rigid_model *model, float step_s, bool *other) {
  bool changed = false;
  for (uint32_t r = 0; r < e->row_count; r++) {
    sbri_row *row = &e->rows[r];
    if (row->sign) {
      bool was = row->active;
      float speed = speed_of(work, model, &model->joints[e->joint], row);
      if (!was && row->kind == SBRI_ROW_LIMIT) choose_side(row, speed + row->moved, step_s);
      row->wanted = row->target - speed;
      row->active = acts(row, speed + row->moved, step_s);
      if (row->kind == SBRI_ROW_SPRING && row->active != was) *other = true;
      if (!row->active) row->impulse = 0;
      changed = changed || row->active != was;
    } else if (row->active && row->most > 0 && fabsf(of_drive(row)) > row->most * 1.0001f) {
      give_most(work, e, row);
      changed = *other = true;
    }
  }
  return changed;
}

float sbri_joint_rows_correct(
    const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t edge, float step_s) {
  sbri_edge *e = &work->system.edges[edge];
  const sbri_rigid_joint *joint = &t->model->joints[e->joint];
  bool any = false;
  float worst = 0;
  for (uint32_t r = 0; r < e->row_count; r++) /* a limit that was not seen to be run into */
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
  sbri_joint_place place = sbri_joint_place_of(joint, poses, &t->anchor, fine);
  for (uint32_t r = 0; r < e->active_count; r++) {
    const sbri_row *row = &e->rows[e->actives[r]];
    sbf_joint_axis axis = (sbf_joint_axis)row->axis;
    e->rhs[r] = 0;
    if (row->kind > SBRI_ROW_LIMIT) continue;
    bool at_zero = row->kind == SBRI_ROW_HELD && joint->held >> axis & 1;
    float now =
        at_zero ? sbri_joint_held_coordinate(&place, axis) : sbri_joint_coordinate(joint, &place, axis);
    if (axis == SBF_JOINT_AXIS_TWIST && !at_zero) now = nearest_turn(now, row->end, row->end);
    float off = row->end - now;
    if (row->kind == SBRI_ROW_LIMIT && !((float)row->sign * off > 0)) continue;
    e->rhs[r] = clamped(axis, off / step_s, MOST_MEND_M_S, MOST_MEND_RAD_S);
    worst = fabsf(off) > worst ? fabsf(off) : worst;
  }
  for (uint32_t r = 0; r < e->row_count; r++) {
    const sbri_row *row = &e->rows[r];
    if (row->kind != SBRI_ROW_LIMIT || row->active) continue;
    float now = sbri_joint_coordinate(joint, &place, (sbf_joint_axis)row->axis);
    if (row->axis == SBF_JOINT_AXIS_TWIST) now = nearest_turn(now, row->low, row->high);
    float beyond = now < row->low ? row->low - now : now - row->high;
    float begun = row->now < row->low ? row->low - row->now : row->now - row->high;
    if (beyond > MISSED && beyond > begun) worst = beyond > worst ? beyond : worst;
  }
  return worst;
}

bool sbri_joint_rows_bounce(const sbri_rigid_solving *work, sbri_edge *e, const sbri_rigid_model *model) {
  bool any = false;
  for (uint32_t r = 0; r < e->active_count; r++) {
    const sbri_row *row = &e->rows[e->actives[r]];
    e->rhs[r] = 0;
    if (!(row->bounce > 0)) continue;
    e->rhs[r] = (float)row->sign * row->bounce - speed_of(work, model, &model->joints[e->joint], row);
    any = true;
  }
  return any;
}
