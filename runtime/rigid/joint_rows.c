/* Constraint rows of a joint in a substep.
 *
 * A row has its target at the end of the substep: a locked coordinate is at its value then, a limited one
 * within its bounds. Springs and dampers act with their force at the end as well, linearised: h (k (c0 - c -
 * h c') + d (v0 - c')) is a row with compliance 1 / (h^2 k + h d), stable at any stiffness. */
#include "rigid/joint_rows.h"
#include "math/trig.h"
#include "mechanics/joint_freedom.h"

/* For a larger swing, or a smaller w of the rotation, the distance to a limit needs an arctangent. */
static const float CLEAR_SWING = 0.9f, CLEAR_TURN = 0.6f;
/* rad/s: below it dry friction is static, above it kinetic. Static friction is stronger by a factor, so that
 * a joint that breaks loose does not creep. */
static const float STATIC_RAD_S = 0.001f, STATIC_EXCESS = 0.25f, KINETIC_FACTOR = 5;
/* Minimum speed of a bounce off a limit. */
static const float BOUNCE_FROM = 0.05f;

typedef struct row_maker {
  const sbri_rigid_tick *tick;
  sbri_rigid_solving *work;
  const sbri_rigid_joint *joint;
  sbri_joint_frames *frames;
  sbri_edge *edge;
  float step_s;
  float turn_rad_s; /* of a ball joint: relative angular speed of its bodies */
} row_maker;

/* Adds a row without rates. */
static sbri_row *add_bare_row(row_maker *m, sbri_row_kind kind, sbf_joint_axis axis) {
  sbri_row *row = &m->edge->rows[m->edge->row_count++];
  row->target = row->compliance = row->max = row->bound = row->limit.bounce_speed = row->impulse =
      row->attached_mass = 0;
  row->dry_friction = row->max_dry_friction = 0;
  row->change.target = row->change.previous = row->change.last = row->clearance = row->speed = 0;
  row->sign = 0;
  row->kind = (uint8_t)kind, row->axis = (uint8_t)axis;
  row->active = true, row->is_saturated = false;
  return row;
}

static sbri_row *add_row(row_maker *m, sbri_row_kind kind, sbf_joint_axis axis) {
  sbri_row *row = add_bare_row(m, kind, axis);
  sbri_joint_compute_gradient(m->joint, m->frames, axis, row->rates);
  row->speed = sbri_row_speed(m->work, m->tick->model, m->joint, row);
  return row;
}

static void set_target(sbri_row *row, float error, float step_s) {
  row->target = sbri_clamped_rate(
      (sbf_joint_axis)row->axis, error / step_s, SBRI_CORRECTION_M_S, SBRI_CORRECTION_RAD_S);
}

static void add_locked(row_maker *m, sbf_joint_axis axis) {
  float now = sbri_joint_locked_coordinate(m->frames, axis);
  sbri_row *row = add_row(m, SBRI_ROW_LOCKED, axis);
  set_target(row, -now, m->step_s);
  row->end = now + m->step_s * row->target;
}

/* Adds a row that locks a coordinate at a value other than 0. */
static void add_locked_at(row_maker *m, sbf_joint_axis axis, float value) {
  float now = sbri_joint_coordinate(m->joint, m->frames, axis);
  if (axis == SBF_JOINT_AXIS_TWIST) now = sbri_nearest_twist(now, value, value);
  sbri_row *row = add_row(m, SBRI_ROW_LOCKED, axis);
  row->bound = value;
  set_target(row, value - now, m->step_s);
  row->end = now + m->step_s * row->target;
}

static void make_soft(
    const row_maker *m, sbri_row *row, float stiffness, float damping, float error, float velocity) {
  float kick_s = m->work->kick_s;
  row->compliance = 1 / (kick_s * (m->step_s * stiffness + damping));
  row->target = row->compliance * kick_s * (stiffness * error + damping * velocity);
}

