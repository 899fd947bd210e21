#include "solvers/touches.h"

#include <math.h>

#include "collide/guest.h"
#include "contact/self_touch.h"
#include "math/vec3.h"
#include "solvers/held_push.h"

/* While some speed changes by more than this in a sweep, another follows, in m/s. */
static const float SETTLED_M_S = 1e-3f;

/* What could not reach its plane in the substep if it were this much faster waits for the next one, in m/s:
 * most places near the ground do not touch it, and none of them is to cost sixteen sweeps. */
static const float NEAR_M_S = 1;

/* A point that is no higher over its plane touches it. */
static const float TOUCHES_M = 1e-5f;

/* Friction at this share of its limit slides. */
static const float SLIDES_SHARE = 0.999f;

/* A light guest hangs from all that touches it at once. */
enum { MOST_SWEEPS = 16, MOST_GUEST_SWEEPS = 64 };
static const float FINER_WITH_GUESTS = 10;

typedef struct touching {
  const sbri_island_tick *tick;
  const sbri_body *body;
  float *velocities;
  sbri_touch *touches;
  uint32_t count;
  sbri_guests *guests; /* NULL: there are none */
} touching;

static touching touching_of(const sbri_island_tick *t, const sbri_body *body, float *velocities) {
  uint32_t count = sbri_touch_count(t, body);
  sbri_guests *guests = count && t->guests ? &t->guests[body - t->model->bodies] : NULL;
  if (guests && !guests->count) guests = NULL;
  return (touching){t, body, velocities, t->touches + body->first_touch, count, guests};
}

static sbri_guest *guest_of(const touching *c, const sbri_touch *touch) {
  return &c->guests->at[touch->guest - 1];
}

