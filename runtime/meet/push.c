/* Touching places push each other off, before a step.
 *
 * What each touch needs is found in turn, corrected by what the others have left of it, never pulling and
 * never rubbing by more than its friction (projected Gauss-Seidel over gathered impulses; E. Catto, Iterative
 * Dynamics with Temporal Coherence, 2005). Weight, springs and joints act in the step that follows: what
 * they changed the touch's velocity by in the step before they are taken to change it by again, so that what
 * rests is borne, and does not sink by a step's fall each time. */
#include "math/vec3.h"
#include "meet/meetings.h"

enum { SWEEPS = 150 }; /* at most: heaps need many, most need few */
/* Slower contacts do not bounce. */
static const float BOUNCE_FROM_M_S = 0.3f;
/* What is deeper than this comes out by that share of it a step, and no faster; soft matter in soft matter,
 * whose surfaces are never quite of one form, by less. */
static const float SLACK_M = 1e-4f, OUT_SHARE = 0.1f, SOFT_OUT_SHARE = 0.02f, OUT_M_S = 0.2f;
static const float SETTLED_M_S = 3e-5f;

/* ---- Sides ---- */

static const float *inverse_masses(const sbri_character *c, const sbri_island *island) {
  return island->splits ? sbri_inverse_masses(c) + island->first_slot : island->inverse_masses;
}

/* A rigid body's own frame now, asset metres. */
static sbr_transform frame_of(const sbri_meet_member *m, uint32_t body) {
  const sbri_rigid_body_state *s = &sbri_rigid_bodies(m->character)[body];
  if (m->parts.steps && sbri_rigid_is_simulated(m->character, body)) return s->pose;
  sbr_transform from = sbri_rigid_target(m->character, sbri_previous_pose(m->character), body),
                to = sbri_rigid_target(m->character, sbri_pose(m->character), body);
  return (sbr_transform){sbri_lerp(from.position, to.position, m->reached),
      sbri_quat_blend(from.rotation, to.rotation, m->reached)};
}

static bool gives_way(const sbri_meet_member *m, uint32_t body) {
  return m->parts.steps && sbri_rigid_is_simulated(m->character, body);
}

sbf_vec3 sbri_meet_place(const sbri_meet_member *members, const sbri_meet_side *side) {
  const sbri_meet_member *m = &members[side->member];
  sbf_vec3 x = {0, 0, 0};
  if (side->rigid_body == SBRI_MEET_PLANE)
    return sbri_add_scaled(side->at, side->arm, m->reached * m->tick_s / m->character->time_scale);
  if (side->rigid_body >= 0) {
    sbr_transform frame = frame_of(m, (uint32_t)side->rigid_body);
    x = sbri_add(frame.position, sbri_rotate(frame.rotation, side->at));
  } else {
    const sbri_point *p =
        sbri_positions(m->character) + m->character->model->islands[side->island].first_slot;
    for (uint32_t k = 0; k < side->count; k++) {
      const sbri_point *at = &p[side->slots[k]];
      x = sbri_add_scaled(x, sbri_vec3(at->x, at->y, at->z), side->weights[k]);
    }
  }
  return sbri_add_scaled(m->offset, x, m->scale);
}

static sbf_vec3 rigid_velocity(const sbri_meet_member *m, const sbri_meet_side *side) {
  const sbri_character *c = m->character;
  uint32_t body = (uint32_t)side->rigid_body;
  if (gives_way(m, body)) {
    const sbri_rigid_body_state *s = &sbri_rigid_bodies(c)[body];
    sbf_vec3 turn = sbri_spin_velocity(&c->model->rigid.bodies[body], s->pose.rotation, s->spin);
    return sbri_add(s->velocity, sbri_cross(turn, side->arm));
  }
  sbr_transform from = sbri_rigid_target(c, sbri_previous_pose(c), body),
                to = sbri_rigid_target(c, sbri_pose(c), body);
  sbf_vec3 a = sbri_add(from.position, sbri_rotate(from.rotation, side->at)),
           b = sbri_add(to.position, sbri_rotate(to.rotation, side->at));
  return sbri_scale(sbri_sub(b, a), 1 / m->tick_s);
}