/* Lower bound of the distance from the bounds, without an arctangent. Below 0: unknown. */
static float min_distance_of(const sbri_row *row, const sbri_joint_frames *joint_frames) {
  float swing = 2 * sqrtf(joint_frames->half_tangent[0] * joint_frames->half_tangent[0] +
                          joint_frames->half_tangent[1] * joint_frames->half_tangent[1]);
  float w = fabsf(joint_frames->rotation.w);
  if (!(swing < CLEAR_SWING && w > CLEAR_TURN)) return -1;
  if (row->axis == SBF_JOINT_AXIS_SWING) return row->limit.lower > 0 ? -1 : row->limit.upper - swing;
  if (row->axis != SBF_JOINT_AXIS_TWIST) return -1;
  float twist = 2 * fabsf(joint_frames->rotation.x) / w,
        min = row->limit.upper < -row->limit.lower ? row->limit.upper : -row->limit.lower;
  return min - twist;
}

/* Whether the limit is out of reach in this step. */
static bool is_clear(const row_maker *m, sbri_row *row) {
  if (!m->edge->ball) return false;
  float clear = min_distance_of(row, m->frames);
  if (!(clear > sbri_max_rotation_change(m->turn_rad_s, m->step_s))) return false;
  row->clearance = clear, row->limit.position = row->limit.upper - clear;
  row->active = false;
  return true;
}

/* Lengths and swings are at least 0. At 0 they have no direction, so a lower limit there must be inactive. */
static float min_of(const sbf_limit *limit) {
  bool length = limit->target == SBF_JOINT_AXIS_SWING || limit->target == SBF_JOINT_AXIS_DISTANCE;
  return length && limit->min <= 0 ? -INFINITY : limit->min;
}

static void add_limit(row_maker *m, const sbf_limit *limit) {
  sbf_joint_axis axis = limit->target;
  bool soft = limit->stiffness > 0;
  if (limit->min == limit->max && !soft) {
    add_locked_at(m, axis, limit->min);
    return;
  }
  sbri_row *row = add_bare_row(m, soft ? SBRI_ROW_SPRING : SBRI_ROW_LIMIT, axis);
  bool pressed = m->tick->joints[m->edge->joint].pressed >> ((m->edge->row_count - 1) & 31) & 1;
  row->limit.lower = min_of(limit), row->limit.upper = limit->max;
  if (!soft && !pressed && is_clear(m, row)) return;
  float now = sbri_joint_coordinate(m->joint, m->frames, axis);
  if (axis == SBF_JOINT_AXIS_TWIST) now = sbri_nearest_twist(now, limit->min, limit->max);
  row->limit.position = now;
  sbri_limit_ready(m->work, m->tick->model, m->edge, m->frames, row, m->step_s);
  if (soft) make_soft(m, row, limit->stiffness, limit->damping, row->bound - now, 0);
  row->active = pressed || sbri_limit_acts(row, row->speed, m->step_s);
  float into = -(float)row->sign * row->speed;
  if (!soft && row->active && into > BOUNCE_FROM) row->limit.bounce_speed = limit->restitution * into;
}

static void add_drive(row_maker *m, const sbf_drive *drive) {
  if (!(drive->stiffness > 0 || drive->damping > 0)) return;
  float now = sbri_joint_coordinate(m->joint, m->frames, drive->target), error = drive->position - now;
  if (drive->target == SBF_JOINT_AXIS_TWIST) error = sbri_angle_between(drive->position, now);
  sbri_row *row = add_row(m, SBRI_ROW_DRIVE, drive->target);
  make_soft(m, row, drive->stiffness, drive->damping, error, drive->velocity);
  row->max = drive->maximum * m->work->kick_s;
}

/* Relative angular speed of the bodies at the beginning of the step. */
static float relative_speed_of(const row_maker *m) {
  if (m->edge->ball) return m->turn_rad_s;
  const sbri_rigid_model *model = m->tick->model;
  return sbri_length(sbri_sub(sbri_side_motion(m->work, model, m->joint, SBRI_B)->turn,
      sbri_side_motion(m->work, model, m->joint, SBRI_A)->turn));
}

/* Joints between bones, about their free axes: damping by the tissue around the joint, and, where the joint
 * is driven, a pull towards the animated relative rotation. Dry friction is the damping that gives its torque
 * at the current relative angular velocity; bodies that hardly rotate are held, except for a creep below
 * STATIC_RAD_S. */
