/* What pushes work on: bodies and points as plain numbers of the world, read before a step's pushes and
 * written after them. */
#include "math/vec3.h"
#include "meet/meetings.h"

/* An arm may change by so much before its eases are made anew: they tell how to find a push, not what it
 * does. */
static const float TURNED_SHARE = 0.05f;

static bool gives_way(const sbri_meet_member *m, uint32_t body) {
  return m->parts.steps && sbri_rigid_is_simulated(m->character, body);
}

/* ---- Movers ---- */

void sbri_meet_movers_list(const sbri_meetings *all, sbri_meet_group *group) {
  sbri_meet_mover *movers = all->movers + group->first_mover;
  group->mover_count = 0;
  for (uint32_t i = 0; i < group->member_count; i++) {
    sbri_meet_member *m = &all->members[group->first_member + i];
    m->first_mover = group->mover_count;
    for (uint32_t b = 0; b < m->character->model->rigid.body_count; b++)
      movers[group->mover_count++] = (sbri_meet_mover){.member = i, .body = b};
    m->first_guest = group->mover_count;
    for (uint32_t k = 1; k <= sbri_meet_guests_of(m); k++)
      movers[group->mover_count++] = (sbri_meet_mover){.member = i, .guest = k};
  }
}

static sbf_vec3 turned(float turn[3][3], sbf_vec3 x) {
  return sbri_vec3(turn[0][0] * x.x + turn[0][1] * x.y + turn[0][2] * x.z,
      turn[1][0] * x.x + turn[1][1] * x.y + turn[1][2] * x.z,
      turn[2][0] * x.x + turn[2][1] * x.y + turn[2][2] * x.z);
}

static sbf_vec3 turned_back(float turn[3][3], sbf_vec3 x) {
  return sbri_vec3(turn[0][0] * x.x + turn[1][0] * x.y + turn[2][0] * x.z,
      turn[0][1] * x.x + turn[1][1] * x.y + turn[2][1] * x.z,
      turn[0][2] * x.x + turn[1][2] * x.y + turn[2][2] * x.z);
}

static void read_mover(const sbri_meet_member *m, sbri_meet_mover *to) {
  const sbri_rigid_body *body = &m->character->model->rigid.bodies[to->body];
  const sbri_rigid_body_state *s = &sbri_rigid_bodies(m->character)[to->body];
  sbf_quat q = s->pose.rotation;
  const float size = m->scale, inertia = m->mass * size * size, rate = m->speed / size;
  const sbf_vec3 columns[3] = {sbri_rotate(q, sbri_vec3(1, 0, 0)), sbri_rotate(q, sbri_vec3(0, 1, 0)),
      sbri_rotate(q, sbri_vec3(0, 0, 1))};
  for (int k = 0; k < 3; k++)
    to->turn[0][k] = columns[k].x, to->turn[1][k] = columns[k].y, to->turn[2][k] = columns[k].z;
  const float own[3] = {body->inverse_inertia.x / inertia, body->inverse_inertia.y / inertia,
      body->inverse_inertia.z / inertia};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) {
      float sum = 0;
      for (int k = 0; k < 3; k++) sum += own[k] * to->turn[i][k] * to->turn[j][k];
      to->eases[i][j] = to->eases[j][i] = sum;
    }
  to->position = sbri_add_scaled(m->offset, s->pose.position, size);
  to->fine = sbri_scale(s->fine, size);
  to->velocity = sbri_four_of(sbri_scale(s->velocity, m->speed));
  sbf_vec3 spin = turned_back(to->turn, s->spin), e = body->inverse_inertia;
  spin = turned(to->turn, sbri_vec3(spin.x * e.x, spin.y * e.y, spin.z * e.z));
  to->spin = sbri_four_of(sbri_scale(spin, rate));
  to->ease = body->inverse_mass / m->mass;
  to->given = to->moment = sbri_vec3(0, 0, 0);
}

