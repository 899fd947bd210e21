/* Solver bodies: rigid and external bodies in world units, read before a solve and written after it. */
#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"

/* Change of a lever arm, as a fraction, after which the masses are recomputed. They only steer the solver;
 * they do not change the result of an impulse. */
static const float ARM_CHANGE_FRACTION = 0.05f;

static bool is_dynamic(const sbri_group_member *m, uint32_t body) {
  return m->parts.steps && sbri_rigid_is_simulated(m->character, body);
}

/* ---- Solver bodies ---- */

void sbri_solver_bodies_list(const sbri_body_contacts *all, sbri_contact_group *group) {
  sbri_solver_body *bodies = all->solver_bodies + group->first_solver_body;
  group->solver_body_count = 0;
  for (uint32_t i = 0; i < group->member_count; i++) {
    sbri_group_member *m = &all->members[group->first_member + i];
    m->first_solver_body = group->solver_body_count;
    for (uint32_t b = 0; b < m->character->model->rigid.body_count; b++)
      bodies[group->solver_body_count++] = (sbri_solver_body){.member = i, .body = b};
    m->first_external = group->solver_body_count;
    for (uint32_t k = 1; k <= sbri_count_member_externals(m); k++)
      bodies[group->solver_body_count++] = (sbri_solver_body){.member = i, .external = k};
  }
}

static sbf_vec3 rotate(float rotation[3][3], sbf_vec3 x) {
  return sbri_vec3(rotation[0][0] * x.x + rotation[0][1] * x.y + rotation[0][2] * x.z,
      rotation[1][0] * x.x + rotation[1][1] * x.y + rotation[1][2] * x.z,
      rotation[2][0] * x.x + rotation[2][1] * x.y + rotation[2][2] * x.z);
}

static sbf_vec3 rotate_back(float rotation[3][3], sbf_vec3 x) {
  return sbri_vec3(rotation[0][0] * x.x + rotation[1][0] * x.y + rotation[2][0] * x.z,
      rotation[0][1] * x.x + rotation[1][1] * x.y + rotation[2][1] * x.z,
      rotation[0][2] * x.x + rotation[1][2] * x.y + rotation[2][2] * x.z);
}

static void read_rigid(const sbri_group_member *m, sbri_solver_body *to) {
  const sbri_rigid_body *body = &m->character->model->rigid.bodies[to->body];
  const sbri_rigid_body_state *s = &sbri_rigid_bodies(m->character)[to->body];
  sbf_quat q = s->pose.rotation;
  const float size = m->scale, inertia = m->mass * size * size, rate = m->velocity_scale / size;
  const sbf_vec3 columns[3] = {sbri_rotate(q, sbri_vec3(1, 0, 0)), sbri_rotate(q, sbri_vec3(0, 1, 0)),
      sbri_rotate(q, sbri_vec3(0, 0, 1))};
  for (int k = 0; k < 3; k++)
    to->rotation[0][k] = columns[k].x, to->rotation[1][k] = columns[k].y, to->rotation[2][k] = columns[k].z;
  const float own[3] = {body->inverse_inertia.x / inertia, body->inverse_inertia.y / inertia,
      body->inverse_inertia.z / inertia};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) {
      float sum = 0;
      for (int k = 0; k < 3; k++) sum += own[k] * to->rotation[i][k] * to->rotation[j][k];
      to->inverse_inertia[i][j] = to->inverse_inertia[j][i] = sum;
    }
  to->position = sbri_add_scaled(m->offset, s->pose.position, size);
  to->position_remainder = sbri_scale(s->fine, size);
  to->velocity = sbri_four_of(sbri_scale(s->velocity, m->velocity_scale));
  sbf_vec3 angular_velocity = rotate_back(to->rotation, s->angular_momentum), e = body->inverse_inertia;
  angular_velocity = rotate(
      to->rotation, sbri_vec3(angular_velocity.x * e.x, angular_velocity.y * e.y, angular_velocity.z * e.z));
  to->angular_velocity = sbri_four_of(sbri_scale(angular_velocity, rate));
  to->inverse_mass = body->inverse_mass / m->mass;
  to->impulse = to->angular_impulse = sbri_vec3(0, 0, 0);
}

static sbri_external_body *external_of(const sbri_group_member *m, const sbri_solver_body *body) {
  return &m->parts.work.external_list.at[body->external - 1].is;
}