static void add_track(row_maker *m) {
  const sbri_rigid_tick *t = m->tick;
  const sbri_rigid_joint *joint = m->joint;
  int32_t a = joint->bodies[SBRI_A], b = joint->bodies[SBRI_B], owner = m->edge->nodes[SBRI_B] < 0 ? a : b;
  if (a < 0 || b < 0 || t->model->bodies[a].source->bone < 0 || t->model->bodies[b].source->bone < 0) return;
  bool driven = t->bodies[owner].mode == SBR_RIGID_DRIVEN;
  float fraction = driven ? t->bodies[owner].fraction : 0, w = 6.28318530718f * t->drive->frequency_hz;
  float inertia = joint->reach_inertia, stiffness = fraction * inertia * w * w;
  float relative_speed = relative_speed_of(m),
        loosened = (relative_speed / STATIC_RAD_S - 1) / (KINETIC_FACTOR - 1);
  float torque =
      t->drive->joint_friction * joint->hold_torque * (1 + STATIC_EXCESS * sbri_clamp(1 - loosened, 0, 1));
  float dry = torque / (relative_speed > STATIC_RAD_S ? relative_speed : STATIC_RAD_S),
        attached = t->drive->joint_damping_1_s * inertia + dry;
  float damping = 2 * t->drive->damping_ratio * fraction * inertia * w + attached;
  if (!(stiffness > 0 || damping > 0)) return;
  if (m->edge->ball && !(stiffness > 0)) {
    m->edge->ball->attached_inertia = (double)(damping * m->work->kick_s);
    m->edge->ball->dry_friction = (double)(dry * m->work->kick_s);
    m->edge->ball->max_dry_friction = (double)(torque * m->work->kick_s);
    return;
  }
  sbf_vec3 error = {0, 0, 0};
  if (stiffness > 0) {
    sbf_quat target = sbri_quat_multiply(m->work->motions[a].from.rotation,
        sbri_quat_multiply(sbri_quat_conjugate(t->targets[a].rotation), t->targets[b].rotation));
    error = sbri_quat_log(sbri_quat_multiply(target, sbri_quat_conjugate(m->work->motions[b].from.rotation)));
  }
  for (int k = 0; k < 3; k++) {
    if (joint->locked >> (SBF_JOINT_AXIS_TWIST + k) & 1) continue;
    sbri_row *row = add_bare_row(m, SBRI_ROW_TRACK, SBF_JOINT_AXIS_TWIST);
    const sbf_vec3 *u = &m->frames->axes[k];
    const float along[6] = {0, 0, 0, u->x, u->y, u->z};
    for (int i = 0; i < 6; i++) row->rates[SBRI_B][i] = along[i], row->rates[SBRI_A][i] = -along[i];
    row->speed = sbri_row_speed(m->work, t->model, joint, row);
    make_soft(m, row, stiffness, damping, sbri_dot(error, *u), 0);
    row->max = fraction * t->drive->strength * joint->hold_torque * m->work->kick_s;
    row->attached_mass = attached * m->work->kick_s;
    row->dry_friction = dry * m->work->kick_s, row->max_dry_friction = torque * m->work->kick_s;
  }
}

static void store(double to[3], sbf_vec3 v) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z;
}

/* Relative velocity of the joint's point on b against that on a; `turn` receives the relative angular
 * velocity. */
static sbf_vec3 slip_of(
    const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_edge *e, sbf_vec3 *turn) {
  const sbri_rigid_joint *joint = &model->joints[e->joint];
  const sbri_part_motion *a = sbri_side_motion(work, model, joint, SBRI_A),
                         *b = sbri_side_motion(work, model, joint, SBRI_B);
  const sbri_joint_frames *joint_frames = &work->joint_frames[e - work->system.edges];
  sbf_vec3 arm = sbri_add(joint_frames->arms[SBRI_A], joint_frames->separation);
  *turn = sbri_sub(b->turn, a->turn);
  return sbri_sub(sbri_add(b->velocity, sbri_cross(b->turn, joint_frames->arms[SBRI_B])),
      sbri_add(a->velocity, sbri_cross(a->turn, arm)));
}

