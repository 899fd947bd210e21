/* Soft bodies and the simulated rigid bodies that they are pinned to, stepped together.
 *
 * A tick of the rigid bodies has several steps. Before each of them the soft bodies are advanced over the
 * same time while their pins continue at their old velocity. The pins' impulses are then applied to the rigid
 * bodies, the rigid step follows, and the pins are moved to the new poses. If a soft body takes one substep
 * in it, this is a leapfrog of the whole system with all forces taken at the step's beginning: it conserves
 * momentum to rounding and loses no energy. If it takes several, the rigid bodies get the mean force (the
 * impulse method: Grubmueller, Heller, Windemuth, Schulten 1991). The length of the rigid steps follows from
 * the frequency of each rigid body on its soft bodies alone (prepare/coupling.c), so a heavy belly on light
 * bones is as stable as a light one on heavy bones.
 *
 * Soft bodies on one bone only are coupled implicitly, in fewer steps (attached_bodies.c).
 *
 * Damping relative to the pins is applied here, once a step, so that the rigid bodies receive its reaction.
 */
#include <string.h>

#include "coupling/ragdoll/ragdoll.h"
#include "math/lane_sums.h"
#include "math/quat.h"
#include "math/trig.h"
#include "soft/soft.h"
#include "soft/solvers/external_forces.h"
#include "soft/solvers/router.h"
#include "soft/solvers/spring_forces.h"
#include "soft/tear/tear.h"

/* -log(SBRI_DAMPING_KEPT) */
static const float DAMPING_OF_TICK = 0.35667494f;

/* ---- Before the tick ---- */

static bool may_collide(const sbri_island_tick *t) {
  bool any = false;
  for (uint32_t b = 0; b < t->island->body_count; b++)
    any = any || t->contacts.counts[t->island->bodies[b]] > 0;
  for (uint32_t block = 0; block < t->island->free_count / SBRI_BLOCK; block++)
    any = any || t->contacts.near_ground[block];
  return any;
}

void sbri_coupled_begin(sbri_coupled *group) {
  sbri_character *c = group->character;
  group->any = group->is_touching = false;
  group->steps = 1;
  memset(sbri_attached_loads(c), 0, c->model->rigid.body_count * sizeof(sbri_attached_load));
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    if (!sbri_island_is_coupled(c, i)) continue;
    group->any = true;
    if (sbri_island_states(c)[i].asleep) sbri_island_wake(c, i);
    sbri_island now = sbri_island_now(c, &c->model->islands[i]);
    sbri_drivers_stop(c, &now);
    sbri_island_fill_unused_slots(c, &now);
    sbri_island_tick tick = sbri_island_tick_of(group->world, c, i, &now);
    tick.surfaces.external_rad_s = &now.stability.external_rad_s;
    sbri_update_gas_stiffness(&tick);
    sbri_island_prepare_contacts(&tick, c);
    (void)sbri_router_choose(&tick, &sbri_island_states(c)[i].recovery); /* for the whole tick */
    group->is_touching = group->is_touching || may_collide(&tick);
    sbri_coupled_request_steps(group, &tick);
  }
  if (group->any) sbri_coupled_request_steps_of_bones(group);
}

/* ---- In the tick ---- */

static void apply_reaction(const sbri_character *c, int32_t attachment, sbf_vec3 at, sbf_vec3 impulse) {
  if (attachment < 0) return;
  sbri_reaction *r = &sbri_reactions(c)[attachment];
  r->impulse = sbri_add(r->impulse, impulse);
  r->moment = sbri_add(r->moment, sbri_cross(sbri_sub(at, r->about), impulse));
}

/* Applies the reaction of a point's damping to the rigid bodies of its drivers. */
static void apply_driver_reaction(
    const sbri_character *c, const sbri_body *body, uint32_t index, sbf_vec3 at, sbf_vec3 impulse) {
  const int32_t *attachments = c->model->rigid_body_of_frame;
  if (!body->drivers) {
    apply_reaction(c, attachments[body->driver_frame], at, impulse);
    return;
  }
  const sbri_driver *driver = &body->drivers[index];
  for (int k = 0; k < SBRI_DRIVERS; k++)
    if (driver->weights[k] > 0)
      apply_reaction(c, attachments[driver->frames[k]], at, sbri_scale(impulse, driver->weights[k]));
}

/* Reduces a decay where the rigid body is lighter than the soft body, so that relative velocity reaches zero
 * and does not change sign, as in an implicit step. */
