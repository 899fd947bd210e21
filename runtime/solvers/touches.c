#include "solvers/touches.h"

#include <math.h>

#include "collide/external_body.h"
#include "contact/self_touch.h"
#include "math/vec3.h"
#include "solvers/held_push.h"

/* While some speed changes by more than this in a pass, another follows, in m/s: up to the passes that are
 * enough at rest, and up to the most. */
static const float SETTLED_M_S = 1e-3f, STRUCK_M_S = 0.05f;

/* What could not reach its plane in the substep if it were this much faster waits for the next one, in m/s:
 * most places near the ground do not touch it, and none of them is to cost passes. */
static const float NEAR_M_S = 1;

/* A point that is no higher over its plane touches it. */
static const float TOUCHES_M = 1e-5f;

/* Friction at this share of its limit slides. */
static const float SLIDES_SHARE = 0.999f;

/* In one substep. By row sums two are enough where there are pushes to go on from; a light external body
 * hangs from all that touches it at once. */
enum { PASSES = 2, MAX_PASSES = 16, MAX_EXTERNAL_BODY_PASSES = 64 };
static const float FINER_WITH_EXTERNAL_BODIES = 10;

typedef struct touching {
  const sbri_island_tick *tick;
  const sbri_body *body;
  float *velocities;
  sbri_touch *touches;
  uint32_t count;
  sbri_external_bodies *external_bodies; /* NULL: there are none */
  bool in_turn; /* each push sees those before it; else all are found together, by row sums */
  bool changed; /* others push, or may, than in the substep before */
} touching;

static touching touching_of(const sbri_island_tick *t, const sbri_body *body, float *velocities) {
  uint32_t count = sbri_touch_count(t, body);
  sbri_external_bodies *external_bodies =
      count && t->external_bodies ? &t->external_bodies[body - t->model->bodies] : NULL;
  if (external_bodies && !external_bodies->count) external_bodies = NULL;
  return (touching){.tick = t,
      .body = body,
      .velocities = velocities,
      .touches = t->touches + body->first_touch,
      .count = count,
      .external_bodies = external_bodies,
      .in_turn = external_bodies != NULL};
}

static sbri_external_body *external_body_of(const touching *c, const sbri_touch *touch) {
  return &c->external_bodies->at[touch->external_body - 1];
}

/* Of what the touch stands for. */
static sbf_vec3 velocity_under(const touching *c, const sbri_touch *touch) {
  return touch->external_body ? sbri_external_body_velocity(external_body_of(c, touch), touch->arm)
                              : touch->velocity;
}

/* Whether simulated bodies that hold points of the touch feel it: what flesh does to itself, they get back.
 */
static bool is_felt(const touching *c, const sbri_touch *touch) {
  return c->tick->reactions && touch->collider == SBRI_ITSELF;
}

static sbf_vec3 velocity_of(const touching *c, const sbri_touch *touch) {
  const sbri_sample *s = &touch->sample;
  const bool felt = is_felt(c, touch);
  sbf_vec3 v = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    if (s->weights[k] == 0) continue;
    v = sbri_add_scaled(v, sbri_slot_velocity(c->tick, c->velocities, s->slots[k]), s->weights[k]);
    if (felt) v = sbri_add_scaled(v, sbri_held_gain(c->tick, s->slots[k]), s->weights[k]);
  }
  return v;
}

static float gap_of(const touching *c, const sbri_touch *touch) {
  return sbri_dot(touch->normal, sbri_sample_place(c->tick, &touch->sample)) - touch->offset;
}

/* Of what the sample is pushed by, that its point k moves with. */
static float share_of(const touching *c, const sbri_sample *s, int k) {
  const sbri_island *island = c->tick->island;
  if (s->slots[k] >= island->free_count) return 0;
  return s->weights[k] * island->inverse_masses[s->slots[k]] * s->mass_kg;
}

/* What changes the velocity of the sample by `faster`. */
static void push(const touching *c, const sbri_touch *touch, sbf_vec3 faster) {
  const sbri_sample *s = &touch->sample;
  const bool felt = is_felt(c, touch);
  for (int k = 0; k < 4; k++) {
    float share = share_of(c, s, k);
    if (felt) sbri_held_push(c->tick, s->slots[k], sbri_scale(faster, s->weights[k] * s->mass_kg));
    if (share == 0) continue;
    float *v = c->velocities + 3 * (s->slots[k] / SBRI_BLOCK * SBRI_BLOCK) + s->slots[k] % SBRI_BLOCK;
    v[0] += share * faster.x, v[SBRI_BLOCK] += share * faster.y, v[2 * SBRI_BLOCK] += share * faster.z;
  }
}

