#include "soft/solvers/soft_contacts.h"

#include <math.h>

#include "contact/contact_block.h"
#include "contact/self_contacts.h"
#include "math/vec3.h"
#include "shapes/external_body.h"
#include "soft/solvers/pinned_impulse.h"

/* Iteration continues while a velocity changes by more than this, m/s. */
static const float CONVERGED_M_S = 1e-3f;

/* A contact is skipped in the substep if it would not reach its plane even if it were this much faster, m/s.
 * Most contacts near the ground are separated, and they must not cost iterations. */
static const float NEAR_M_S = 1;

/* Maximum separation of a point in contact. */
static const float CONTACT_DISTANCE_M = 1e-5f;

/* Fraction of the friction limit from which on a contact slides. */
static const float SLIDES_FRACTION = 0.999f;

/* Per substep. A light external body couples all its contacts, so it needs more iterations. */
enum { MAX_ITERATIONS = 16, MAX_EXTERNAL_BODY_ITERATIONS = 64 };
static const float EXTERNAL_BODY_PRECISION = 10;

typedef struct contact_set {
  const sbri_island_tick *tick;
  const sbri_body *body;
  float *velocities;
  sbri_soft_contact *contacts;
  uint32_t count;
  sbri_external_bodies *external_bodies; /* NULL: none */
} contact_set;

static contact_set contact_set_of(const sbri_island_tick *t, const sbri_body *body, float *velocities) {
  uint32_t count = sbri_soft_contact_count(t, body);
  sbri_external_bodies *external_bodies =
      count && t->contacts.external_bodies ? &t->contacts.external_bodies[body - t->model->bodies] : NULL;
  if (external_bodies && !external_bodies->count) external_bodies = NULL;
  return (contact_set){.tick = t,
      .body = body,
      .velocities = velocities,
      .contacts = t->contacts.at + body->contact.first,
      .count = count,
      .external_bodies = external_bodies};
}

static sbri_external_body *external_body_of(const contact_set *c, const sbri_soft_contact *contact) {
  return &c->external_bodies->at[contact->external_body - 1];
}

/* Velocity of the other side of the contact. */
static sbf_vec3 other_side_velocity(const contact_set *c, const sbri_soft_contact *contact) {
  return contact->external_body ? sbri_external_body_velocity(external_body_of(c, contact), contact->arm)
                                : contact->velocity;
}

/* Whether the simulated rigid bodies that the contact's points are pinned to get its impulse. Only
 * self-contacts have this reaction. */
static bool has_reaction(const contact_set *c, const sbri_soft_contact *contact) {
  return c->tick->reactions && contact->collider == SBRI_ITSELF;
}

static sbf_vec3 velocity_of(const contact_set *c, const sbri_soft_contact *contact) {
  const sbri_sample *s = &contact->sample;
  const bool reacts = has_reaction(c, contact);
  sbf_vec3 v = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    if (s->weights[k] == 0) continue;
    v = sbri_add_scaled(v, sbri_slot_velocity(c->tick, c->velocities, s->slots[k]), s->weights[k]);
    if (reacts) v = sbri_add_scaled(v, sbri_pinned_velocity_change(c->tick, s->slots[k]), s->weights[k]);
  }
  return v;
}

static float gap_of(const contact_set *c, const sbri_soft_contact *contact) {
  return sbri_dot(contact->normal, sbri_sample_position(c->tick, &contact->sample)) - contact->offset;
}

/* Velocity change of point k per velocity change of the sample. */
static float point_response(const contact_set *c, const sbri_sample *s, int k) {
  const sbri_island *island = c->tick->island;
  if (s->slots[k] >= island->free_count) return 0;
  return s->weights[k] * island->inverse_masses[s->slots[k]] * s->mass_kg;
}