/* Mean velocity by which the point's path curves, from the bodies' rotation at their current velocities. */
static sbf_vec3 curve_velocity(const row_maker *m, sbf_vec3 slip) {
  const sbri_part_motion *a = sbri_side_motion(m->work, m->tick->model, m->joint, SBRI_A),
                         *b = sbri_side_motion(m->work, m->tick->model, m->joint, SBRI_B);
  const sbr_transform *poses[SBRI_SIDES] = {&a->to, &b->to};
  sbf_vec3 separation = sbri_joint_separation(m->joint, poses, sbri_sub(b->fine_to, a->fine_to));
  sbf_vec3 mean = sbri_scale(sbri_sub(separation, m->frames->separation), 1 / m->step_s);
  return sbri_sub(mean, slip);
}

/* Right-hand side of a ball joint: its point is closed; its rotations only have damping, with target 0. */
static void make_ball(row_maker *m) {
  sbri_ball *ball = m->edge->ball;
  const sbri_joint_frames *joint_frames = m->frames;
  sbf_vec3 turn, slip = slip_of(m->work, m->tick->model, m->edge, &turn);
  float error[3], remaining[3];
  sbf_vec3 target = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    error[k] = sbri_dot(joint_frames->separation, joint_frames->axes[k]);
    float rate = sbri_clamp(-error[k] / m->step_s, -SBRI_CORRECTION_M_S, SBRI_CORRECTION_M_S);
    remaining[k] = error[k] + m->step_s * rate;
    target = sbri_add_scaled(target, joint_frames->axes[k], rate);
  }
  ball->end = sbri_vec3(remaining[0], remaining[1], remaining[2]);
  if (sbri_rigid_predicts_arcs(m->tick, m->work)) slip = sbri_add(slip, curve_velocity(m, slip));
  store(ball->levers[SBRI_A], sbri_add(joint_frames->arms[SBRI_A], joint_frames->separation));
  store(ball->levers[SBRI_B], joint_frames->arms[SBRI_B]);
  store(ball->rhs, sbri_sub(target, slip));
  store(ball->attached_rhs, sbri_scale(turn, -1));
  ball->attached_inertia = ball->dry_friction = ball->max_dry_friction = 0;
  m->turn_rad_s = sbri_length(turn);
}

void sbri_joint_rows_make(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t edge, float step_s) {
  sbri_edge *e = &work->system.edges[edge];
  const sbri_rigid_joint *joint = &t->model->joints[e->joint];
  const sbf_joint *source = joint->source;
  row_maker m = {t, work, joint, &work->joint_frames[edge], e, step_s, 0};
  const sbr_transform *poses[SBRI_SIDES] = {&sbri_side_motion(work, t->model, joint, SBRI_A)->from,
      &sbri_side_motion(work, t->model, joint, SBRI_B)->from};
  sbf_vec3 fine = sbri_sub(sbri_side_motion(work, t->model, joint, SBRI_B)->fine_from,
      sbri_side_motion(work, t->model, joint, SBRI_A)->fine_from);
  *m.frames = sbri_joint_frames_of(joint, poses, &t->anchor, fine);
  e->row_count = 0;
  if (e->ball) make_ball(&m);
  for (int axis = SBF_JOINT_AXIS_LINEAR_X; axis <= SBF_JOINT_AXIS_SWING_Z && !e->ball; axis++)
    if (joint->locked >> axis & 1) add_locked(&m, (sbf_joint_axis)axis);
  bool bounded = false;
  for (uint32_t i = 0; i < source->limits.count; i++) {
    const sbf_limit *limit = &source->limits.at[i];
    if (!sbfi_joint_is_free(source->kind, limit->target)) continue;
    bounded = bounded || limit->target == SBF_JOINT_AXIS_DISTANCE;
    add_limit(&m, limit);
  }
  if (!bounded && source->kind == SBF_JOINT_KIND_DISTANCE)
    add_locked_at(&m, SBF_JOINT_AXIS_DISTANCE, joint->rest_distance);
  if (!bounded && source->kind == SBF_JOINT_KIND_PULLEY)
    add_limit(
        &m, &(sbf_limit){.target = SBF_JOINT_AXIS_DISTANCE, .min = -INFINITY, .max = joint->rest_distance});
  for (uint32_t i = 0; i < source->drives.count; i++)
    if (sbfi_joint_is_free(source->kind, source->drives.at[i].target)) add_drive(&m, &source->drives.at[i]);
  add_track(&m);
}