static sbri_guest *guest_of(const sbri_meet_member *m, const sbri_meet_mover *mover) {
  return &m->parts.work.guests[mover->guest - 1].is;
}

/* A body of the host goes a way by each change of its velocity that is longer the later in the tick that is
 * (collide/guest.h). */
static float lever_of(const sbri_meet_group *group, const sbri_meet_member *m, const sbri_guest *g) {
  return 1 + g->elapsed_s / (group->step_s * m->character->time_scale);
}

static void read_guest(const sbri_meet_group *group, const sbri_meet_member *m, sbri_meet_mover *to) {
  const sbri_guest *g = guest_of(m, to);
  static const int places[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  float lever = lever_of(group, m, g), inertia = m->mass * m->scale * m->scale;
  sbf_vec3 at = sbri_add_scaled(g->centre, g->begin_velocity, g->elapsed_s);
  to->position = sbri_add_scaled(m->offset, at, m->scale);
  to->fine = to->given = to->moment = sbri_vec3(0, 0, 0);
  to->velocity = sbri_four_of(sbri_scale(g->begin_velocity, m->speed));
  to->spin = sbri_four_of(sbri_scale(g->begin_spin, m->speed / m->scale));
  to->ease = lever * g->most_ease / m->mass;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) to->eases[i][j] = lever * g->turn_ease[places[i][j]] / inertia;
}

static void write_guest(const sbri_meet_member *m, const sbri_meet_mover *from) {
  sbri_guest *g = guest_of(m, from);
  float impulse = 1 / (m->mass * m->speed);
  g->begin_velocity = sbri_add_scaled(g->begin_velocity, from->given, g->most_ease * impulse);
  sbf_vec3 turn = sbri_guest_times(g->turn_ease, sbri_scale(from->moment, impulse / m->scale));
  g->begin_spin = sbri_add(g->begin_spin, turn);
}

sbf_vec3 sbri_meet_guest_fall(const sbri_meet_group *group, const sbri_meet_member *m, uint32_t guest) {
  const sbri_guest *g = &m->parts.work.guests[guest - 1].is;
  return sbri_scale(g->acceleration, lever_of(group, m, g));
}

void sbri_meet_movers_read(const sbri_meetings *all, const sbri_meet_group *group) {
  for (uint32_t i = 0; i < group->mover_count; i++) {
    sbri_meet_mover *mover = &all->movers[group->first_mover + i];
    const sbri_meet_member *m = &all->members[group->first_member + mover->member];
    if (mover->guest)
      read_guest(group, m, mover);
    else if (gives_way(m, mover->body))
      read_mover(m, mover);
  }
}

void sbri_meet_movers_write(const sbri_meetings *all, const sbri_meet_group *group) {
  for (uint32_t i = 0; i < group->mover_count; i++) {
    const sbri_meet_mover *mover = &all->movers[group->first_mover + i];
    const sbri_meet_member *m = &all->members[group->first_member + mover->member];
    if (mover->guest) write_guest(m, mover);
    if (mover->guest || !gives_way(m, mover->body)) continue;
    sbri_rigid_body_state *s = &sbri_rigid_bodies(m->character)[mover->body];
    s->velocity = sbri_add_scaled(s->velocity, mover->given, mover->ease / m->speed);
    s->spin = sbri_add_scaled(s->spin, mover->moment, 1 / (m->mass * m->speed * m->scale));
  }
}

/* ---- Ends ---- */

/* A rigid body that follows its bone. */
static sbf_vec3 led_place(const sbri_meet_member *m, const sbri_meet_side *side, sbf_vec3 *velocity) {
  const sbri_character *c = m->character;
  uint32_t body = (uint32_t)side->rigid_body;
  sbr_transform from = sbri_rigid_target(c, sbri_previous_pose(c), body),
                to = sbri_rigid_target(c, sbri_pose(c), body);
  sbf_vec3 a = sbri_add(from.position, sbri_rotate(from.rotation, side->at)),
           b = sbri_add(to.position, sbri_rotate(to.rotation, side->at));
  *velocity = sbri_scale(sbri_sub(b, a), m->speed / m->tick_s);
  return sbri_add_scaled(m->offset, sbri_lerp(a, b, m->reached), m->scale);
}

