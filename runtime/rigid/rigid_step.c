/* One tick of a character's rigid parts, in small steps.
 *
 * A step is a leapfrog with constraints: SHAKE for rotating bodies (Ryckaert, Ciccotti, Berendsen, Numerical
 * integration of the Cartesian equations of motion of a system with constraints, 1977; Kol, Laird,
 * Leimkuhler, A symplectic method for rigid-body molecular simulation, 1997). Gravity changes velocities,
 * then joint impulses act along their directions at the beginning of the step, such that the joints hold at
 * its END. So a pendulum neither gains nor loses energy by the step size.
 *
 * The impulses follow from a linear system (rigid_system.h) that is solved exactly, and once more for the
 * error that rotation along an arc leaves. No impulse is accumulated over sweeps. A few iterations over the
 * same system find the active limits and contacts (rigid_passes.c); the first one starts from those of the
 * previous step. */
#include <string.h>

#include "math/quat_log.h"
#include "rigid/rigid_work.h"
#include "rigid/sym6.h"
#include "rigid/torque_free.h"

enum { MAX_CORRECTIONS = 4, CONTACT_HALVINGS = 4 };
/* Capacity of contacts with shapes, in addition to vertices on the ground. */
enum { CONTACTS_OF_BODY = 24 };
/* Capacity of external bodies; further ones are treated as immovable. */
enum { EXTERNAL_BODIES = 6, EXTERNAL_BODIES_OF_BODY = 2 };

/* Maximum joint error at the end of a step, in m and rad, before it is corrected again; and before the first
 * correction if the step was predicted (sbri_rigid_predicts_arcs). */
typedef struct tolerance {
  float fine, fine_at_once;
  float curved_foreseen;
} tolerance;
static const tolerance EXACT = {2e-5f, 5e-6f, 1e-2f}, ROUGH = {1e-4f, 1e-4f, 2e-2f};
/* Error above which the step is repeated in halves. */
static const float COARSE = 3e-4f;
/* m and rad: initial error, or deviation from the prediction, above which a step is halved. */
static const float CURVED = 3e-3f;

/* ---- Memory ---- */

static void *carve(unsigned char **memory, size_t count, size_t size) {
  unsigned char *at = *memory;
  *memory += (count * size + 15) & ~(size_t)15;
  return at;
}

/* Places the arrays from `memory` on; returns their size. The edges' arrays are in the order of their joints.
 */
static size_t assign_arrays(const sbri_rigid_model *m, unsigned char *memory, sbri_rigid_solving *work) {
  unsigned char *at = memory;
  size_t bodies = m->body_count, joints = m->joint_count, rows = m->row_count,
         loop_rows = m->loop_row_capacity;
  sbri_rigid_system *s = &work->system;
  s->nodes = carve(&at, bodies + 1, sizeof *s->nodes);
  s->steps = carve(&at, bodies + 1, sizeof *s->steps);
  s->edges = carve(&at, joints + 1, sizeof *s->edges);
  s->loops = carve(&at, joints + 1, sizeof *s->loops);
  s->loop_row_capacity = m->loop_row_capacity;
  s->responses = carve(&at, (loop_rows + 2) * (bodies + 1) * 6, sizeof(double));
  s->loop_matrix = carve(&at, loop_rows * loop_rows, sizeof(double));
  s->loop_rhs = carve(&at, loop_rows, sizeof(double));
  work->motions = carve(&at, bodies + 1, sizeof *work->motions);
  work->begins = carve(&at, bodies + 1, sizeof *work->begins);
  work->kept = carve(&at, SBRI_RIGID_HALVINGS * (bodies + 1), sizeof *work->kept);
  work->joint_forces = carve(&at, joints + 1, sizeof *work->joint_forces);
  work->balls = carve(&at, joints + 1, sizeof *work->balls);
  work->pairs = carve(&at, joints + 1, sizeof *work->pairs);
  work->joint_frames = carve(&at, joints + 1, sizeof *work->joint_frames);
  work->contact_list.capacity = sbri_rigid_contact_capacity(m);
  work->contact_list.at = carve(&at, work->contact_list.capacity, sizeof *work->contact_list.at);
  work->external_list.capacity = (uint32_t)(EXTERNAL_BODIES + EXTERNAL_BODIES_OF_BODY * bodies);
  work->external_list.at = carve(&at, work->external_list.capacity, sizeof *work->external_list.at);
  work->pushes = carve(&at, work->contact_list.capacity + rows, sizeof *work->pushes);
  work->order = carve(&at, 2 * joints + 2, sizeof(uint32_t));
  work->roots = carve(&at, bodies + 1, sizeof(uint32_t));
  work->rows = carve(&at, rows, sizeof *work->rows);
  work->actives = carve(&at, rows, sizeof *work->actives);
  work->vectors.y = carve(&at, 6 * rows, sizeof(double));
  work->vectors.w = carve(&at, 6 * rows, sizeof(double));
  work->vectors.t = carve(&at, rows, sizeof(double));
  work->vectors.rhs = carve(&at, rows, sizeof(double));
  work->vectors.g = carve(&at, m->square_count, sizeof(double));
  return (size_t)(at - memory);
}

