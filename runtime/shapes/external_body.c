#include "shapes/external_body.h"

#include "math/vec3.h"

/* Adds v v^T times `size` to a symmetric matrix. */
static void add_outer(float m[6], sbf_vec3 v, float size) {
  m[0] += size * v.x * v.x, m[1] += size * v.y * v.y, m[2] += size * v.z * v.z;
  m[3] += size * v.x * v.y, m[4] += size * v.x * v.z, m[5] += size * v.y * v.z;
}

static float largest(sbf_vec3 v) {
  float max = v.x > v.y ? v.x : v.y;
  return v.z > max ? v.z : max;
}

/* Adds a matrix with these eigenvalues along the body's principal axes. */
static void add_axes(float m[6], const sbri_collider *leader, sbf_vec3 values) {
  sbf_quat axes = sbri_quat_multiply(leader->rotation_from, leader->body.axes);
  add_outer(m, sbri_rotate(axes, sbri_vec3(1, 0, 0)), values.x);
  add_outer(m, sbri_rotate(axes, sbri_vec3(0, 1, 0)), values.y);
  add_outer(m, sbri_rotate(axes, sbri_vec3(0, 0, 1)), values.z);
}

/* Sets the copy's fraction of the mass. A body that is blocked along a normal does not rotate either. */
static void set_masses(
    sbri_external_body *g, const sbri_collider *leader, uint32_t contributors, float scale) {
  const sbri_host_body *b = &leader->body;
  float cube = scale * scale * scale, fraction = (float)contributors * cube;
  bool is_blocked = sbri_dot(b->blocked_normal, b->blocked_normal) > 0;
  g->max_inverse_mass = b->inverse_mass * fraction;
  g->inverse_mass[0] = g->inverse_mass[1] = g->inverse_mass[2] = g->max_inverse_mass;
  add_outer(g->inverse_mass, b->blocked_normal, -g->max_inverse_mass);
  if (is_blocked) return;
  sbf_vec3 inverse_inertias = sbri_scale(b->inverse_inertias, fraction * scale * scale);
  add_axes(g->inverse_inertia, leader, inverse_inertias);
  g->max_inverse_inertia = largest(inverse_inertias);
}

void sbri_external_body_compute_roots(const sbri_external_body *g, const sbri_collider *leader,
    float inverse_mass[6], float inverse_inertia[6]) {
  const sbri_host_body *b = &leader->body;
  float root = sqrtf(g->max_inverse_mass), fraction = largest(b->inverse_inertias);
  for (int k = 0; k < 6; k++)
    inverse_mass[k] = g->inverse_mass[k] / root,
    inverse_inertia[k] = 0; /* the mass matrix is a projection times a factor */
  if (!(g->max_inverse_inertia > 0)) return;
  fraction = g->max_inverse_inertia / fraction;
  add_axes(inverse_inertia, leader,
      sbri_vec3(sqrtf(fraction * b->inverse_inertias.x), sqrtf(fraction * b->inverse_inertias.y),
          sqrtf(fraction * b->inverse_inertias.z)));
}

typedef struct own_impulse {
  sbf_vec3 impulse, moment; /* on the host's body, in mass units of the asset */
  bool any;
} own_impulse;

/* Impulse of this body on it in the previous tick; moments about its centre at that time. */
static own_impulse previous_impulse(const sbri_external_body_maker *m, const sbri_external_body *g) {
  own_impulse own = {{0, 0, 0}, {0, 0, 0}, false};
  for (uint32_t i = 0; i < m->before_count; i++) {
    const sbri_contact_report *one = &m->before[i];
    if (one->collider >= m->colliders->end || m->colliders->at[one->collider].leader != g->leader) continue;
    own.any = true;
    own.impulse = sbri_sub(own.impulse, one->total_impulse);
    sbf_vec3 arm = sbri_sub(one->position, g->centre);
    own.moment = sbri_sub(own.moment, sbri_add(one->total_moment, sbri_cross(arm, one->total_impulse)));
  }
  return own;
}