/* The later in the tick its velocity changes, the longer the path that an external body covers by it
 * (shapes/external_body.h). */
static float response_factor(
    const sbri_contact_group *group, const sbri_group_member *m, const sbri_external_body *g) {
  return 1 + g->elapsed_s / (group->step_s * m->character->time_scale);
}

static void read_external(const sbri_contact_group *group, const sbri_group_member *m, sbri_solver_body *to) {
  const sbri_external_body *g = external_of(m, to);
  static const int entries[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  float factor = response_factor(group, m, g), inertia = m->mass * m->scale * m->scale;
  sbf_vec3 position = sbri_add_scaled(g->centre, g->begin_velocity, g->elapsed_s);
  to->position = sbri_add_scaled(m->offset, position, m->scale);
  to->position_remainder = to->impulse = to->angular_impulse = sbri_vec3(0, 0, 0);
  to->velocity = sbri_four_of(sbri_scale(g->begin_velocity, m->velocity_scale));
  to->angular_velocity = sbri_four_of(sbri_scale(g->begin_angular_velocity, m->velocity_scale / m->scale));
  to->inverse_mass = factor * g->max_inverse_mass / m->mass;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      to->inverse_inertia[i][j] = factor * g->inverse_inertia[entries[i][j]] / inertia;
}

static void write_external(const sbri_group_member *m, const sbri_solver_body *from) {
  sbri_external_body *g = external_of(m, from);
  float impulse = 1 / (m->mass * m->velocity_scale);
  g->begin_velocity = sbri_add_scaled(g->begin_velocity, from->impulse, g->max_inverse_mass * impulse);
  sbf_vec3 rotation =
      sbri_external_body_times(g->inverse_inertia, sbri_scale(from->angular_impulse, impulse / m->scale));
  g->begin_angular_velocity = sbri_add(g->begin_angular_velocity, rotation);
}

sbf_vec3 sbri_external_body_acceleration(
    const sbri_contact_group *group, const sbri_group_member *m, uint32_t external) {
  const sbri_external_body *g = &m->parts.work.external_list.at[external - 1].is;
  return sbri_scale(g->acceleration, response_factor(group, m, g));
}

void sbri_solver_bodies_read(const sbri_body_contacts *all, const sbri_contact_group *group) {
  for (uint32_t i = 0; i < group->solver_body_count; i++) {
    sbri_solver_body *body = &all->solver_bodies[group->first_solver_body + i];
    const sbri_group_member *m = &all->members[group->first_member + body->member];
    if (body->external)
      read_external(group, m, body);
    else if (is_dynamic(m, body->body))
      read_rigid(m, body);
  }
}

void sbri_solver_bodies_write(const sbri_body_contacts *all, const sbri_contact_group *group) {
  for (uint32_t i = 0; i < group->solver_body_count; i++) {
    const sbri_solver_body *body = &all->solver_bodies[group->first_solver_body + i];
    const sbri_group_member *m = &all->members[group->first_member + body->member];
    if (body->external) write_external(m, body);
    if (body->external || !is_dynamic(m, body->body)) continue;
    sbri_rigid_body_state *s = &sbri_rigid_bodies(m->character)[body->body];
    s->velocity = sbri_add_scaled(s->velocity, body->impulse, body->inverse_mass / m->velocity_scale);
    s->angular_momentum = sbri_add_scaled(
        s->angular_momentum, body->angular_impulse, 1 / (m->mass * m->velocity_scale * m->scale));
  }
}

/* ---- Sides ---- */

/* A kinematic rigid body follows its bone. */
static sbf_vec3 kinematic_position(
    const sbri_group_member *m, const sbri_contact_side *side, sbf_vec3 *velocity) {
  const sbri_character *c = m->character;
  uint32_t body = (uint32_t)side->rigid_body;
  sbr_transform from = sbri_rigid_target(c, sbri_previous_pose(c), body),
                to = sbri_rigid_target(c, sbri_pose(c), body);
  sbf_vec3 a = sbri_add(from.position, sbri_rotate(from.rotation, side->point)),
           b = sbri_add(to.position, sbri_rotate(to.rotation, side->point));
  *velocity = sbri_scale(sbri_sub(b, a), m->velocity_scale / m->tick_s);
  return sbri_add_scaled(m->offset, sbri_lerp(a, b, m->tick_fraction), m->scale);
}

static const float *inverse_masses(const sbri_character *c, const sbri_island *island) {
  return island->splits ? sbri_inverse_masses(c) + island->first_slot : island->inverse_masses;
}

static sbf_vec3 soft_position(
    const sbri_group_member *m, const sbri_contact_side *side, sbri_constraint_side *end) {
  const sbri_character *c = m->character;
  const sbri_island *island = &c->model->islands[side->island];
  const sbri_point *p = sbri_positions(c) + island->first_slot, *from = sbri_begins(c) + island->first_slot,
                   *to = sbri_targets(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *inverse_mass = inverse_masses(c, island);
  sbf_vec3 x = {0, 0, 0};
  end->count = 0;
  end->velocity_scale = m->velocity_scale;
  for (uint32_t k = 0; k < side->count; k++) {
    uint32_t s = side->slots[k];
    float weight = side->weights[k];
    x = sbri_add_scaled(x, sbri_vec3(p[s].x, p[s].y, p[s].z), weight);
    if (s >= island->free_count) {
      sbf_vec3 displacement = sbri_vec3(to[s].x - from[s].x, to[s].y - from[s].y, to[s].z - from[s].z);
      end->prescribed_velocity = sbri_add_scaled(
          end->prescribed_velocity, displacement, weight * m->pinned_rate * m->velocity_scale);
      continue;
    }
    end->velocities[end->count] = velocities + 3 * (s / SBRI_BLOCK * SBRI_BLOCK) + s % SBRI_BLOCK;
    end->weights[end->count] = weight;
    end->point_responses[end->count++] = weight * inverse_mass[s] / (m->mass * m->velocity_scale);
  }
  return sbri_add_scaled(m->offset, x, m->scale);
}

static sbf_vec3 prepare_side(const sbri_body_contacts *all, const sbri_contact_group *group,
    const sbri_contact_side *side, sbri_constraint_side *end) {
  const sbri_group_member *m = &all->members[group->first_member + side->member];
  end->body = NULL;
  end->prescribed_velocity = end->lever_arm = sbri_vec3(0, 0, 0);
  end->count = 0;
  end->velocity_scale = 0; /* unused, but multiplied by */
  if (side->rigid_body == SBRI_CONTACT_SOFT) return soft_position(m, side, end);
  if (side->external) {
    end->body = &all->solver_bodies[group->first_solver_body + m->first_external + side->external - 1];
    const sbri_external_body *g = external_of(m, end->body);
    sbf_vec3 moved_by = sbri_scale(sbri_cross(g->begin_angular_velocity, side->point), g->elapsed_s);
    end->lever_arm = sbri_scale(sbri_add(side->point, moved_by), m->scale);
    return sbri_add(end->body->position, end->lever_arm);
  }
  if (side->rigid_body == SBRI_CONTACT_PLANE) {
    end->prescribed_velocity = side->plane_velocity;
    return sbri_add_scaled(
        side->point, side->plane_velocity, m->tick_fraction * m->tick_s / m->character->time_scale);
  }
  if (!is_dynamic(m, (uint32_t)side->rigid_body))
    return kinematic_position(m, side, &end->prescribed_velocity);
  end->body =
      &all->solver_bodies[group->first_solver_body + m->first_solver_body + (uint32_t)side->rigid_body];
  end->lever_arm = rotate(end->body->rotation, sbri_scale(side->point, m->scale));
  return sbri_add(end->body->position, end->lever_arm);
}

/* Adds the inverse mass of a side: xx yy zz xy xz yz. */
static void add_inverse_mass(const sbri_constraint_side *end, float inverse_mass[6]) {
  float own = 0;
  if (end->body) {
    const sbri_solver_body *m = end->body;
    const float r[3] = {end->lever_arm.x, end->lever_arm.y, end->lever_arm.z};
    /* -[r] I^-1 [r] */
    const float cross[3][3] = {{0, -r[2], r[1]}, {r[2], 0, -r[0]}, {-r[1], r[0], 0}};
    float left[3][3], both[3][3];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        left[i][j] = 0;
        for (int k = 0; k < 3; k++) left[i][j] += cross[i][k] * m->inverse_inertia[k][j];
      }
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        both[i][j] = 0;
        for (int k = 0; k < 3; k++) both[i][j] -= left[i][k] * cross[k][j];
      }
    inverse_mass[0] += both[0][0], inverse_mass[1] += both[1][1], inverse_mass[2] += both[2][2];
    inverse_mass[3] += both[1][0], inverse_mass[4] += both[2][0], inverse_mass[5] += both[2][1];
    own = m->inverse_mass;
  }
  for (uint32_t k = 0; k < end->count; k++)
    own += end->weights[k] * end->point_responses[k] * end->velocity_scale;
  for (int i = 0; i < 3; i++) inverse_mass[i] += own;
}