/* Changes the velocity of the sample by `velocity_change`. */
static void apply_velocity_change(
    const contact_set *c, const sbri_soft_contact *contact, sbf_vec3 velocity_change) {
  const sbri_sample *s = &contact->sample;
  const bool reacts = has_reaction(c, contact);
  for (int k = 0; k < 4; k++) {
    float fraction = point_response(c, s, k);
    if (reacts)
      sbri_pinned_apply_impulse(
          c->tick, s->slots[k], sbri_scale(velocity_change, s->weights[k] * s->mass_kg));
    if (fraction == 0) continue;
    float *v = c->velocities + 3 * (s->slots[k] / SBRI_BLOCK * SBRI_BLOCK) + s->slots[k] % SBRI_BLOCK;
    v[0] += fraction * velocity_change.x, v[SBRI_BLOCK] += fraction * velocity_change.y,
        v[2 * SBRI_BLOCK] += fraction * velocity_change.z;
  }
}

/* Moves the sample by `correction`. If it `reacts`, also shifts the rigid bodies that it is pinned to.
 */
static void correct_position(
    const contact_set *c, const sbri_soft_contact *contact, sbf_vec3 correction, bool reacts) {
  const sbri_sample *s = &contact->sample;
  for (int k = 0; k < 4; k++) {
    float fraction = point_response(c, s, k);
    if (reacts)
      sbri_pinned_apply_shift(c->tick, s->slots[k], sbri_scale(correction, s->weights[k] * s->mass_kg));
    if (fraction == 0) continue;
    sbri_point *x = &c->tick->positions[s->slots[k]];
    x->x += fraction * correction.x, x->y += fraction * correction.y, x->z += fraction * correction.z;
  }
}

/* Applies the opposite impulse to the external body. */
static void apply_external_reaction(
    const contact_set *c, const sbri_soft_contact *contact, sbf_vec3 velocity_change) {
  sbri_external_body_apply_impulse(
      external_body_of(c, contact), contact->arm, sbri_scale(velocity_change, -contact->sample.mass_kg));
}

/* Maximum friction of the contact in the substep, as a velocity change. */
static float max_friction_of(const contact_set *c, const sbri_soft_contact *contact,
    float normal_velocity_change, const sbri_contact_rule *rule) {
  if (!(normal_velocity_change > 0)) return 0;
  sbri_pressing pressing =
      sbri_pressing_add(contact->pressing, normal_velocity_change, contact->closing_speed, rule->step_s);
  return sbri_contact_friction_at(c->tick, c->body, contact) *
         sbri_pressing_bound(pressing, normal_velocity_change, rule->step_s);
}

/* Target normal velocity: arrive at the plane; stop if it penetrates already; bounce if it is fast. */
static float target_speed(const sbri_soft_contact *contact, float speed, const sbri_contact_rule *rule) {
  float arrival_speed = contact->gap > 0 ? -contact->gap / rule->step_s : 0,
        bounce_speed = -contact->restitution * speed;
  bool bounces = contact->gap + rule->step_s * speed < 0 && speed < -rule->bounce_from_m_s;
  return bounces && bounce_speed > arrival_speed ? bounce_speed : arrival_speed;
}

/* Inverse effective mass of the rigid bodies that the sample is pinned to: the maximum over all directions.
 */
static float pinned_inverse_mass(const contact_set *c, const sbri_sample *s) {
  float sum = 0;
  for (int k = 0; k < 4; k++) {
    const sbri_reaction *r = sbri_reaction_at(c->tick, s->slots[k]);
    sbf_vec3 arm = {0, 0, 0};
    float weight = 0;
    bool first = true; /* of the points pinned to this rigid body, which moves as one */
    for (int i = 0; r && i < 4; i++) {
      if (sbri_reaction_at(c->tick, s->slots[i]) != r) continue;
      first = first && i >= k;
      weight += s->weights[i];
      arm = sbri_add_scaled(arm, sbri_reaction_arm(c->tick, r, s->slots[i]), s->weights[i]);
    }
    if (r && first) sum += r->inverse_mass * weight * weight + r->inverse_inertia * sbri_dot(arm, arm);
  }
  return sum;
}

/* Effective mass of a self-contact if the rigid bodies that it is pinned to move. */
static float effective_mass(const contact_set *c, const sbri_sample *s) {
  float sum = pinned_inverse_mass(c, s);
  for (int k = 0; k < 4; k++)
    if (s->slots[k] < c->tick->island->free_count)
      sum += s->weights[k] * s->weights[k] * c->tick->island->inverse_masses[s->slots[k]];
  return 1 / sum;
}