/* And its place by `moved`; `felt`: by those that hold it too. */
static void move(const touching *c, const sbri_touch *touch, sbf_vec3 moved, bool felt) {
  const sbri_sample *s = &touch->sample;
  for (int k = 0; k < 4; k++) {
    float share = share_of(c, s, k);
    if (felt) sbri_held_shift(c->tick, s->slots[k], sbri_scale(moved, s->weights[k] * s->mass_kg));
    if (share == 0) continue;
    sbri_point *x = &c->tick->positions[s->slots[k]];
    x->x += share * moved.x, x->y += share * moved.y, x->z += share * moved.z;
  }
}

/* The other side of what changes the sample's velocity by `faster`. */
static void push_external_body(const touching *c, const sbri_touch *touch, sbf_vec3 faster) {
  sbri_external_body_push(external_body_of(c, touch), touch->arm, sbri_scale(faster, -touch->sample.mass_kg));
}

static float friction_of(const touching *c, const sbri_touch *touch, const sbri_contact_rule *rule) {
  const sbri_sample *s = &touch->sample;
  if (touch->crosses) return 0;
  if (!rule->frictions) return rule->friction * touch->friction_share;
  float sum = 0;
  if (touch->collider == SBRI_ITSELF) /* of the point alone */
    return s->slots[0] < c->tick->island->free_count ? rule->frictions[s->slots[0]] : rule->friction;
  for (int k = 0; k < 4; k++) {
    bool free = s->slots[k] < c->tick->island->free_count;
    sum += s->weights[k] * (free ? rule->frictions[s->slots[k]] : rule->friction);
  }
  return sum > 0 ? sum * touch->friction_share : 0;
}

/* To where it just arrives; nowhere, where it lies below already; thrown back, where it is fast. */
static float wanted_of(const sbri_touch *touch, float speed, const sbri_contact_rule *rule) {
  float arriving = touch->gap > 0 ? -touch->gap / rule->step_s : 0, back = -touch->restitution * speed;
  bool bounces = touch->gap + rule->step_s * speed < 0 && speed < -rule->bounce_from_m_s;
  return bounces && back > arriving ? back : arriving;
}

/* How long a place so far from its plane cannot get there, by what it was taken for a place that may touch
 * within the tick: its speed, twice, and what springs and weight add, which grows with the square of time. */
static float idle_time(const touching *c, const sbri_touch *touch, float gap) {
  float max = SBRI_MOTION_SHARE * c->body->rest_size_m, way = touch->fast_m_s * c->tick->tick_s;
  if (!(gap > 0) || !(touch->fast_m_s > 0) || !(max > 0)) return 0;
  return c->tick->tick_s * (2 * gap / (way + sqrtf(way * way + 4 * max * gap)));
}

/* By how much a push of 1 N s moves what holds the sample's points, at most: along whichever way. */
static float held_ease(const touching *c, const sbri_sample *s) {
  float sum = 0;
  for (int k = 0; k < 4; k++) {
    const sbri_reaction *r = sbri_reaction_at(c->tick, s->slots[k]);
    sbf_vec3 arm = {0, 0, 0};
    float weight = 0;
    bool first = true; /* of those that this body holds, which are moved as one */
    for (int i = 0; r && i < 4; i++) {
      if (sbri_reaction_at(c->tick, s->slots[i]) != r) continue;
      first = first && i >= k;
      weight += s->weights[i];
      arm = sbri_add_scaled(arm, sbri_reaction_arm(c->tick, r, s->slots[i]), s->weights[i]);
    }
    if (r && first) sum += r->ease * weight * weight + r->inverse_inertia * sbri_dot(arm, arm);
  }
  return sum;
}

/* The mass that a push on the body itself meets where bodies that hold it give way. */
static float mass_of(const touching *c, const sbri_sample *s) {
  float sum = held_ease(c, s);
  for (int k = 0; k < 4; k++)
    if (s->slots[k] < c->tick->island->free_count)
      sum += s->weights[k] * s->weights[k] * c->tick->island->inverse_masses[s->slots[k]];
  return 1 / sum;
}