/* Inverse of a symmetric positive definite matrix; of 0: 0. */
static void invert(const float a[6], float to[6]) {
  float xx = a[1] * a[2] - a[5] * a[5], xy = a[4] * a[5] - a[3] * a[2], xz = a[3] * a[5] - a[1] * a[4];
  float determinant = a[0] * xx + a[3] * xy + a[4] * xz, inverse = determinant > 0 ? 1 / determinant : 0;
  to[0] = xx * inverse, to[3] = xy * inverse, to[4] = xz * inverse;
  to[1] = (a[0] * a[2] - a[4] * a[4]) * inverse;
  to[2] = (a[0] * a[1] - a[3] * a[3]) * inverse;
  to[5] = (a[3] * a[4] - a[0] * a[5]) * inverse;
}

/* Whether the lever arm differs from the one the masses were computed for. */
static bool has_arm_changed(const sbri_constraint_side *end) {
  sbf_vec3 offset = sbri_sub(end->lever_arm, end->prepared_arm);
  return end->body && sbri_dot(offset, offset) > ARM_CHANGE_FRACTION * ARM_CHANGE_FRACTION *
                                                     sbri_dot(end->lever_arm, end->lever_arm);
}

void sbri_contact_constraint_prepare(const sbri_body_contacts *all, const sbri_contact_group *group,
    sbri_contact_constraint *row, bool is_new) {
  const sbri_contact *t = row->contact;
  sbf_vec3 a = prepare_side(all, group, &t->a, &row->a), b = prepare_side(all, group, &t->b, &row->b),
           n = t->normal;
  /* One point for both sides: two points would exert a moment. */
  bool rigid = t->a.rigid_body >= 0 && t->b.rigid_body >= 0, plane = t->b.rigid_body == SBRI_CONTACT_PLANE;
  sbf_vec3 point = rigid ? sbri_lerp(a, b, 0.5f) : t->a.rigid_body < 0 || plane ? a : b;
  sbf_vec3 offset = sbri_sub(a, b);
  if (row->a.body && row->b.body) { /* differences of small numbers lose less to rounding */
    const sbri_solver_body *one = row->a.body, *other = row->b.body;
    offset = sbri_add(sbri_sub(one->position, other->position),
        sbri_sub(one->position_remainder, other->position_remainder));
    offset = sbri_add(offset, sbri_sub(row->a.lever_arm, row->b.lever_arm));
  }
  if (row->a.body) row->a.lever_arm = sbri_sub(point, row->a.body->position);
  if (row->b.body) row->b.lever_arm = sbri_sub(point, row->b.body->position);
  row->offset = offset;
  row->position = point;
  row->separation = sbri_dot(n, offset) - t->margin;
  bool must_prepare = is_new || t->b.external; /* an external body's response grows during the tick */
  if (!must_prepare && !has_arm_changed(&row->a) && !has_arm_changed(&row->b)) return;
  row->a.prepared_arm = row->a.lever_arm, row->b.prepared_arm = row->b.lever_arm;
  for (int i = 0; i < 6; i++) row->inverse_mass[i] = 0;
  add_inverse_mass(&row->a, row->inverse_mass);
  add_inverse_mass(&row->b, row->inverse_mass);
  const float *e = row->inverse_mass;
  float along = n.x * n.x * e[0] + n.y * n.y * e[1] + n.z * n.z * e[2] +
                2 * (n.x * n.y * e[3] + n.x * n.z * e[4] + n.y * n.z * e[5]);
  row->normal = n;
  row->friction = t->friction;
  row->normal_mass = along > 0 ? 1 / along : 0;
  invert(e, row->effective_mass);
}