/* Of what the touch stands for. */
static sbf_vec3 velocity_under(const touching *c, const sbri_touch *touch) {
  return touch->guest ? sbri_guest_velocity(guest_of(c, touch), touch->arm) : touch->velocity;
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
static void push_guest(const touching *c, const sbri_touch *touch, sbf_vec3 faster) {
  sbri_guest_push(guest_of(c, touch), touch->arm, sbri_scale(faster, -touch->sample.mass_kg));
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
  float most = SBRI_MOTION_SHARE * c->body->rest_size_m, way = touch->fast_m_s * c->tick->tick_s;
  if (!(gap > 0) || !(touch->fast_m_s > 0) || !(most > 0)) return 0;
  return c->tick->tick_s * (2 * gap / (way + sqrtf(way * way + 4 * most * gap)));
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
    if (r && first) sum += r->ease * weight * weight + r->turn_ease * sbri_dot(arm, arm);
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
static bool begin(const touching *c, sbri_touch *touch, const sbri_contact_rule *rule) {
  if (touch->collider == SBRI_ITSELF && !touch->crosses) sbri_self_touch_follow(c->tick, touch);
  if (is_felt(c, touch)) touch->sample.mass_kg = mass_of(c, &touch->sample);
  sbf_vec3 v = velocity_of(c, touch);
  float speed = sbri_dot(touch->normal, sbri_sub(v, c->guests ? velocity_under(c, touch) : touch->velocity));
  touch->gap = gap_of(c, touch);
  touch->wanted = wanted_of(touch, speed, rule);
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
  float size = sbri_length(sideways), most = friction_of(c, touch, rule) * touch->gain;
  touch->rub = sbri_scale(sideways, size > most ? -most / size : -1);
  sbf_vec3 change = sbri_add_scaled(touch->rub, n, touch->gain);
  velocity[0] += change.x, velocity[SBRI_BLOCK] += change.y, velocity[2 * SBRI_BLOCK] += change.z;
  float up = lift_of(touch, rule);
  if (up > 0) x->x += up * n.x, x->y += up * n.y, x->z += up * n.z;
  touch->pushed = touch->gain > touch->pushed ? touch->gain : touch->pushed;
}

/* Answers those that are alone, and brings those others that may touch to the front; how many. */
static uint32_t begin_all(const touching *c, const sbri_contact_rule *rule) {
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
  float speed = sbri_dot(n, v), gain = touch->gain + (touch->wanted - speed);
  if (!(gain > 0)) gain = 0;
  if (gain == 0 && touch->gain == 0) return 0;
  sbf_vec3 rub = sbri_sub(touch->rub, sbri_add_scaled(v, n, -speed));
  float size = sbri_length(rub), most = friction_of(c, touch, rule) * gain;
  if (size > most) rub = sbri_scale(rub, most / size);
  sbf_vec3 change = sbri_add_scaled(sbri_sub(rub, touch->rub), n, gain - touch->gain);
  touch->gain = gain, touch->rub = rub;
  push(c, touch, change);
  return sbri_length(change);
}

/* The same against a guest: what that gives way by is not the sample's to gain. */
static float correct_with_guest(const touching *c, sbri_touch *touch, const sbri_contact_rule *rule) {
  const sbri_sample *s = &touch->sample;
  const sbri_guest *g = guest_of(c, touch);
  sbf_vec3 arm = touch->arm, v = sbri_sub(velocity_of(c, touch), sbri_guest_velocity(g, arm)),
           n = touch->normal;
  float along = 1 + s->mass_kg * sbri_dot(n, sbri_guest_answer(g, arm, n));
  float across = 1 + s->mass_kg * g->lever * (g->most_ease + sbri_dot(arm, arm) * g->most_turn_ease);
  float speed = sbri_dot(n, v), gain = touch->gain + (touch->wanted - speed) / along;
  if (!(gain > 0)) gain = 0;
  if (gain == 0 && touch->gain == 0) return 0;
  sbf_vec3 rub = sbri_add_scaled(touch->rub, sbri_add_scaled(v, n, -speed), -1 / across);
  float size = sbri_length(rub), most = friction_of(c, touch, rule) * gain;
  if (size > most) rub = sbri_scale(rub, most / size);
  sbf_vec3 change = sbri_add_scaled(sbri_sub(rub, touch->rub), n, gain - touch->gain);
  touch->gain = gain, touch->rub = rub;
  push(c, touch, change);
  push_guest(c, touch, change);
  return sbri_length(change) * (FINER_WITH_GUESTS + s->mass_kg * g->most_ease);
}

void sbri_touches_answer(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, const sbri_contact_rule *rule) {
  touching c = touching_of(t, body, velocities);
  const bool with = c.guests != NULL; /* few have: loops without look no further */
  int most_sweeps = MOST_SWEEPS;
  if (with) sbri_guests_begin(c.guests, rule->step_s), most_sweeps = MOST_GUEST_SWEEPS;
  c.count = begin_all(&c, rule);
  for (uint32_t i = 0; i < c.count; i++) {
    const sbri_touch *touch = &c.touches[i];
    if (!(touch->gain > 0)) continue;
    sbf_vec3 change = sbri_add_scaled(touch->rub, touch->normal, touch->gain);
    push(&c, touch, change);
    if (with && touch->guest) push_guest(&c, touch, change);
  }
  float most = SETTLED_M_S;
  for (int sweep = 0; sweep < most_sweeps && most >= SETTLED_M_S; sweep++) {
    most = 0;
    for (uint32_t i = 0; i < c.count; i++) {
      sbri_touch *touch = &c.touches[sweep % 2 ? c.count - 1 - i : i];
      float change = with && touch->guest ? correct_with_guest(&c, touch, rule) : correct(&c, touch, rule);
      most = change > most ? change : most;
    }
  }
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_touch *touch = &c.touches[i];
    touch->pushed = touch->gain > touch->pushed ? touch->gain : touch->pushed;
    if (!(touch->gain > 0 && lift_of(touch, rule) > 0)) continue;
    touch->gap = gap_of(&c, touch); /* of what others that share its points have left */
    float up = lift_of(touch, rule);
    if (up > 0) move(&c, touch, sbri_scale(touch->normal, up), is_felt(&c, touch));
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
    if (limit > 0 && sbri_length(touch->rub) > SLIDES_SHARE * limit)
      sum.friction = sbri_add_scaled(sum.friction, touch->rub, mass);
  }
  return sum;
}

void sbri_touches_go_on(const sbri_island_tick *t, const sbri_body *body, float step_s) {
  touching c = touching_of(t, body, t->velocities);
  const bool with = c.guests != NULL;
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_touch *touch = &c.touches[i];
    touch->offset += step_s * sbri_dot(touch->normal, with ? velocity_under(&c, touch) : touch->velocity);
    if (touch->gain > 0)
      touch->given = sbri_add(touch->given, sbri_add_scaled(touch->rub, touch->normal, touch->gain));
  }
  if (with) sbri_guests_go_on(c.guests, step_s);
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
    float least = touch->gap < -rule->slack_m ? touch->gap : -rule->slack_m, lift = least - gap_of(&c, touch);
    if (!(lift > 0)) continue;
    sbf_vec3 v = sbri_sub(velocity_of(&c, touch), velocity_under(&c, touch)), n = touch->normal;
    float gain = lift / rule->step_s;
    sbf_vec3 sideways = sbri_add_scaled(v, n, -sbri_dot(n, v));
    float size = sbri_length(sideways), most = friction_of(&c, touch, rule) * gain;
    sbf_vec3 change = sbri_add_scaled(sbri_scale(n, gain), sideways, size > most ? -most / size : -1);
    push(&c, touch, change);
    if (touch->guest) push_guest(&c, touch, change);
    move(&c, touch, sbri_scale(change, rule->step_s), false); /* they go by the push */
    touch->given = sbri_add(touch->given, change);
  }
}