/* Only the first impulse of the tick counts: later ones come from the body's own vibration. */
static void store_closing_speed(sbri_soft_contact *contact, float normal_speed) {
  if (!(contact->max_velocity_change > 0) && -normal_speed > contact->closing_speed)
    contact->closing_speed = -normal_speed;
}

/* Prepares a contact for the substep. Returns whether it may touch. */
static bool prepare_contact(contact_set *c, sbri_soft_contact *contact, const sbri_contact_rule *rule) {
  if (contact->collider == SBRI_ITSELF && !contact->is_crossed) sbri_self_contact_update(c->tick, contact);
  if (has_reaction(c, contact)) contact->sample.mass_kg = effective_mass(c, &contact->sample);
  sbf_vec3 v = velocity_of(c, contact);
  float speed = sbri_dot(
      contact->normal, sbri_sub(v, c->external_bodies ? other_side_velocity(c, contact) : contact->velocity));
  contact->gap = gap_of(c, contact);
  if (contact->gap + rule->step_s * speed < 0) store_closing_speed(contact, speed);
  contact->target_speed = target_speed(contact, speed, rule);
  return contact->velocity_change > 0 || contact->gap < rule->step_s * (NEAR_M_S - speed);
}

/* Penetration correction of the substep. */
static float penetration_correction(const sbri_soft_contact *contact, const sbri_contact_rule *rule) {
  float correction = -contact->gap - rule->slack_m;
  return correction < rule->max_correction_m ? correction : rule->max_correction_m;
}

/* Solves a contact that shares its point with no other contact. The result equals that of the general
 * iteration. */
static void solve_single(const contact_set *c, sbri_soft_contact *contact, const sbri_contact_rule *rule) {
  uint32_t slot = contact->sample.slots[0];
  float *velocity = c->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
  sbri_point *x = &c->tick->positions[slot];
  sbf_vec3 n = contact->normal, v = {velocity[0], velocity[SBRI_BLOCK], velocity[2 * SBRI_BLOCK]};
  v = sbri_sub(v, contact->velocity);
  float speed = sbri_dot(n, v);
  contact->gap = sbri_dot(n, sbri_vec3(x->x, x->y, x->z)) - contact->offset;
  contact->velocity_change = target_speed(contact, speed, rule) - speed;
  if (!(contact->velocity_change > 0)) {
    contact->velocity_change = 0;
    return;
  }
  store_closing_speed(contact, speed);
  sbf_vec3 tangential = sbri_add_scaled(v, n, -speed);
  float size = sbri_length(tangential), max = max_friction_of(c, contact, contact->velocity_change, rule);
  contact->friction_impulse = sbri_scale(tangential, size > max ? -max / size : -1);
  sbf_vec3 change = sbri_add_scaled(contact->friction_impulse, n, contact->velocity_change);
  velocity[0] += change.x, velocity[SBRI_BLOCK] += change.y, velocity[2 * SBRI_BLOCK] += change.z;
  float correction = penetration_correction(contact, rule);
  if (correction > 0) x->x += correction * n.x, x->y += correction * n.y, x->z += correction * n.z;
  contact->max_velocity_change = contact->velocity_change > contact->max_velocity_change
                                     ? contact->velocity_change
                                     : contact->max_velocity_change;
}

/* Solves the single contacts, and moves the others that may touch to the front. Returns the number of those.
 */
static uint32_t prepare_contacts(contact_set *c, const sbri_contact_rule *rule) {
  uint32_t near_count = 0;
  for (uint32_t i = 0; i < c->count; i++) {
    sbri_soft_contact *contact = &c->contacts[i];
    if (contact->is_single) solve_single(c, contact, rule);
    if (contact->is_single || !prepare_contact(c, contact, rule)) continue;
    sbri_soft_contact first = c->contacts[near_count];
    c->contacts[near_count++] = c->contacts[i];
    c->contacts[i] = first;
  }
  return near_count;
}