/* Says whether it may touch. */
static bool begin(touching *c, sbri_touch *touch, const sbri_contact_rule *rule) {
  if (touch->collider == SBRI_ITSELF && !touch->crosses) sbri_self_touch_follow(c->tick, touch);
  if (is_felt(c, touch)) touch->sample.mass_kg = mass_of(c, &touch->sample);
  sbf_vec3 v = velocity_of(c, touch);
  float speed =
      sbri_dot(touch->normal, sbri_sub(v, c->external_bodies ? velocity_under(c, touch) : touch->velocity));
  touch->gap = gap_of(c, touch);
  touch->wanted = wanted_of(touch, speed, rule);
  c->in_turn = c->in_turn || touch->collider == SBRI_ITSELF;
  bool pushes = touch->gain > 0 || touch->gap + rule->step_s * speed < 0;
  c->changed = c->changed || pushes != touch->pushes;
  touch->pushes = pushes;
  if (touch->gain > 0 || touch->gap < rule->step_s * (NEAR_M_S - speed)) return true;
  touch->idle_s = idle_time(c, touch, touch->gap - rule->step_s * NEAR_M_S);
  return false;
}

/* What is below its plane and was pushed goes up, at a limited rate. */
static float lift_of(const sbri_touch *touch, const sbri_contact_rule *rule) {
  float up = -touch->gap - rule->slack_m;
  return up < rule->push_m ? up : rule->push_m;
}

/* What all that follows comes to for one that is alone: no other push changes what it sees. */
static void answer_alone(const touching *c, sbri_touch *touch, const sbri_contact_rule *rule) {
  uint32_t slot = touch->sample.slots[0];
  float *velocity = c->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
  sbri_point *x = &c->tick->positions[slot];
  sbf_vec3 n = touch->normal, v = {velocity[0], velocity[SBRI_BLOCK], velocity[2 * SBRI_BLOCK]};
  v = sbri_sub(v, touch->velocity);
  float speed = sbri_dot(n, v);
  touch->gap = sbri_dot(n, sbri_vec3(x->x, x->y, x->z)) - touch->offset;
  touch->gain = wanted_of(touch, speed, rule) - speed;
  if (!(touch->gain > 0)) {
    touch->gain = 0;
    return;
  }
  sbf_vec3 sideways = sbri_add_scaled(v, n, -speed);
  float size = sbri_length(sideways), max = friction_of(c, touch, rule) * touch->gain;
  touch->friction_impulse = sbri_scale(sideways, size > max ? -max / size : -1);
  sbf_vec3 change = sbri_add_scaled(touch->friction_impulse, n, touch->gain);
  velocity[0] += change.x, velocity[SBRI_BLOCK] += change.y, velocity[2 * SBRI_BLOCK] += change.z;
  float up = lift_of(touch, rule);
  if (up > 0) x->x += up * n.x, x->y += up * n.y, x->z += up * n.z;
  touch->pushed = touch->gain > touch->pushed ? touch->gain : touch->pushed;
}

/* Answers those that are alone, and brings those others that may touch to the front; how many. */
static uint32_t begin_all(touching *c, const sbri_contact_rule *rule) {
  uint32_t near = 0;
  for (uint32_t i = 0; i < c->count; i++) {
    sbri_touch *touch = &c->touches[i];
    touch->idle_s -= rule->step_s;
    if (touch->alone) answer_alone(c, touch, rule);
    if (touch->alone || touch->idle_s > rule->step_s || !begin(c, touch, rule)) continue;
    sbri_touch first = c->touches[near];
    c->touches[near++] = c->touches[i];
    c->touches[i] = first;
  }
  return near;
}

/* One push made right; by how much it changed. */
static float correct(const touching *c, sbri_touch *touch, const sbri_contact_rule *rule) {
  sbf_vec3 v = sbri_sub(velocity_of(c, touch), touch->velocity), n = touch->normal;
  float speed = sbri_dot(n, v), gain = touch->gain + touch->share * (touch->wanted - speed);
  if (!(gain > 0)) gain = 0;
  if (gain == 0 && touch->gain == 0) return 0;
  sbf_vec3 friction_impulse =
      sbri_add_scaled(touch->friction_impulse, sbri_add_scaled(v, n, -speed), -touch->share);
  float size = sbri_length(friction_impulse), max = friction_of(c, touch, rule) * gain;
  if (size > max) friction_impulse = sbri_scale(friction_impulse, max / size);
  sbf_vec3 change =
      sbri_add_scaled(sbri_sub(friction_impulse, touch->friction_impulse), n, gain - touch->gain);
  touch->gain = gain, touch->friction_impulse = friction_impulse;
  push(c, touch, change);
  return sbri_length(change);
}