sbf_vec3 sbri_meet_velocity(const sbri_meet_member *members, const sbri_meet_side *side) {
  const sbri_meet_member *m = &members[side->member];
  if (side->rigid_body == SBRI_MEET_PLANE) return side->arm;
  if (side->rigid_body >= 0) return sbri_scale(rigid_velocity(m, side), m->speed);
  const sbri_island *island = &m->character->model->islands[side->island];
  const float *velocities = sbri_velocities(m->character) + 3 * (size_t)island->first_slot;
  const sbri_point *from = sbri_begins(m->character) + island->first_slot,
                   *to = sbri_targets(m->character) + island->first_slot;
  sbf_vec3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < side->count; k++) {
    uint32_t s = side->slots[k];
    const float *v = velocities + 3 * (s / SBRI_BLOCK * SBRI_BLOCK) + s % SBRI_BLOCK;
    sbf_vec3 own = s < island->free_count
                       ? sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK])
                       : sbri_scale(sbri_vec3(to[s].x - from[s].x, to[s].y - from[s].y, to[s].z - from[s].z),
                             m->held_rate);
    sum = sbri_add_scaled(sum, own, side->weights[k]);
  }
  return sbri_scale(sum, m->speed);
}

/* What a moment changes a rigid body's angular velocity by. */
static sbf_vec3 eased(const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 moment) {
  sbf_vec3 own = sbri_rotate(sbri_quat_conjugate(turn), moment);
  own = sbri_vec3(
      own.x * body->inverse_inertia.x, own.y * body->inverse_inertia.y, own.z * body->inverse_inertia.z);
  return sbri_rotate(turn, own);
}

/* Inverse mass along a unit direction, 1/kg. */
static float ease_of(const sbri_meet_member *members, const sbri_meet_side *side, sbf_vec3 along) {
  const sbri_meet_member *m = &members[side->member];
  float sum = 0;
  if (side->rigid_body == SBRI_MEET_PLANE) return 0;
  if (side->rigid_body >= 0) {
    const sbri_rigid_body *body = &m->character->model->rigid.bodies[side->rigid_body];
    if (!gives_way(m, (uint32_t)side->rigid_body)) return 0;
    sbf_quat turn = sbri_rigid_bodies(m->character)[side->rigid_body].pose.rotation;
    sbf_vec3 arm = sbri_cross(side->arm, along);
    sum = body->inverse_mass + sbri_dot(arm, eased(body, turn, arm));
  } else {
    const sbri_island *island = &m->character->model->islands[side->island];
    const float *ease = inverse_masses(m->character, island);
    for (uint32_t k = 0; k < side->count; k++)
      if (side->slots[k] < island->free_count)
        sum += side->weights[k] * side->weights[k] * ease[side->slots[k]];
  }
  return sum / m->mass;
}

static void give(const sbri_meet_member *members, const sbri_meet_side *side, sbf_vec3 impulse) {
  const sbri_meet_member *m = &members[side->member];
  if (side->rigid_body == SBRI_MEET_PLANE) return;
  sbf_vec3 faster = sbri_scale(impulse, 1 / (m->mass * m->speed));
  if (side->rigid_body >= 0) {
    const sbri_rigid_body *body = &m->character->model->rigid.bodies[side->rigid_body];
    if (!gives_way(m, (uint32_t)side->rigid_body)) return;
    sbri_rigid_body_state *s = &sbri_rigid_bodies(m->character)[side->rigid_body];
    s->velocity = sbri_add_scaled(s->velocity, faster, body->inverse_mass);
    s->spin = sbri_add(s->spin, sbri_cross(side->arm, faster));
    return;
  }
  const sbri_island *island = &m->character->model->islands[side->island];
  const float *ease = inverse_masses(m->character, island);
  float *velocities = sbri_velocities(m->character) + 3 * (size_t)island->first_slot;
  for (uint32_t k = 0; k < side->count; k++) {
    uint32_t slot = side->slots[k];
    if (slot >= island->free_count) continue;
    float share = side->weights[k] * ease[slot];
    float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    v[0] += share * faster.x, v[SBRI_BLOCK] += share * faster.y, v[2 * SBRI_BLOCK] += share * faster.z;
  }
}