static float inverse_mass_along(const sbri_character *c, uint32_t frame, float removed) {
  int32_t attachment = c->model->rigid_body_of_frame[frame];
  if (attachment < 0 || !sbri_rigid_is_simulated(c, (uint32_t)attachment)) return 1;
  return 1 / (1 + removed * c->model->rigid.pinned_weights[attachment]);
}

static float inverse_mass_of_drivers(
    const sbri_character *c, const sbri_body *body, uint32_t index, float removed) {
  if (!body->drivers) return inverse_mass_along(c, body->driver_frame, removed);
  const sbri_driver *driver = &body->drivers[index];
  float min = 1;
  for (int k = 0; k < SBRI_DRIVERS; k++) {
    float inverse_mass = driver->weights[k] > 0 ? inverse_mass_along(c, driver->frames[k], removed) : 1;
    min = inverse_mass < min ? inverse_mass : min;
  }
  return min;
}

/* Bodies with one pin frame and one decay for all points: eight lanes at a time, in a fixed order of
 * summation. */
static void damp_uniform(
    sbri_character *c, const sbri_island *island, const sbri_body *body, float fraction) {
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *along = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  int32_t attachment = c->model->rigid_body_of_frame[body->driver_frame];
  sbf_vec3 about = attachment >= 0 ? sbri_reactions(c)[attachment].about : sbri_vec3(0, 0, 0);
  sbri_lane_sums removed_sums = {{{0}}, {{0}}};
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    float *at = sbri_triple(velocities, slot);
    sbri_wide3 v = sbri_load3(at), u = sbri_load3(sbri_const_triple(along, slot));
    sbri_wide m = sbri_wide_load(island->masses + slot);
    sbri_wide part = sbri_wide_select(m > sbri_wide_all(0), sbri_wide_all(fraction), sbri_wide_all(0));
    sbri_wide3 change = {(u.x - v.x) * part, (u.y - v.y) * part, (u.z - v.z) * part};
    sbri_store3(at, (sbri_wide3){v.x + change.x, v.y + change.y, v.z + change.z});
    sbri_wide3 x = sbri_wide_load_points(positions + slot);
    x.x = x.x - sbri_wide_all(about.x), x.y = x.y - sbri_wide_all(about.y),
    x.z = x.z - sbri_wide_all(about.z);
    sbri_lane_sums_add(
        &removed_sums, slot % SBRI_BLOCK, x, (sbri_wide3){m * change.x, m * change.y, m * change.z});
  }
  if (attachment < 0) return;
  sbri_reaction *r = &sbri_reactions(c)[attachment];
  r->impulse = sbri_sub(r->impulse, sbri_lanes_force(&removed_sums));
  r->moment = sbri_sub(r->moment, sbri_lanes_moment(&removed_sums));
}

/* Damps the points relative to their drivers over h, with an additional rate `extra_damping`, 1/s. */
static void damp(
    sbri_character *c, const sbri_island *island, const sbri_body *body, float extra_damping, float h) {
  if (!body->is_pinned || !(body->damping.alpha_1_s + extra_damping > 0)) return;
  float removed = 1 - sbri_exp(-(body->damping.alpha_1_s + extra_damping) * h); /* upper bound */
  float fraction = body->drivers ? 0 : removed * inverse_mass_along(c, body->driver_frame, removed);
  if (!body->drivers && !body->damping.alphas) {
    damp_uniform(c, island, body, fraction);
    return;
  }
  size_t first = island->first_slot;
  const sbri_point *positions = sbri_positions(c) + first;
  float *velocities = sbri_velocities(c) + 3 * first;
  const float *along = sbri_driver_velocities(c) + 3 * first;
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    size_t at = 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    float *v = velocities + at, m = island->masses[slot];
    const float *u = along + at;
    if (!(m > 0)) continue;
    if (body->damping.alphas) removed = 1 - sbri_exp(-(body->damping.alphas[slot] + extra_damping) * h);
    if (body->damping.alphas || body->drivers)
      fraction = removed * inverse_mass_of_drivers(c, body, slot - body->slots.begin, removed);
    sbf_vec3 change = {(u[0] - v[0]) * fraction, (u[SBRI_BLOCK] - v[SBRI_BLOCK]) * fraction,
        (u[2 * SBRI_BLOCK] - v[2 * SBRI_BLOCK]) * fraction};
    v[0] += change.x, v[SBRI_BLOCK] += change.y, v[2 * SBRI_BLOCK] += change.z;
    const sbri_point *x = &positions[slot];
    apply_driver_reaction(
        c, body, slot - body->slots.begin, sbri_vec3(x->x, x->y, x->z), sbri_scale(change, -m));
  }
}