/* One iteration of a contact; returns the velocity change. */
static float solve_contact(const contact_set *c, sbri_soft_contact *contact, const sbri_contact_rule *rule) {
  sbf_vec3 v = sbri_sub(velocity_of(c, contact), contact->velocity), n = contact->normal;
  float speed = sbri_dot(n, v),
        normal_velocity_change = contact->velocity_change + contact->target_speed - speed;
  if (!(normal_velocity_change > 0)) normal_velocity_change = 0;
  if (normal_velocity_change == 0 && contact->velocity_change == 0) return 0;
  sbf_vec3 friction_impulse = sbri_sub(contact->friction_impulse, sbri_add_scaled(v, n, -speed));
  float size = sbri_length(friction_impulse), max = max_friction_of(c, contact, normal_velocity_change, rule);
  if (size > max) friction_impulse = sbri_scale(friction_impulse, max / size);
  sbf_vec3 change = sbri_add_scaled(sbri_sub(friction_impulse, contact->friction_impulse), n,
      normal_velocity_change - contact->velocity_change);
  contact->velocity_change = normal_velocity_change, contact->friction_impulse = friction_impulse;
  apply_velocity_change(c, contact, change);
  return sbri_length(change);
}

/* One iteration of a contact with an external body, whose inverse mass counts in the effective mass. */
static float solve_external_contact(
    const contact_set *c, sbri_soft_contact *contact, const sbri_contact_rule *rule) {
  const sbri_sample *s = &contact->sample;
  const sbri_external_body *g = external_body_of(c, contact);
  sbf_vec3 arm = contact->arm, v = sbri_sub(velocity_of(c, contact), sbri_external_body_velocity(g, arm)),
           n = contact->normal;
  float normal_response = 1 + s->mass_kg * sbri_dot(n, sbri_external_body_response(g, arm, n));
  float tangential_response =
      1 + s->mass_kg * g->lever * (g->max_inverse_mass + sbri_dot(arm, arm) * g->max_inverse_inertia);
  float speed = sbri_dot(n, v),
        normal_velocity_change = contact->velocity_change + (contact->target_speed - speed) / normal_response;
  if (!(normal_velocity_change > 0)) normal_velocity_change = 0;
  if (normal_velocity_change == 0 && contact->velocity_change == 0) return 0;
  sbf_vec3 friction_impulse =
      sbri_add_scaled(contact->friction_impulse, sbri_add_scaled(v, n, -speed), -1 / tangential_response);
  float size = sbri_length(friction_impulse), max = max_friction_of(c, contact, normal_velocity_change, rule);
  if (size > max) friction_impulse = sbri_scale(friction_impulse, max / size);
  sbf_vec3 change = sbri_add_scaled(sbri_sub(friction_impulse, contact->friction_impulse), n,
      normal_velocity_change - contact->velocity_change);
  contact->velocity_change = normal_velocity_change, contact->friction_impulse = friction_impulse;
  apply_velocity_change(c, contact, change);
  apply_external_reaction(c, contact, change);
  return sbri_length(change) * (EXTERNAL_BODY_PRECISION + s->mass_kg * g->max_inverse_mass);
}

/* Applies the impulses of the previous substep. */
static void apply_warm_start(const contact_set *c) {
  for (uint32_t i = 0; i < c->count; i++) {
    const sbri_soft_contact *contact = &c->contacts[i];
    if (!(contact->velocity_change > 0)) continue;
    sbf_vec3 change = sbri_add_scaled(contact->friction_impulse, contact->normal, contact->velocity_change);
    apply_velocity_change(c, contact, change);
    if (contact->external_body) apply_external_reaction(c, contact, change);
  }
}

static void correct_penetration(
    const contact_set *c, sbri_soft_contact *contact, const sbri_contact_rule *rule) {
  if (!(contact->velocity_change > 0 && penetration_correction(contact, rule) > 0)) return;
  contact->gap = gap_of(c, contact); /* what remains after contacts that share its points */
  float correction = penetration_correction(contact, rule);
  if (correction > 0)
    correct_position(c, contact, sbri_scale(contact->normal, correction), has_reaction(c, contact));
}