uint32_t sbri_rigid_contact_capacity(const sbri_rigid_model *model) {
  return model->body_count ? model->vertex_count + CONTACTS_OF_BODY * model->body_count : 0;
}

size_t sbri_rigid_work_size(const sbri_rigid_model *model) {
  sbri_rigid_solving work;
  unsigned char none[16];
  return model->body_count ? assign_arrays(model, none, &work) : 0;
}

static void assign_edge_arrays(const sbri_rigid_model *m, sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    sbri_edge *e = &work->system.edges[i];
    const sbri_rigid_joint *joint = &m->joints[e->joint];
    size_t row = joint->first_row;
    e->rows = work->rows + row;
    e->actives = work->actives + row;
    e->y = work->vectors.y + 6 * row, e->w = work->vectors.w + 6 * row;
    e->t = work->vectors.t + row, e->rhs = work->vectors.rhs + row;
    e->g = work->vectors.g + joint->first_square;
  }
}

/* ---- Motions ---- */

static sbr_transform blend(const sbr_transform *a, const sbr_transform *b, float t) {
  return (sbr_transform){
      sbri_lerp(a->position, b->position, t), sbri_quat_blend(a->rotation, b->rotation, t)};
}

static void interpolate(sbri_part_motion *m, const sbr_transform *begin, const sbr_transform *end, float from,
    float to, float step_s) {
  m->from = blend(begin, end, from), m->to = blend(begin, end, to);
  m->fine_from = m->fine_to = sbri_vec3(0, 0, 0);
  m->velocity = sbri_scale(sbri_sub(m->to.position, m->from.position), 1 / step_s);
  sbf_quat rotation = sbri_quat_multiply(m->to.rotation, sbri_quat_conjugate(m->from.rotation));
  m->turn = sbri_scale(sbri_quat_log(rotation), 1 / step_s);
}

/* Predicts a body's position at its present velocity. */
static void predict_position(const sbri_rigid_tick *t, uint32_t b, sbri_part_motion *m, float step_s) {
  sbri_rigid_body_state *s = &t->bodies[b];
  m->velocity = s->velocity;
  sbf_vec3 displacement = sbri_add_scaled(m->fine_from, s->velocity, step_s); /* compensated sum */
  m->to.position = sbri_add(m->from.position, displacement);
  m->fine_to = sbri_sub(displacement, sbri_sub(m->to.position, m->from.position));
}

/* All simulated bodies; one rotation per lane. */
static void advance_all(const sbri_rigid_tick *t, sbri_rigid_solving *work, float step_s) {
  const sbri_node *nodes = work->system.nodes;
  uint32_t count = work->system.node_count;
  for (uint32_t i = 0; i < count; i += SBRI_LANES) {
    sbri_torque_free_lanes turning;
    for (uint32_t k = 0; k < SBRI_LANES; k++) { /* the last block repeats a body in unused lanes */
      uint32_t b = nodes[i + k < count ? i + k : count - 1].body;
      sbri_torque_free_lanes_set(&turning, (int)k, &t->model->bodies[b], work->motions[b].from.rotation,
          t->bodies[b].angular_momentum);
    }
    sbri_torque_free_lanes_rotate(&turning, step_s);
    for (uint32_t k = 0; k < SBRI_LANES && i + k < count; k++) {
      uint32_t b = nodes[i + k].body;
      sbri_part_motion *m = &work->motions[b];
      predict_position(t, b, m, step_s);
      m->turn = sbri_vec3(
          turning.angular_momentum[0][k], turning.angular_momentum[1][k], turning.angular_momentum[2][k]);
      m->to.rotation = (sbf_quat){turning.x[k], turning.y[k], turning.z[k], turning.w[k]};
    }
  }
}