/* In flight gravity acts on soft and rigid bodies over the same time, so they fall together, whatever their
 * step sizes, and the soft body keeps its shape. */
static void change_velocity(sbri_character *c, const sbri_island *island, sbf_vec3 velocity_change) {
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    float scale = island->gravity_scales[slot];
    v[0] += scale * velocity_change.x, v[SBRI_BLOCK] += scale * velocity_change.y,
        v[2 * SBRI_BLOCK] += scale * velocity_change.z;
  }
}

static void step_island(
    sbri_coupled *group, uint32_t index, float step_s, float fraction, sbf_vec3 velocity_change) {
  sbri_character *c = group->character;
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  size_t first = now.first_slot;
  if (now.stepping.substeps) now.stepping.substeps = (uint32_t)ceilf(fraction * (float)now.stepping.substeps);
  sbri_compute_pin_targets(&now, sbri_previous_deltas(c), sbri_positions(c) + first);
  sbri_compute_pin_targets(&now, sbri_deltas(c), sbri_targets(c) + first);
  (void)sbri_driver_velocities_find(c, &now, step_s);
  if (group->falls) change_velocity(c, &now, velocity_change);
  bool is_damped = sbri_island_states(c)[index].damping_ticks > 0; /* soft/recovery.c */
  float extra_damping = is_damped ? DAMPING_OF_TICK * fraction / step_s : 0;
  for (uint32_t b = 0; b < now.body_count; b++)
    damp(c, &now, &c->model->bodies[now.bodies[b]], extra_damping, step_s);
  sbri_island_tick tick = sbri_island_tick_of(group->world, c, index, &now);
  tick.tick_s = step_s, tick.fraction = fraction;
  tick.surfaces.external_rad_s = &now.stability.external_rad_s;
  sbri_update_gas_stiffness(&tick);
  if (group->falls) tick.environment.gravity = sbri_vec3(0, 0, 0);
  tick.undamped = true;
  tick.reactions = sbri_reactions(c);
  sbri_router_scheme(&now, &sbri_island_states(c)[index].recovery)->tick(&tick);
  sbri_coupled_request_steps_now(group, &tick);
}

static sbri_reaction no_reaction(
    const sbri_character *c, const sbri_rigid_tick *t, uint32_t b, float step_s) {
  const sbri_rigid_body *is = &t->model->bodies[b];
  const sbf_vec3 *turns = &is->inverse_inertia;
  float max = turns->x > turns->y ? turns->x : turns->y;
  float fraction = sbri_rigid_is_simulated(c, b) ? 1 / sbri_rigid_mass_factor(&t->external, b, step_s) : 0;
  return (sbri_reaction){.about = t->bodies[b].pose.position,
      .inverse_mass = fraction * is->inverse_mass,
      .inverse_inertia = fraction * (max > turns->z ? max : turns->z)};
}

/* Immediate shifts of pinned points also move their rigid bodies by their part. This adds the velocity that
 * makes up for it in the next step, so that joints take part. */
static void shift(sbri_character *c, const sbri_rigid_tick *t, float rate) {
  for (uint32_t b = 0; b < t->model->body_count; b++) {
    const sbri_reaction *r = &sbri_reactions(c)[b];
    if (!(r->inverse_mass > 0)) continue;
    float fraction = rate * r->inverse_mass * t->model->bodies[b].mass; /* as in sbri_rigid_mass_factor */
    t->bodies[b].velocity = sbri_add_scaled(t->bodies[b].velocity, r->shift, rate * r->inverse_mass);
    t->bodies[b].angular_momentum = sbri_add_scaled(t->bodies[b].angular_momentum, r->shift_turn, fraction);
  }
}