/* Predicts the effect of the other bodies: the same as in the previous tick. */
static void predict_others(sbri_external_body *g, const sbri_external_body_maker *m, const sbri_host_body *b,
    uint32_t contributors, const own_impulse *own) {
  float root = sqrtf(m->scale), cube = m->scale * m->scale * m->scale;
  float mass = 1 / (cube * root), moment = mass / m->scale; /* the time unit is 1 / root */
  float rate = 1 / ((float)contributors * m->tick_s);
  sbf_vec3 other_impulse = sbri_add_scaled(sbri_scale(b->impulse, mass), own->impulse, -(float)contributors);
  sbf_vec3 other_moment = sbri_add_scaled(sbri_scale(b->moment, moment), own->moment, -(float)contributors);
  g->acceleration =
      sbri_add(g->acceleration, sbri_external_body_times(g->inverse_mass, sbri_scale(other_impulse, rate)));
  g->angular_acceleration = sbri_external_body_times(g->inverse_inertia, sbri_scale(other_moment, rate));
}

sbri_external_body sbri_external_body_make(
    const sbri_external_body_maker *m, const sbri_collider_frame *frame, uint32_t number) {
  const sbri_collider *leader = &m->colliders->at[number];
  sbri_collider_frame of =
      frame->collider == leader ? *frame : sbri_collider_frame_of(leader, m->origin, m->scale);
  const sbri_host_body *b = &leader->body;
  sbri_external_body g = {.leader = number, .lever = 1};
  sbf_quat rotation = sbri_quat_multiply(leader->rotation_to, sbri_quat_conjugate(leader->rotation_from));
  float rate = (rotation.w < 0 ? -2 : 2) / m->tick_s;
  g.centre = sbri_out_of_shape(&of, b->centre);
  g.begin_velocity = sbri_scale(sbri_shape_displacement(&of, b->centre), 1 / m->tick_s);
  g.begin_angular_velocity = sbri_vec3(rotation.x * rate, rotation.y * rate, rotation.z * rate);
  own_impulse own = previous_impulse(m, &g);
  uint32_t contributors = b->contributor_count + (own.any ? 0 : 1);
  contributors = contributors > 0 ? contributors : 1;
  set_masses(&g, leader, contributors, m->scale);
  g.acceleration = sbri_host_body_free(b, b->acceleration);
  if (contributors > 1) predict_others(&g, m, b, contributors, &own);
  g.velocity = g.seen_velocity = g.begin_velocity,
  g.angular_velocity = g.seen_angular_velocity = g.begin_angular_velocity;
  return g;
}

uint8_t sbri_external_body_of(sbri_external_bodies *external_bodies, const sbri_external_body_maker *m,
    const sbri_collider_frame *frame, uint32_t collider) {
  const sbri_collider *leader = sbri_collider_leader(m->colliders, collider);
  if (!leader) return 0;
  uint32_t number = (uint32_t)(leader - m->colliders->at), i = 0;
  while (i < external_bodies->count && external_bodies->at[i].leader != number) i++;
  if (i == SBRI_EXTERNAL_BODIES) return 0;
  if (i == external_bodies->count)
    external_bodies->at[external_bodies->count++] = sbri_external_body_make(m, frame, number);
  return (uint8_t)(i + 1);
}

void sbri_external_body_begin(sbri_external_body *g, float step_s) {
  g->lever = 1 + g->elapsed_s / step_s;
  g->velocity = sbri_add_scaled(g->begin_velocity, g->acceleration, step_s);
  g->angular_velocity = sbri_add_scaled(g->begin_angular_velocity, g->angular_acceleration, step_s);
  g->seen_velocity = sbri_add_scaled(g->begin_velocity, g->acceleration, g->lever * step_s);
  g->seen_angular_velocity =
      sbri_add_scaled(g->begin_angular_velocity, g->angular_acceleration, g->lever * step_s);
}