void sbri_soft_contacts_solve(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, const sbri_contact_rule *rule) {
  contact_set c = contact_set_of(t, body, velocities);
  if (c.external_bodies) sbri_external_bodies_begin(c.external_bodies, rule->step_s);
  c.count = prepare_contacts(&c, rule);
  const int iterations = c.external_bodies ? MAX_EXTERNAL_BODY_ITERATIONS : MAX_ITERATIONS;
  apply_warm_start(&c);
  float max = CONVERGED_M_S;
  for (int iteration = 0; iteration < iterations && max >= CONVERGED_M_S; iteration++) {
    max = 0;
    for (uint32_t i = 0; i < c.count; i++) {
      sbri_soft_contact *contact = &c.contacts[iteration % 2 ? c.count - 1 - i : i];
      float change = contact->external_body ? solve_external_contact(&c, contact, rule)
                                            : solve_contact(&c, contact, rule);
      max = change > max ? change : max;
    }
  }
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_soft_contact *contact = &c.contacts[i];
    contact->max_velocity_change = contact->velocity_change > contact->max_velocity_change
                                       ? contact->velocity_change
                                       : contact->max_velocity_change;
    correct_penetration(&c, contact, rule);
  }
}

static void add_sliding(sbri_sliding *sum, float mass, float load, float limit, sbf_vec3 friction) {
  sum->load += mass * load, sum->limit += mass * limit;
  if (limit > 0 && sbri_length(friction) > SLIDES_FRACTION * limit)
    sum->friction = sbri_add_scaled(sum->friction, friction, mass);
}

static sbri_sliding sum_sliding_of_blocks(const sbri_island_tick *t, const sbri_body *body) {
  sbri_sliding sum = {0, 0, {0, 0, 0}};
  const sbri_contact_block *blocks = sbri_contact_blocks_of(t, body);
  for (uint32_t b = 0; b < sbri_contact_block_count(t, body); b++)
    for (uint32_t i = 0; blocks[b].is_near && blocks[b].has_impulses && i < SBRI_BLOCK; i++) {
      float load = blocks[b].velocity_change[i],
            bound = blocks[b].friction_bound.constant[i] + blocks[b].friction_bound.slope[i] * load;
      if (load > 0)
        add_sliding(&sum, blocks[b].sample.mass_kg[i], load, blocks[b].friction[i] * (bound > 0 ? bound : 0),
            sbri_vec3(blocks[b].friction_impulse[0][i], blocks[b].friction_impulse[1][i],
                blocks[b].friction_impulse[2][i]));
    }
  return sum;
}

sbri_sliding sbri_soft_contacts_sum_sliding(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule) {
  contact_set c = contact_set_of(t, body, t->velocities);
  sbri_sliding sum = {0, 0, {0, 0, 0}};
  if (sbri_contact_block_count(t, body)) return sum_sliding_of_blocks(t, body);
  for (uint32_t i = 0; i < c.count; i++) {
    const sbri_soft_contact *contact = &c.contacts[i];
    if (!(contact->velocity_change > 0) || contact->collider == SBRI_ITSELF) continue;
    float limit = max_friction_of(&c, contact, contact->velocity_change, rule);
    add_sliding(&sum, contact->sample.mass_kg, contact->velocity_change, limit, contact->friction_impulse);
  }
  return sum;
}

void sbri_soft_contacts_advance(const sbri_island_tick *t, const sbri_body *body, float step_s) {
  contact_set c = contact_set_of(t, body, t->velocities);
  const bool has_external_bodies = c.external_bodies != NULL;
  if (sbri_contact_block_count(t, body)) {
    sbri_contact_blocks_advance(t, body, step_s);
    return;
  }
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_soft_contact *contact = &c.contacts[i];
    contact->offset +=
        step_s *
        sbri_dot(contact->normal, has_external_bodies ? other_side_velocity(&c, contact) : contact->velocity);
    contact->pressing =
        sbri_pressing_add(contact->pressing, contact->velocity_change, contact->closing_speed, step_s);
    if (contact->velocity_change > 0)
      contact->total_velocity_change = sbri_add(contact->total_velocity_change,
          sbri_add_scaled(contact->friction_impulse, contact->normal, contact->velocity_change));
  }
  if (has_external_bodies) sbri_external_bodies_end_step(c.external_bodies, step_s);
}