static const float *inverse_masses(const sbri_character *c, const sbri_island *island) {
  return island->splits ? sbri_inverse_masses(c) + island->first_slot : island->inverse_masses;
}

static sbf_vec3 soft_place(const sbri_meet_member *m, const sbri_meet_side *side, sbri_meet_end *end) {
  const sbri_character *c = m->character;
  const sbri_island *island = &c->model->islands[side->island];
  const sbri_point *p = sbri_positions(c) + island->first_slot, *from = sbri_begins(c) + island->first_slot,
                   *to = sbri_targets(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *ease = inverse_masses(c, island);
  sbf_vec3 x = {0, 0, 0};
  end->count = 0;
  end->speed = m->speed;
  for (uint32_t k = 0; k < side->count; k++) {
    uint32_t s = side->slots[k];
    float weight = side->weights[k];
    x = sbri_add_scaled(x, sbri_vec3(p[s].x, p[s].y, p[s].z), weight);
    if (s >= island->free_count) {
      sbf_vec3 way = sbri_vec3(to[s].x - from[s].x, to[s].y - from[s].y, to[s].z - from[s].z);
      end->still = sbri_add_scaled(end->still, way, weight * m->held_rate * m->speed);
      continue;
    }
    end->points[end->count] = velocities + 3 * (s / SBRI_BLOCK * SBRI_BLOCK) + s % SBRI_BLOCK;
    end->weights[end->count] = weight;
    end->eases[end->count++] = weight * ease[s] / (m->mass * m->speed);
  }
  return sbri_add_scaled(m->offset, x, m->scale);
}

static sbf_vec3 begin_end(
    const sbri_meetings *all, const sbri_meet_group *group, const sbri_meet_side *side, sbri_meet_end *end) {
  const sbri_meet_member *m = &all->members[group->first_member + side->member];
  end->mover = NULL;
  end->still = end->arm = sbri_vec3(0, 0, 0);
  end->count = 0;
  end->speed = 0; /* of nothing, but it is multiplied by */
  if (side->rigid_body == SBRI_MEET_SOFT) return soft_place(m, side, end);
  if (side->guest) {
    end->mover = &all->movers[group->first_mover + m->first_guest + side->guest - 1];
    const sbri_guest *g = guest_of(m, end->mover);
    sbf_vec3 turned_by = sbri_scale(sbri_cross(g->begin_spin, side->at), g->elapsed_s);
    end->arm = sbri_scale(sbri_add(side->at, turned_by), m->scale);
    return sbri_add(end->mover->position, end->arm);
  }
  if (side->rigid_body == SBRI_MEET_PLANE) {
    end->still = side->goes;
    return sbri_add_scaled(side->at, side->goes, m->reached * m->tick_s / m->character->time_scale);
  }
  if (!gives_way(m, (uint32_t)side->rigid_body)) return led_place(m, side, &end->still);
  end->mover = &all->movers[group->first_mover + m->first_mover + (uint32_t)side->rigid_body];
  end->arm = turned(end->mover->turn, sbri_scale(side->at, m->scale));
  return sbri_add(end->mover->position, end->arm);
}

/* What a push there would change its velocity by: adds to xx yy zz xy xz yz. */
static void add_eases(const sbri_meet_end *end, float eases[6]) {
  float own = 0;
  if (end->mover) {
    const sbri_meet_mover *m = end->mover;
    const float r[3] = {end->arm.x, end->arm.y, end->arm.z};
    /* -[r] E [r], E being the eases of turning. */
    const float cross[3][3] = {{0, -r[2], r[1]}, {r[2], 0, -r[0]}, {-r[1], r[0], 0}};
    float left[3][3], both[3][3];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        left[i][j] = 0;
        for (int k = 0; k < 3; k++) left[i][j] += cross[i][k] * m->eases[k][j];
      }
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        both[i][j] = 0;
        for (int k = 0; k < 3; k++) both[i][j] -= left[i][k] * cross[k][j];
      }
    eases[0] += both[0][0], eases[1] += both[1][1], eases[2] += both[2][2];
    eases[3] += both[1][0], eases[4] += both[2][0], eases[5] += both[2][1];
    own = m->ease;
  }
  for (uint32_t k = 0; k < end->count; k++) own += end->weights[k] * end->eases[k] * end->speed;
  for (int i = 0; i < 3; i++) eases[i] += own;
}