void sbri_rigid_compute_moments(sbf_vec3 own, sbf_quat rotation, float to[3][3]) {
  const sbf_vec3 axes[3] = {sbri_quat_x(rotation), sbri_quat_y(rotation), sbri_quat_z(rotation)};
  const float moments[3] = {own.x, own.y, own.z};
  float a[3][3], m[3][3];
  for (int k = 0; k < 3; k++) {
    a[k][0] = axes[k].x, a[k][1] = axes[k].y, a[k][2] = axes[k].z;
    for (int i = 0; i < 3; i++) m[k][i] = moments[k] * a[k][i];
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++)
      to[i][j] = to[j][i] = m[0][i] * a[0][j] + m[1][i] * a[1][j] + m[2][i] * a[2][j];
}

/* `from` and `to`: fractions of the tick. */
static void begin_step(const sbri_rigid_tick *t, sbri_rigid_solving *work, float from, float to) {
  const sbri_rigid_model *model = t->model;
  /* Velocities belong to the middle of the previous step. */
  float step_s = t->tick_s * (to - from);
  work->kick_s = 0.5f * (work->last_step_s + step_s);
  for (uint32_t b = 0; b < model->body_count; b++) {
    sbri_part_motion *m = &work->motions[b];
    if (m->node < 0) {
      interpolate(m, &work->begins[b], &t->targets[b], from, to, step_s);
      continue;
    }
    sbri_rigid_body_state *s = &t->bodies[b];
    m->from = s->pose, m->fine_from = s->fine;
    s->velocity =
        sbri_add_scaled(s->velocity, t->gravity, work->kick_s * model->bodies[b].source->gravity_scale);
    sbri_node *node = &work->system.nodes[m->node];
    sbri_rigid_compute_moments(model->bodies[b].inertia, m->from.rotation, node->inertia);
    const sbf_vec3 *inverse_mass = &model->bodies[b].inverse_inertia;
    node->inverse_mass[0] = model->bodies[b].inverse_mass;
    node->inverse_mass[1] = (inverse_mass->x + inverse_mass->y + inverse_mass->z) / 3;
    node->mass_factor = sbri_rigid_mass_factor(&t->external, b, step_s);
    node->attached_load = t->external.attached_loads && t->external.attached_loads[b].is_attached
                              ? t->external.attached_loads[b].mass
                              : NULL;
    memset(node->known_impulse, 0, sizeof node->known_impulse);
  }
  sbri_rigid_external_bodies_begin(work, step_s);
  advance_all(t, work, step_s);
}

/* ---- Steps ---- */

/* Applies the solved velocity changes to the bodies. */
static void apply_solution(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    const sbri_node *node = &work->system.nodes[i];
    sbri_rigid_body_state *s = &t->bodies[node->body];
    const double *x = node->x;
    s->velocity = sbri_add(s->velocity, sbri_vec3((float)x[0], (float)x[1], (float)x[2]));
    float angular_momentum[3];
    for (int k = 0; k < 3; k++)
      angular_momentum[k] =
          (float)(node->inertia[k][0] * x[3] + node->inertia[k][1] * x[4] + node->inertia[k][2] * x[5]);
    s->angular_momentum = sbri_add(
        s->angular_momentum, sbri_vec3(angular_momentum[0], angular_momentum[1], angular_momentum[2]));
  }
  sbri_rigid_external_bodies_apply_solution(work);
}

static void apply_and_advance(const sbri_rigid_tick *t, sbri_rigid_solving *work, float step_s) {
  apply_solution(t, work);
  advance_all(t, work, step_s);
}

static void clear_b(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.node_count; i++)
    memset(work->system.nodes[i].b, 0, sizeof work->system.nodes[i].b);
  for (uint32_t i = 0; i < work->external_list.count; i++)
    memset(work->external_list.at[i].b, 0, sizeof work->external_list.at[i].b);
}

/* Impulse of an edge on body b in the step, and its moment about the joint's point on b. */
static sbf_vec3 impulse_of(const sbri_rigid_solving *work, const sbri_edge *e, sbf_vec3 *moment) {
  sbf_vec3 impulse = {0, 0, 0}, about = {0, 0, 0},
           arm = work->joint_frames[e - work->system.edges].arms[SBRI_B];
  for (uint32_t r = 0; r < e->row_count; r++) {
    const sbri_row *row = &e->rows[r];
    const float *b = row->rates[SBRI_B];
    if ((e->ball && row->active) || (!row->active && !row->is_saturated)) continue;
    impulse = sbri_add_scaled(impulse, sbri_vec3(b[0], b[1], b[2]), row->impulse);
    about = sbri_add_scaled(about, sbri_vec3(b[3], b[4], b[5]), row->impulse);
  }
  *moment = sbri_sub(about, sbri_cross(arm, impulse));
  if (!e->ball) return impulse;
  const double *i = e->ball->impulse, *m = e->ball->moment;
  *moment = sbri_add(*moment, sbri_vec3((float)m[0], (float)m[1], (float)m[2]));
  return sbri_add(impulse, sbri_vec3((float)i[0], (float)i[1], (float)i[2]));
}