void sbri_coupled_before_step(
    sbri_coupled *group, const sbri_rigid_tick *t, float from, float to, float weight_s) {
  sbri_character *c = group->character;
  group->falls = t->drive->is_free && !group->is_touching;
  group->weight_s = weight_s;
  sbf_vec3 velocity_change = sbri_scale(t->gravity, group->falls ? weight_s : 0);
  float step_s = t->tick_s * (to - from);
  sbri_attached_loads_begin(c, t, step_s);
  for (uint32_t b = 0; b < t->model->body_count; b++) sbri_reactions(c)[b] = no_reaction(c, t, b, step_s);
  sbri_rigid_pose(c, group->animated, from, 0, sbri_vec3(0, 0, 0), sbri_stepped_pose(c));
  sbri_deltas_make(c, sbri_stepped_pose(c), from, sbri_previous_deltas(c));
  sbri_rigid_pose(c, group->animated, to, step_s, velocity_change, sbri_stepped_pose(c));
  sbri_deltas_make(c, sbri_stepped_pose(c), to, sbri_deltas(c));
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (sbri_island_is_coupled(c, i)) step_island(group, i, step_s, to - from, velocity_change);
  for (uint32_t b = 0; b < t->model->body_count; b++) {
    if (!sbri_rigid_is_simulated(c, b)) continue;
    sbri_rigid_body_state *body = &t->bodies[b];
    const sbri_reaction *r = &sbri_reactions(c)[b];
    if (sbri_attached_loads(c)[b].is_attached) {
      sbri_attached_load_apply_impulse(t, b, r);
      continue;
    }
    float fraction = 1 / sbri_rigid_mass_factor(&t->external, b, step_s);
    body->velocity = sbri_add_scaled(body->velocity, r->impulse, fraction * t->model->bodies[b].inverse_mass);
    body->angular_momentum = sbri_add_scaled(body->angular_momentum, r->moment, fraction);
  }
  shift(c, t, 1 / step_s);
}

/* ---- After the tick ---- */

/* A step that was halved had gravity for a shorter time. */
void sbri_coupled_after_step(
    const sbri_coupled *group, const sbri_rigid_tick *t, float step_s, float weight_s) {
  sbri_character *c = group->character;
  shift(c, t, -1 / step_s);
  for (uint32_t b = 0; b < t->model->body_count; b++) {
    /* The body moved at the velocity of its centre, the points at that of their pins. */
    const sbri_reaction *r = &sbri_reactions(c)[b];
    if (!(r->inverse_mass > 0)) continue;
    sbf_vec3 more = sbri_sub(r->shift_moment, sbri_cross(r->shift, t->bodies[b].velocity));
    t->bodies[b].angular_momentum = sbri_add(t->bodies[b].angular_momentum, more);
    sbri_attached_loads(c)[b].angular_momentum =
        sbri_add(sbri_attached_loads(c)[b].angular_momentum, more); /* shared with none */
  }
  if (!group->falls || weight_s == group->weight_s) return;
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    if (!sbri_island_is_coupled(c, i)) continue;
    sbri_island now = sbri_island_now(c, &c->model->islands[i]);
    change_velocity(c, &now, sbri_scale(t->gravity, weight_s - group->weight_s));
  }
}

void sbri_coupled_end(sbri_coupled *group) {
  sbri_character *c = group->character;
  sbri_rigid_drive(c)->soft_steps = group->any ? group->steps : 0;
  sbri_deltas_make(c, sbri_previous_pose(c), 0, sbri_previous_deltas(c));
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    if (!sbri_island_is_coupled(c, i)) continue;
    const sbri_island *island = &c->model->islands[i];
    sbri_tears *tears = &sbri_tears_of(c)[i];
    sbri_island now = sbri_island_now(c, island);
    sbri_island_tick tick = sbri_island_tick_of(group->world, c, i, &now);
    sbri_island_report_contacts(&tick, c);
    sbri_compute_pin_targets(island, sbri_deltas(c), sbri_positions(c) + island->first_slot);
    if (island->splits && tears->count > 0) tears->unsplit = sbri_island_split(c, i);
    sbri_whole_momentum removed;
    if (sbri_island_recover(group->world, c, i, &removed)) sbri_attached_body_set_momentum(c, i, &removed);
  }
}

/* ---- Sleep ---- */

bool sbri_coupled_sleep(sbri_coupled *group) {
  sbri_character *c = group->character;
  sbri_rigid_pose(c, group->animated, 1, 0, sbri_vec3(0, 0, 0), sbri_stepped_pose(c));
  sbri_deltas_make(c, sbri_stepped_pose(c), 1, sbri_deltas(c));
  bool all = true;
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (sbri_island_is_coupled(c, i)) all = sbri_island_sleeps(group->world, c, i) && all;
  return all;
}

bool sbri_coupled_are_idle(const sbri_character *c) {
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (sbri_island_is_coupled(c, i) && !sbri_island_is_idle(c, i)) return false;
  return true;
}

void sbri_coupled_put_to_sleep(const sbr_world *world, sbri_character *c) {
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (sbri_island_is_coupled(c, i)) sbri_island_put_to_sleep(world, c, i);
}