/* ---- Touches ---- */

static const sbf_vec3 nothing = {0, 0, 0};

static sbf_vec3 velocity_of(const sbri_meet_member *members, const sbri_meet_touch *t) {
  return sbri_sub(sbri_meet_velocity(members, &t->a), sbri_meet_velocity(members, &t->b));
}

static void push(const sbri_meet_member *members, const sbri_meet_touch *t, sbf_vec3 impulse) {
  give(members, &t->a, impulse);
  give(members, &t->b, sbri_scale(impulse, -1));
}

static float mass_of(const sbri_meet_member *members, const sbri_meet_touch *t, sbf_vec3 along) {
  float ease = ease_of(members, &t->a, along) + ease_of(members, &t->b, along);
  return ease > 0 ? 1 / ease : 0;
}

static bool both_are_soft(const sbri_meet_touch *t) {
  return t->a.rigid_body == SBRI_MEET_SOFT && t->b.rigid_body == SBRI_MEET_SOFT;
}

/* The speed with which what is too deep comes out. */
static float way_out(const sbri_meet_touch *t, float step_s) {
  float speed = (both_are_soft(t) ? SOFT_OUT_SHARE : OUT_SHARE) * (-t->gap - SLACK_M) / step_s;
  return speed > OUT_M_S ? OUT_M_S : speed > 0 ? speed : 0;
}

static void reach(const sbri_meet_member *members, sbri_meet_side *side, sbf_vec3 place) {
  const sbri_meet_member *m = &members[side->member];
  if (side->rigid_body < 0) return;
  sbf_vec3 own = sbri_scale(sbri_sub(place, m->offset), 1 / m->scale);
  side->arm = sbri_sub(own, frame_of(m, (uint32_t)side->rigid_body).position);
}

/* What both may come to at the step's end, and what pushes of the step before they begin with. */
static void begin(const sbri_meet_member *members, sbri_meet_touch *t, float step_s) {
  sbf_vec3 a = sbri_meet_place(members, &t->a), b = sbri_meet_place(members, &t->b);
  /* One place for both, or there would be a moment between them. */
  bool rigid = t->a.rigid_body >= 0 && t->b.rigid_body >= 0, plane = t->b.rigid_body == SBRI_MEET_PLANE;
  sbf_vec3 middle = rigid ? sbri_lerp(a, b, 0.5f) : t->a.rigid_body < 0 || plane ? a : b;
  reach(members, &t->a, middle);
  reach(members, &t->b, middle);
  sbf_vec3 v = velocity_of(members, t);
  t->gap = sbri_dot(t->normal, sbri_sub(a, b)) - t->margin;
  float speed = sbri_dot(t->normal, v), drift = sbri_dot(t->normal, t->drift);
  t->wanted = t->gap > 0 ? -t->gap / step_s : plane ? 0 : way_out(t, step_s);
  t->expected = t->drift;
  if (t->gap + step_s * speed < 0 && -t->restitution * speed > t->wanted && speed < -BOUNCE_FROM_M_S) {
    t->wanted = -t->restitution * speed;
    t->expected = nothing;
  } else {
    sbf_vec3 side = rigid || plane ? sbri_add_scaled(t->drift, t->normal, -drift) : nothing;
    t->expected = sbri_add_scaled(side, t->normal, drift < 0 ? drift : 0);
  }
  t->mass = mass_of(members, t, t->normal);
  if (plane && speed < -BOUNCE_FROM_M_S) t->mass = 0, t->pushed = false; /* its own step throws it back */
  if (t->pushed) return; /* as much as before, to begin with */
  t->gain = 0;
  t->rub = nothing;
}