/* Stores joint forces. Returns whether they make a body oscillate too fast for the step size. */
static bool is_too_fast(const sbri_rigid_tick *t, sbri_rigid_solving *work, float step_s) {
  if (work->contact_list.count) return false; /* impact forces last for one step only */
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    sbf_vec3 moment, impulse = impulse_of(work, e, &moment);
    work->joint_forces[e->joint] = sbri_scale(impulse, 1 / work->kick_s);
  }
  return sbri_rigid_oscillates_too_fast(t, work, step_s);
}

static void store_forces(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  float rate = 1 / t->tick_s;
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    sbri_rigid_joint_state *joint = &t->joints[e->joint];
    sbf_vec3 moment, impulse = impulse_of(work, e, &moment);
    joint->pressed = 0;
    for (uint32_t r = 0; r < e->row_count && r < 32; r++)
      if (e->rows[r].sign && e->rows[r].active) joint->pressed |= 1u << r;
    joint->force = sbri_add_scaled(joint->force, impulse, rate);
    joint->torque = sbri_add_scaled(joint->torque, moment, rate);
  }
}

static void apply_restitution(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  if (work->external_list.count) {
    sbri_rigid_external_bodies_update_seen(work);
    sbri_rigid_factor(t, work);
  }
  clear_b(work);
  bool any = sbri_rigid_contacts_bounce(work);
  for (uint32_t e = 0; e < work->system.edge_count; e++)
    if (sbri_joint_rows_bounce(work, &work->system.edges[e], t->model)) any = true;
  if (!any) return;
  sbri_rigid_solve(work);
  sbri_system_add_impulses(&work->system);
  sbri_rigid_contacts_apply_impulse(work);
  apply_solution(t, work);
}

/* One step over that fraction of the tick. Returns whether the joints hold at its end. */
static bool step(const sbri_rigid_tick *t, sbri_rigid_solving *work, float from, float to) {
  float step_s = t->tick_s * (to - from), max_error = 0, first_error = 0;
  sbri_rigid_system *s = &work->system;
  begin_step(t, work, from, to);
  sbri_rigid_contacts_linearise(t, work, t->tick_s * from, step_s);
  for (uint32_t e = 0; e < s->edge_count; e++) sbri_joint_rows_make(t, work, e, step_s);
  sbri_rigid_iterate(t, work, step_s);
  sbri_system_add_impulses(s);
  apply_and_advance(t, work, step_s);
  bool predicts_arcs = sbri_rigid_predicts_arcs(t, work);
  const tolerance *max = t->coarse ? &ROUGH : &EXACT;
  for (int pass = 0; pass < MAX_CORRECTIONS && s->edge_count; pass++) {
    max_error = 0;
    for (uint32_t e = 0; e < s->edge_count; e++) {
      float error = sbri_joint_rows_correct(t, work, e, step_s);
      max_error = error > max_error ? error : max_error;
    }
    if (pass == 0) first_error = max_error;
    if (max_error < (pass > 0 ? max->fine : predicts_arcs ? max->fine_at_once : 0)) break;
    clear_b(work);
    sbri_rigid_solve(work);
    sbri_system_add_impulses(s);
    sbri_rigid_contacts_apply_impulse(work);
    apply_and_advance(t, work, step_s);
  }
  return max_error < COARSE && first_error < (predicts_arcs ? max->curved_foreseen : CURVED) &&
         !is_too_fast(t, work, step_s);
}

static void store_bodies(const sbri_rigid_tick *t, sbri_rigid_solving *work, int depth, bool restore) {
  sbri_rigid_body_state *stored = work->kept + (size_t)depth * t->model->body_count;
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    uint32_t b = work->system.nodes[i].body;
    *(restore ? &t->bodies[b] : &stored[b]) = *(restore ? &stored[b] : &t->bodies[b]);
  }
}