/* Of a symmetric matrix that is positive definite, or 0. */
static void invert(const float a[6], float to[6]) {
  float xx = a[1] * a[2] - a[5] * a[5], xy = a[4] * a[5] - a[3] * a[2], xz = a[3] * a[5] - a[1] * a[4];
  float whole = a[0] * xx + a[3] * xy + a[4] * xz, share = whole > 0 ? 1 / whole : 0;
  to[0] = xx * share, to[3] = xy * share, to[4] = xz * share;
  to[1] = (a[0] * a[2] - a[4] * a[4]) * share;
  to[2] = (a[0] * a[1] - a[3] * a[3]) * share;
  to[5] = (a[3] * a[4] - a[0] * a[5]) * share;
}

/* Whether its arm is another than the eases were made for. */
static bool has_turned(const sbri_meet_end *end) {
  sbf_vec3 off = sbri_sub(end->arm, end->made);
  return end->mover && sbri_dot(off, off) > TURNED_SHARE * TURNED_SHARE * sbri_dot(end->arm, end->arm);
}

void sbri_meet_row_begin(
    const sbri_meetings *all, const sbri_meet_group *group, sbri_meet_row *row, bool is_new) {
  const sbri_meet_touch *t = row->touch;
  sbf_vec3 a = begin_end(all, group, &t->a, &row->a), b = begin_end(all, group, &t->b, &row->b),
           n = t->normal;
  /* One place for both, or there would be a moment between them. */
  bool rigid = t->a.rigid_body >= 0 && t->b.rigid_body >= 0, plane = t->b.rigid_body == SBRI_MEET_PLANE;
  sbf_vec3 middle = rigid ? sbri_lerp(a, b, 0.5f) : t->a.rigid_body < 0 || plane ? a : b;
  sbf_vec3 off = sbri_sub(a, b);
  if (row->a.mover && row->b.mover) { /* small numbers, so that little is rounded off */
    const sbri_meet_mover *one = row->a.mover, *other = row->b.mover;
    off = sbri_add(sbri_sub(one->position, other->position), sbri_sub(one->fine, other->fine));
    off = sbri_add(off, sbri_sub(row->a.arm, row->b.arm));
  }
  if (row->a.mover) row->a.arm = sbri_sub(middle, row->a.mover->position);
  if (row->b.mover) row->b.arm = sbri_sub(middle, row->b.mover->position);
  row->apart = off;
  row->place = middle;
  row->gap = sbri_dot(n, off) - t->margin;
  bool is_other = is_new || t->b.guest; /* whose eases grow with the tick */
  if (!is_other && !has_turned(&row->a) && !has_turned(&row->b)) return;
  row->a.made = row->a.arm, row->b.made = row->b.arm;
  for (int i = 0; i < 6; i++) row->eases[i] = 0;
  add_eases(&row->a, row->eases);
  add_eases(&row->b, row->eases);
  const float *e = row->eases;
  float along = n.x * n.x * e[0] + n.y * n.y * e[1] + n.z * n.z * e[2] +
                2 * (n.x * n.y * e[3] + n.x * n.z * e[4] + n.y * n.z * e[5]);
  row->normal = n;
  row->friction = t->friction;
  row->mass = along > 0 ? 1 / along : 0;
  invert(e, row->block);
}