static float correct(const sbri_meet_member *members, sbri_meet_touch *t) {
  sbf_vec3 v = sbri_add(velocity_of(members, t), t->expected);
  float speed = sbri_dot(t->normal, v), gain = t->gain + t->mass * (t->wanted - speed);
  if (!(gain > 0)) gain = 0;
  if (gain == 0 && t->gain == 0) return 0;
  sbf_vec3 rub = t->rub, side = sbri_add_scaled(v, t->normal, -speed);
  float slip = sbri_length(side);
  if (slip > 0) rub = sbri_add_scaled(rub, side, -mass_of(members, t, sbri_scale(side, 1 / slip)));
  if (t->mass == 0) rub = nothing;
  float size = sbri_length(rub), most = t->friction * gain;
  if (size > most) rub = sbri_scale(rub, most / size);
  sbf_vec3 change = sbri_add_scaled(sbri_sub(rub, t->rub), t->normal, gain - t->gain);
  t->gain = gain, t->rub = rub;
  push(members, t, change);
  return t->mass > 0 ? sbri_length(change) / t->mass : 0;
}

/* Acceleration by weight of a side that it moves. */
static sbf_vec3 fall_of(const sbri_meet_member *members, const sbr_world *world, const sbri_meet_side *side) {
  const sbri_meet_member *m = &members[side->member];
  const sbr_model *model = m->character->model;
  sbf_vec3 weight = world->has_gravity ? world->gravity : model->asset->environment.gravity;
  if (side->rigid_body == SBRI_MEET_PLANE) return nothing;
  if (side->rigid_body == SBRI_MEET_SOFT) return weight;
  if (!gives_way(m, (uint32_t)side->rigid_body)) return nothing;
  return sbri_scale(weight, model->rigid.bodies[side->rigid_body].source->gravity_scale);
}

bool sbri_meet_push(const sbri_meetings *all, const sbri_meet_group *group, float step_s) {
  const sbri_meet_member *members = all->members + group->first_member;
  sbri_meet_touch *touches = all->touches + group->first_touch;
  for (uint32_t i = 0; i < group->touch_count; i++) begin(members, &touches[i], step_s);
  for (uint32_t i = 0; i < group->touch_count; i++)
    if (touches[i].pushed)
      push(members, &touches[i], sbri_add_scaled(touches[i].rub, touches[i].normal, touches[i].gain));
  float most = SETTLED_M_S;
  for (int sweep = 0; sweep < SWEEPS && most >= SETTLED_M_S; sweep++) {
    most = 0;
    for (uint32_t i = 0; i < group->touch_count; i++) {
      float change = correct(members, &touches[sweep % 2 ? group->touch_count - 1 - i : i]);
      most = change > most ? change : most;
    }
  }
  bool any = false;
  for (uint32_t i = 0; i < group->touch_count; i++) {
    sbri_meet_touch *t = &touches[i];
    t->pushed = t->gain > 0;
    any = any || t->pushed;
  }
  for (uint32_t i = 0; i < group->touch_count; i++) touches[i].after = velocity_of(members, &touches[i]);
  return any;
}

void sbri_meet_expect_fall(
    const sbri_meetings *all, const sbri_meet_group *group, const sbr_world *world, float step_s) {
  const sbri_meet_member *members = all->members + group->first_member;
  for (uint32_t i = 0; i < group->touch_count; i++) {
    sbri_meet_touch *t = &all->touches[group->first_touch + i];
    t->drift = sbri_scale(sbri_sub(fall_of(members, world, &t->a), fall_of(members, world, &t->b)), step_s);
  }
}

void sbri_meet_look(const sbri_meetings *all, const sbri_meet_group *group) {
  const sbri_meet_member *members = all->members + group->first_member;
  for (uint32_t i = 0; i < group->touch_count; i++) {
    sbri_meet_touch *t = &all->touches[group->first_touch + i];
    t->drift = sbri_sub(velocity_of(members, t), t->after);
  }
}