static void report_planes(const sbri_island_tick *t, const sbri_body *body, sbri_contact_reports *to) {
  if (to->ground_speed > 0) {
    sbri_contact_reports_add(
        to, SBRI_NO_COLLIDER, to->ground_position, to->ground_normal, 0, to->ground_speed);
    to->ground_speed = 0;
  }
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    if (!t->contacts.near_ground[block]) continue;
    const float *plane = t->contacts.planes + 4 * SBRI_BLOCK * (size_t)block + lane;
    sbf_vec3 n = {plane[0], plane[SBRI_BLOCK], plane[2 * SBRI_BLOCK]};
    sbf_vec3 x = {t->positions[slot].x, t->positions[slot].y, t->positions[slot].z};
    if (sbri_dot(n, x) - plane[3 * SBRI_BLOCK] <= CONTACT_DISTANCE_M)
      sbri_contact_reports_add(to, SBRI_NO_COLLIDER, x, n, 0, 0);
  }
}

void sbri_soft_contacts_report(const sbri_island_tick *t, const sbri_body *body, sbri_contact_reports *to) {
  sbri_contact_reports_begin(to);
  sbri_contact_blocks_unpack(t, body);
  for (uint32_t i = 0; i < sbri_soft_contact_count(t, body); i++) {
    const sbri_soft_contact *contact = &t->contacts.at[body->contact.first + i];
    if (contact->collider == SBRI_ITSELF ||
        !(contact->max_velocity_change > 0 || sbri_dot(contact->normal, contact->total_velocity_change) > 0))
      continue;
    sbf_vec3 position = sbri_sample_position(t, &contact->sample);
    sbri_contact_report *one = sbri_contact_reports_add(to, contact->collider, position, contact->normal,
        contact->max_velocity_change * contact->sample.mass_kg, contact->closing_speed);
    if (one)
      sbri_contact_report_add_impulse(
          one, position, sbri_scale(contact->total_velocity_change, contact->sample.mass_kg));
  }
  report_planes(t, body, to);
}

void sbri_soft_contacts_store(const sbri_island_tick *t, const sbri_body *body) {
  contact_set c = contact_set_of(t, body, t->velocities);
  sbri_contact_blocks_unpack(t, body);
  for (uint32_t i = 0; i < c.count; i++) c.contacts[i].gap = gap_of(&c, &c.contacts[i]);
}

void sbri_soft_contacts_bound(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule) {
  contact_set c = contact_set_of(t, body, t->velocities);
  for (uint32_t i = 0; i < c.count; i++) {
    sbri_soft_contact *contact = &c.contacts[i];
    float min = contact->gap < -rule->slack_m ? contact->gap : -rule->slack_m,
          depth = min - gap_of(&c, contact);
    if (!(depth > 0)) continue;
    sbf_vec3 v = sbri_sub(velocity_of(&c, contact), other_side_velocity(&c, contact)), n = contact->normal;
    float normal_velocity_change = depth / rule->step_s;
    sbf_vec3 tangential = sbri_add_scaled(v, n, -sbri_dot(n, v));
    float size = sbri_length(tangential),
          max = sbri_contact_friction_at(t, body, contact) * normal_velocity_change;
    sbf_vec3 change =
        sbri_add_scaled(sbri_scale(n, normal_velocity_change), tangential, size > max ? -max / size : -1);
    apply_velocity_change(&c, contact, change);
    if (contact->external_body) apply_external_reaction(&c, contact, change);
    correct_position(
        &c, contact, sbri_scale(change, rule->step_s), false); /* rigid bodies already get the impulse */
    contact->total_velocity_change = sbri_add(contact->total_velocity_change, change);
  }
}