/* The same against an external body: what that gives way by is not the sample's to gain. */
static float correct_with_external_body(const touching *c, sbri_touch *touch, const sbri_contact_rule *rule) {
  const sbri_sample *s = &touch->sample;
  const sbri_external_body *g = external_body_of(c, touch);
  sbf_vec3 arm = touch->arm, v = sbri_sub(velocity_of(c, touch), sbri_external_body_velocity(g, arm)),
           n = touch->normal;
  float along = 1 + s->mass_kg * sbri_dot(n, sbri_external_body_answer(g, arm, n));
  float across =
      1 + s->mass_kg * g->lever * (g->max_inverse_mass + sbri_dot(arm, arm) * g->max_inverse_inertia);
  float speed = sbri_dot(n, v), gain = touch->gain + (touch->wanted - speed) / along;
  if (!(gain > 0)) gain = 0;
  if (gain == 0 && touch->gain == 0) return 0;
  sbf_vec3 friction_impulse =
      sbri_add_scaled(touch->friction_impulse, sbri_add_scaled(v, n, -speed), -1 / across);
  float size = sbri_length(friction_impulse), max = friction_of(c, touch, rule) * gain;
  if (size > max) friction_impulse = sbri_scale(friction_impulse, max / size);
  sbf_vec3 change =
      sbri_add_scaled(sbri_sub(friction_impulse, touch->friction_impulse), n, gain - touch->gain);
  touch->gain = gain, touch->friction_impulse = friction_impulse;
  push(c, touch, change);
  push_external_body(c, touch, change);
  return sbri_length(change) * (FINER_WITH_EXTERNAL_BODIES + s->mass_kg * g->max_inverse_mass);
}

/* The shares by row sums: 1 / sum_k |w_k| W_k / m_k in place of 1 / sum_k w_k^2 / m_k, W_k the sum of |w| of
 * all that push the point k. */
static void share_out(const touching *c) {
  const sbri_island *island = c->tick->island;
  float *sums = c->tick->touch_weights;
  for (uint32_t i = 0; i < c->count; i++)
    for (int k = 0; k < 4; k++) sums[c->touches[i].sample.slots[k]] = 0;
  for (uint32_t i = 0; i < c->count; i++)
    for (int k = 0; c->touches[i].pushes && k < 4; k++)
      sums[c->touches[i].sample.slots[k]] += fabsf(c->touches[i].sample.weights[k]);
  for (uint32_t i = 0; i < c->count; i++) {
    const sbri_sample *s = &c->touches[i].sample;
    float sum = 0;
    for (int k = 0; k < 4; k++)
      if (s->slots[k] < island->free_count)
        sum += fabsf(s->weights[k]) * sums[s->slots[k]] * island->inverse_masses[s->slots[k]];
    c->touches[i].share = c->touches[i].pushes ? 1 / (sum * s->mass_kg) : 0;
  }
}

/* Gives each its share, and says after how many passes small changes are left. */
static int begin_passes(const touching *c) {
  bool pushed = false;
  if (!c->in_turn && c->changed) share_out(c);
  for (uint32_t i = 0; i < c->count; i++) {
    if (c->in_turn) c->touches[i].share = 1;
    pushed = pushed || c->touches[i].gain > 0;
  }
  if (c->external_bodies) return MAX_EXTERNAL_BODY_PASSES;
  return c->in_turn || !pushed ? MAX_PASSES : PASSES;
}

/* Goes on from the pushes of the substep before. */
static void push_as_before(const touching *c) {
  for (uint32_t i = 0; i < c->count; i++) {
    const sbri_touch *touch = &c->touches[i];
    if (!(touch->gain > 0)) continue;
    sbf_vec3 change = sbri_add_scaled(touch->friction_impulse, touch->normal, touch->gain);
    push(c, touch, change);
    if (touch->external_body) push_external_body(c, touch, change);
  }
}

static void lift(const touching *c, sbri_touch *touch, const sbri_contact_rule *rule) {
  if (!(touch->gain > 0 && lift_of(touch, rule) > 0)) return;
  touch->gap = gap_of(c, touch); /* of what others that share its points have left */
  float up = lift_of(touch, rule);
  if (up > 0) move(c, touch, sbri_scale(touch->normal, up), is_felt(c, touch));
}

void sbri_touches_answer(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, const sbri_contact_rule *rule) {
  touching c = touching_of(t, body, velocities);
  if (c.external_bodies) sbri_external_bodies_begin(c.external_bodies, rule->step_s);
  c.count = begin_all(&c, rule);
  const int passes = begin_passes(&c), max_passes = passes > MAX_PASSES ? passes : MAX_PASSES;
  push_as_before(&c);
  float max = STRUCK_M_S;
  for (int pass = 0; pass < max_passes && max >= (pass < passes ? SETTLED_M_S : STRUCK_M_S); pass++) {
    max = 0;
    for (uint32_t i = 0; i < c.count; i++) {
      sbri_touch *touch = &c.touches[pass % 2 ? c.count - 1 - i : i];
      float change =
          touch->external_body ? correct_with_external_body(&c, touch, rule) : correct(&c, touch, rule);
      max = change > max ? change : max;
    }
  }
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_touch *touch = &c.touches[i];
    touch->pushed = touch->gain > touch->pushed ? touch->gain : touch->pushed;
    lift(&c, touch, rule);
  }
}

