/* Number of steps in a tick: that of the model, more for fast oscillation by joint forces and for fast
 * rotation, fewer in flight, and one if all bodies have been at rest for a while. Requests of soft bodies are
 * added (coupling/ragdoll/coupled.c). */
#include "rigid/rigid_work.h"

/* Number of slow ticks after which all bodies count as resting. A swinging body is slow for fewer. */
enum { LYING_TICKS = 20 };

/* In flight a tick has at least the model's number of substeps divided by this. */
enum { MAX_FEWER = 4 };
/* In flight the number of substeps is reduced only below this fraction of the bound. */
static const float NEARLY = 0.75f;

/* rad: the greatest rotation of a body in a step, so that an arc is close to its tangent. */
static const float MAX_TURN = 0.2f;
/* Maximum angular frequency times step size, for joint forces of the step itself. It counts only if its
 * square has grown by this factor since the previous tick, as for light parts between heavy ones. */
static const float PULLED_SWING = 0.3f, PULLED_MORE = 2;
/* Factor on force bounds against rounding. */
static const float ROUNDED = 1.001f;
/* Fraction of its size per second below which a body counts as slow. */
static const float SLOW_1_S = 0.1f;

float sbri_rigid_mass_factor(const sbri_rigid_external_forces *external, uint32_t body, float step_s) {
  if (external->attached_loads && external->attached_loads[body].is_attached) return 1;
  float swell = external->squares ? external->squares[body] * step_s * step_s /
                                        (SBRI_RIGID_MAX_SWING * SBRI_RIGID_MAX_SWING)
                                  : 0;
  return swell > 1 ? swell : 1;
}

/* Rotational stiffness of a body about each of its own axes, from the forces at its joints: a force F at the
 * lever arm r gives r.F - r_i F_i about the axis i. */
static void add_force_stiffness(
    const sbri_rigid_joint *joint, int side, sbf_quat rotation, sbf_vec3 force, float stiffness[3]) {
  sbf_vec3 r = joint->frames[side].at, f = sbri_rotate(sbri_quat_conjugate(rotation), force);
  if (side == SBRI_A) f = sbri_scale(f, -1);
  float axial = sbri_dot(r, f);
  stiffness[0] += axial - r.x * f.x;
  stiffness[1] += axial - r.y * f.y;
  stiffness[2] += axial - r.z * f.z;
}

static void find_force_stiffness(
    const sbri_rigid_tick *t, const sbri_rigid_solving *work, uint32_t b, float stiffness[3]) {
  const sbri_rigid_model *model = t->model;
  const sbri_rigid_body *body = &model->bodies[b];
  stiffness[0] = stiffness[1] = stiffness[2] = 0;
  for (uint32_t k = body->joint_begin; k < body->joint_end; k++) {
    const sbri_rigid_joint *joint = &model->joints[model->joints_of[k]];
    int side = joint->bodies[SBRI_B] == (int32_t)b ? SBRI_B : SBRI_A;
    add_force_stiffness(
        joint, side, t->bodies[b].pose.rotation, work->joint_forces[model->joints_of[k]], stiffness);
  }
}

/* Whether no contact, joint to the world or drive acts; gravity causes no joint forces. */
static bool is_flying(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  if (work->contact_list.count || work->system.loop_count) return false;
  for (uint32_t e = 0; e < work->system.edge_count; e++)
    if (t->model->joints[work->system.edges[e].joint].source->kind == SBF_JOINT_KIND_PULLEY) return false;
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    const sbri_node *node = &work->system.nodes[i];
    const sbri_rigid_body_state *body = &t->bodies[node->body];
    if ((body->mode == SBR_RIGID_DRIVEN && body->fraction > 0) || (node->parent < 0 && node->edge >= 0))
      return false;
  }
  return true;
}

/* Number of substeps: the model's; 1 where all bodies rest; in flight enough for rotations and swings. */
static uint32_t min_steps(const sbri_rigid_tick *t, bool is_resting, bool is_flying_now, float steps) {
  if (is_resting) return 1;
  if (!is_flying_now) return t->substeps;
  uint32_t count = t->substeps > MAX_FEWER ? t->substeps / MAX_FEWER : 1;
  while (count < t->substeps && (float)count < steps) count *= 2;
  return count < t->substeps ? count : t->substeps;
}