/* A step; if the joints do not hold at its end, as when a whip cracks, two steps of half the length. */
static void substep(const sbri_rigid_tick *t, sbri_rigid_solving *work, float from, float to, int depth) {
  int max = work->contact_list.count ? CONTACT_HALVINGS : SBRI_RIGID_HALVINGS;
  store_bodies(t, work, depth, false);
  if (!step(t, work, from, to) && depth + 1 < max) {
    store_bodies(t, work, depth, true);
    float middle = 0.5f * (from + to);
    substep(t, work, from, middle, depth + 1);
    substep(t, work, middle, to, depth + 1);
    return;
  }
  work->last_step_s = t->tick_s * (to - from);
  apply_restitution(t, work);
  sbri_rigid_contacts_report(t, work);
  sbri_rigid_external_bodies_end_step(work, work->last_step_s);
  store_forces(t, work);
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    uint32_t b = work->system.nodes[i].body;
    t->bodies[b].pose = work->motions[b].to, t->bodies[b].fine = work->motions[b].fine_to;
  }
}

/* Joint forces of bodies that have just begun to move, from two short steps that are then undone. The first
 * one transmits initial impulses, which are not forces; the second one shows the remaining forces. */
static void probe_joint_forces(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  const float fraction = 1 / (float)SBRI_RIGID_MAX_SUBSTEPS;
  work->last_step_s = fraction * t->tick_s;
  store_bodies(t, work, 0, false);
  for (int k = 0; k < 2; k++) (void)step(t, work, 0, fraction);
  store_bodies(t, work, 0, true);
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    sbf_vec3 moment, impulse = impulse_of(work, e, &moment);
    work->joint_forces[e->joint] =
        sbri_add_scaled(work->joint_forces[e->joint], impulse, 1 / work->last_step_s);
  }
  work->last_step_s = 0;
}

static void break_joints(const sbri_rigid_tick *t) {
  for (uint32_t j = 0; j < t->model->joint_count; j++) {
    const sbf_joint *source = t->model->joints[j].source;
    sbri_rigid_joint_state *joint = &t->joints[j];
    if ((source->break_force > 0 && sbri_length(joint->force) > source->break_force) ||
        (source->break_torque > 0 && sbri_length(joint->torque) > source->break_torque))
      joint->broken = 1;
  }
}

void sbri_rigid_begin(sbri_rigid_tick *t, sbri_rigid_solving *work) {
  assign_arrays(t->model, t->work, work);
  sbri_part_motion *anchor = &work->motions[t->model->body_count];
  *anchor = (sbri_part_motion){.from = t->anchor, .to = t->anchor};
  sbri_rigid_tree_make(t, work);
  assign_edge_arrays(t->model, work);
  for (uint32_t b = 0; b < t->model->body_count; b++) work->begins[b] = t->bodies[b].pose;
  for (uint32_t j = 0; j < t->model->joint_count; j++)
    work->joint_forces[j] = t->joints[j].force, t->joints[j].force = t->joints[j].torque = sbri_vec3(0, 0, 0);
  sbri_rigid_contacts_find(t, work);
  sbri_rigid_shape_contacts_find(t, work);
  sbri_stored_contacts_apply(t, work);
  work->last_step_s = t->drive->last_step_s;
  if (work->last_step_s == 0 && work->system.node_count) probe_joint_forces(t, work);
  t->substeps = sbri_rigid_step_count(t, work);
  if (t->substeps < t->external.steps) t->substeps = t->external.steps;
}

void sbri_rigid_advance(const sbri_rigid_tick *t, sbri_rigid_solving *work, float from, float to) {
  if (!work->system.node_count) return;
  float old_step_s = work->last_step_s, step_s = t->tick_s * (to - from);
  if (t->external.before_step)
    t->external.before_step(t->external.user, t, from, to, 0.5f * (old_step_s + step_s));
  substep(t, work, from, to, 0);
  float weight_s = step_s + 0.5f * (old_step_s - work->last_step_s);
  if (t->external.after_step) t->external.after_step(t->external.user, t, step_s, weight_s);
}

void sbri_rigid_end(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  for (uint32_t b = 0; b < t->model->body_count; b++) {
    if (work->motions[b].node >= 0) continue;
    sbri_part_motion all;
    interpolate(&all, &work->begins[b], &t->targets[b], 0, 1, t->tick_s);
    t->bodies[b].pose = t->targets[b], t->bodies[b].fine = sbri_vec3(0, 0, 0);
    t->bodies[b].velocity = all.velocity;
    t->bodies[b].angular_momentum =
        sbri_angular_momentum_from_velocity(&t->model->bodies[b], t->targets[b].rotation, all.turn);
  }
  sbri_stored_contacts_save(t, work);
  t->drive->last_step_s = work->last_step_s;
  t->drive->slow_ticks = sbri_rigid_is_slow(t, work) ? t->drive->slow_ticks + 1 : 0;
  break_joints(t);
}