sbri_sliding sbri_touches_sliding(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule) {
  touching c = touching_of(t, body, t->velocities);
  sbri_sliding sum = {0, 0, {0, 0, 0}};
  for (uint32_t i = 0; i < c.count; i++) {
    const sbri_touch *touch = &c.touches[i];
    if (!(touch->gain > 0) || touch->collider == SBRI_ITSELF) continue;
    float mass = touch->sample.mass_kg, limit = friction_of(&c, touch, rule) * touch->gain;
    sum.load += mass * touch->gain, sum.limit += mass * limit;
    if (limit > 0 && sbri_length(touch->friction_impulse) > SLIDES_SHARE * limit)
      sum.friction = sbri_add_scaled(sum.friction, touch->friction_impulse, mass);
  }
  return sum;
}

void sbri_touches_go_on(const sbri_island_tick *t, const sbri_body *body, float step_s) {
  touching c = touching_of(t, body, t->velocities);
  const bool with = c.external_bodies != NULL;
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_touch *touch = &c.touches[i];
    touch->offset += step_s * sbri_dot(touch->normal, with ? velocity_under(&c, touch) : touch->velocity);
    if (touch->gain > 0)
      touch->given =
          sbri_add(touch->given, sbri_add_scaled(touch->friction_impulse, touch->normal, touch->gain));
  }
  if (with) sbri_external_bodies_go_on(c.external_bodies, step_s);
}

static void tell_planes(const sbri_island_tick *t, const sbri_body *body, sbri_touching *to) {
  for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    if (!t->near_ground[block]) continue;
    const float *plane = t->planes + 4 * SBRI_BLOCK * (size_t)block + lane;
    sbf_vec3 n = {plane[0], plane[SBRI_BLOCK], plane[2 * SBRI_BLOCK]};
    sbf_vec3 x = {t->positions[slot].x, t->positions[slot].y, t->positions[slot].z};
    if (sbri_dot(n, x) - plane[3 * SBRI_BLOCK] <= TOUCHES_M) sbri_touching_add(to, SBRI_NO_COLLIDER, x, n, 0);
  }
}

void sbri_touches_tell(const sbri_island_tick *t, const sbri_body *body, sbri_touching *to) {
  sbri_touching_begin(to);
  for (uint32_t i = 0; i < sbri_touch_count(t, body); i++) {
    const sbri_touch *touch = &t->touches[body->first_touch + i];
    if (touch->collider == SBRI_ITSELF || !(touch->pushed > 0 || sbri_dot(touch->normal, touch->given) > 0))
      continue;
    sbf_vec3 place = sbri_sample_place(t, &touch->sample);
    sbri_touching_one *one =
        sbri_touching_add(to, touch->collider, place, touch->normal, touch->pushed * touch->sample.mass_kg);
    if (one) sbri_touching_push(one, place, sbri_scale(touch->given, touch->sample.mass_kg));
  }
  tell_planes(t, body, to);
}

void sbri_touches_remember(const sbri_island_tick *t, const sbri_body *body) {
  touching c = touching_of(t, body, t->velocities);
  for (uint32_t i = 0; i < c.count; i++) c.touches[i].gap = gap_of(&c, &c.touches[i]);
}

void sbri_touches_bound(const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule) {
  touching c = touching_of(t, body, t->velocities);
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_touch *touch = &c.touches[i];
    float min = touch->gap < -rule->slack_m ? touch->gap : -rule->slack_m, lift = min - gap_of(&c, touch);
    if (!(lift > 0)) continue;
    sbf_vec3 v = sbri_sub(velocity_of(&c, touch), velocity_under(&c, touch)), n = touch->normal;
    float gain = lift / rule->step_s;
    sbf_vec3 sideways = sbri_add_scaled(v, n, -sbri_dot(n, v));
    float size = sbri_length(sideways), max = friction_of(&c, touch, rule) * gain;
    sbf_vec3 change = sbri_add_scaled(sbri_scale(n, gain), sideways, size > max ? -max / size : -1);
    push(&c, touch, change);
    if (touch->external_body) push_external_body(&c, touch, change);
    move(&c, touch, sbri_scale(change, rule->step_s), false); /* they go by the push */
    touch->given = sbri_add(touch->given, change);
  }
}