float sbri_rigid_swings(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  float fastest = 0;
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    float stiffness[3];
    const sbf_vec3 *inverse_mass = &t->model->bodies[work->system.nodes[i].body].inverse_inertia;
    find_force_stiffness(t, work, work->system.nodes[i].body, stiffness);
    const float squares[3] = {
        stiffness[0] * inverse_mass->x, stiffness[1] * inverse_mass->y, stiffness[2] * inverse_mass->z};
    for (int a = 0; a < 3; a++) fastest = squares[a] > fastest ? squares[a] : fastest;
  }
  return fastest;
}

/* Upper bound of the squared frequency that the edge's force gives its bodies, over all directions. */
static void store_frequency(const sbri_rigid_tick *t, sbri_rigid_solving *work, const sbri_edge *e) {
  const sbri_rigid_joint *joint = &t->model->joints[e->joint];
  sbf_vec3 force = work->joint_forces[e->joint];
  float square = sbri_dot(force, force);
  for (int side = 0; side < SBRI_SIDES; side++) {
    if (e->nodes[side] < 0) continue;
    const sbf_vec3 *i = &t->model->bodies[joint->bodies[side]].inverse_inertia, at = joint->frames[side].at;
    float inverse_mass = i->x > i->y ? i->x : i->y;
    inverse_mass = i->z > inverse_mass ? i->z : inverse_mass;
    work->system.nodes[e->nodes[side]].max_swing_square +=
        ROUNDED * inverse_mass * sqrtf(square * sbri_dot(at, at));
  }
}

bool sbri_rigid_oscillates_too_fast(const sbri_rigid_tick *t, sbri_rigid_solving *work, float step_s) {
  sbri_rigid_system *s = &work->system;
  float max = PULLED_SWING / step_s;
  max *= max;
  for (uint32_t i = 0; i < s->node_count; i++) s->nodes[i].max_swing_square = 0;
  for (uint32_t i = 0; i < s->edge_count; i++) store_frequency(t, work, &s->edges[i]);
  bool may = false;
  for (uint32_t i = 0; i < s->node_count; i++) may = may || s->nodes[i].max_swing_square > max;
  if (!may) return false; /* the common case, without checking directions */
  float swings = sbri_rigid_swings(t, work);
  return swings > max && swings > PULLED_MORE * work->swings;
}

/* Maximum rotation speed of a body with a joint, rad/s. */
static float max_rotation_speed(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  float fastest = 0;
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    if (work->system.nodes[i].edge < 0) continue;
    const sbri_rigid_body_state *state = &t->bodies[work->system.nodes[i].body];
    const sbri_rigid_body *body = &t->model->bodies[work->system.nodes[i].body];
    float turn =
        sbri_length(sbri_angular_velocity_from_momentum(body, state->pose.rotation, state->angular_momentum));
    fastest = turn > fastest ? turn : fastest;
  }
  return fastest;
}

uint32_t sbri_rigid_step_count(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  work->swings = sbri_rigid_swings(t, work);
  float turns = t->tick_s * max_rotation_speed(t, work) / MAX_TURN;
  float swings = t->tick_s * sqrtf(work->swings) / SBRI_RIGID_MAX_SWING;
  float steps = turns > swings ? turns : swings;
  /* Powers of two. The number decreases only if a quarter would suffice, in flight if half would suffice with
   * a margin, or if the bodies have landed or taken off: a leapfrog gains energy if its step size changes
   * often. */
  bool is_resting = t->drive->slow_ticks >= LYING_TICKS, is_flying_now = is_flying(t, work),
       flew = t->drive->is_free;
  uint32_t count = min_steps(t, is_resting, is_flying_now, steps),
           max = t->substeps > SBRI_RIGID_MAX_SUBSTEPS ? t->substeps : SBRI_RIGID_MAX_SUBSTEPS;
  while ((float)count < steps && 2 * count <= max) count *= 2;
  uint32_t old_steps = t->drive->substeps;
  bool nearly =
      is_flying_now || work->contact_list.count ? steps > NEARLY * (float)count : old_steps < 4 * count;
  if (!is_resting && is_flying_now == flew && old_steps > count && old_steps <= max && nearly)
    count = old_steps;
  t->drive->substeps = count;
  t->drive->is_free = is_flying_now;
  return count;
}

bool sbri_rigid_is_slow(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    uint32_t b = work->system.nodes[i].body;
    const sbri_rigid_body_state *s = &t->bodies[b];
    float size = 2 * t->model->bodies[b].radius;
    sbf_vec3 turn =
        sbri_angular_velocity_from_momentum(&t->model->bodies[b], s->pose.rotation, s->angular_momentum);
    if (s->mode == SBR_RIGID_DRIVEN ||
        !(sbri_length(s->velocity) + 0.5f * size * sbri_length(turn) < SLOW_1_S * size))
      return false;
  }
  return true;
}
