/* The tick of characters whose bodies are in contact, in one task.
 *
 * Rigid parts and the islands in contact take equal steps, as short as the stiffest of them needs. Contact
 * impulses are applied before each step (coupling/body_contact/contact_step.c); within a step everything
 * moves as it does alone. Compressed bodies stiffen, so the step limit is computed again after each step, and
 * the rest of the tick is divided anew if it has become shorter. Islands without contacts take their own
 * steps. */
#include <string.h>

#include "coupling/body_contact/body_contacts.h"
#include "coupling/ragdoll/ragdoll.h"
#include "math/vec3.h"
#include "soft/soft.h"
#include "soft/solvers/external_forces.h"
#include "soft/solvers/router.h"
#include "soft/solvers/scheme.h"
#include "soft/solvers/tetrahedron_forces.h"
#include "soft/tear/tear.h"
#include "world/detail/detail_levels.h"
#include "world/step.h"

/* Minimum and maximum number of steps per tick. Fewer do not resolve contacts that change within a tick. */
enum { MIN_STEPS = 4, MAX_STEPS = 128 };
/* Minimum number of steps per substep that a soft body needs without contacts. */
enum { STEPS_OF_SOFT = 2 };

static sbri_group_member member_of(const sbr_world *world, sbri_character *c, sbr_double3 origin) {
  sbr_double3 needed = sbri_header(c)->origin;
  sbri_group_member m = {.character = c,
      .offset = {(float)(needed.x - origin.x), (float)(needed.y - origin.y), (float)(needed.z - origin.z)},
      .scale = c->scale,
      .velocity_scale = c->scale * c->time_scale,
      .mass = c->scale * c->scale * c->scale,
      .tick_s = (float)world->time.tick_s * c->time_scale};
  m.pinned_rate = 1 / m.tick_s;
  return m;
}

/* Islands that are stepped here one by one. The others are stepped with rigid parts, or alone. */
static bool is_stepped_here(const sbri_group_member *m, uint32_t island) {
  const sbri_character *c = m->character;
  return !sbri_island_is_coupled(c, island) && !c->model->islands[island].scheme->forceless &&
         !sbri_island_states(c)[island].asleep;
}

static bool is_in_contact(const sbri_group_member *m, uint32_t island) {
  return is_stepped_here(m, island) && sbri_contact_islands(m->character)[island];
}

/* ---- Begin of the tick ---- */

static uint32_t steps_of(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  if (island->scheme->sweeps || island->stepping.substeps) return island->stepping.substeps;
  float stretch =
      *t->springs.stretch > island->springs.rest_stretch ? *t->springs.stretch : island->springs.rest_stretch;
  return STEPS_OF_SOFT * sbri_scheme_substeps(island, sbri_stiffened_time(t, t->tick_s), stretch);
}

/* Prepares pinned points to move from their positions to their targets. */
static void prepare_pins(sbri_character *c, const sbri_island *island) {
  sbri_point *begins = sbri_begins(c) + island->first_slot;
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  sbri_compute_pin_targets(island, sbri_deltas(c), sbri_targets(c) + island->first_slot);
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) begins[slot] = positions[slot];
}

static void begin_island(const sbr_world *world, sbri_group_member *m, uint32_t index) {
  sbri_character *c = m->character;
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  (void)sbri_island_update_drivers(c, &now, index, m->tick_s); /* pins that jumped continue from there */
  sbri_island_fill_unused_slots(c, &now);
  sbri_island_store_motions(c, index);
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, &now);
  tick.surfaces.external_rad_s = &now.stability.external_rad_s;
  sbri_update_gas_stiffness(&tick);
  prepare_pins(c, &now);
  sbri_island_prepare_contacts(&tick, c);
  (void)sbri_router_choose(&tick, &sbri_island_states(c)[index].recovery);
}

static void begin(const sbr_world *world, sbri_group_member *m) {
  sbri_character *c = m->character;
  (void)sbri_rigid_parts_begin(world, c, &m->parts);
  if (c->model->island_count) sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    if (!is_stepped_here(m, i)) {
      if (sbri_island_is_coupled(c, i)) prepare_pins(c, &c->model->islands[i]);
      continue;
    }
    begin_island(world, m, i);
  }
}

/* Number of steps per tick that the member needs; 0: it has nothing to step. */
static uint32_t count_steps(const sbr_world *world, const sbri_group_member *m) {
  sbri_character *c = m->character;
  uint32_t max = m->parts.steps ? m->parts.tick.substeps : 0;
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    if (!is_in_contact(m, i)) continue;
    sbri_island now = sbri_island_now(c, &c->model->islands[i]);
    sbri_island_tick tick = sbri_island_tick_of(world, c, i, &now);
    tick.surfaces.external_rad_s = &now.stability.external_rad_s;
    sbri_update_gas_stiffness(&tick);
    uint32_t steps = steps_of(&tick);
    max = steps > max ? steps : max;
  }
  return max;
}

/* ---- Steps ---- */

/* Returns the number of such steps per tick that the island needs now. */
static uint32_t advance_island(
    const sbr_world *world, sbri_group_member *m, uint32_t index, float from, float to) {
  sbri_character *c = m->character;
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_point *targets = sbri_targets(c) + now.first_slot;
  const sbri_point *positions = sbri_positions(c) + now.first_slot;
  float fraction = to - from, rest_fraction = fraction / (1 - from);
  if (now.stepping.substeps) now.stepping.substeps = (uint32_t)ceilf(fraction * (float)now.stepping.substeps);
  sbri_compute_pin_targets(&now, sbri_deltas(c), targets);
  for (uint32_t s = now.free_count; s < now.slot_count; s++) {
    const sbri_point *x = &positions[s];
    targets[s] = (sbri_point){x->x + rest_fraction * (targets[s].x - x->x),
        x->y + rest_fraction * (targets[s].y - x->y), x->z + rest_fraction * (targets[s].z - x->z), 0};
  }
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, &now);
  tick.tick_s *= fraction, tick.fraction = fraction;
  tick.surfaces.external_rad_s = &now.stability.external_rad_s;
  sbri_update_gas_stiffness(&tick);
  sbri_router_scheme(&now, &sbri_island_states(c)[index].recovery)->tick(&tick);
  if (now.scheme->sweeps || now.stepping.substeps) return 0;
  tick.tick_s = m->tick_s, tick.fraction = 1;
  return steps_of(&tick);
}

/* Returns the maximum over the member's parts. */
static uint32_t advance(const sbr_world *world, sbri_group_member *m, float from, float to) {
  sbri_character *c = m->character;
  uint32_t max = 0;
  if (m->parts.steps) {
    sbri_rigid_advance(&m->parts.tick, &m->parts.work, from, to);
    sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c)); /* the step has computed its own deltas */
    max = m->parts.coupled.any ? m->parts.coupled.steps : 0;
  }
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    uint32_t steps = is_in_contact(m, i) ? advance_island(world, m, i, from, to) : 0;
    max = steps > max ? steps : max;
  }
  m->tick_fraction = to;
  m->pinned_rate = 1 / (m->tick_s * (to - from));
  return max;
}

/* ---- End of the tick ---- */

/* The whole tick of an island without contacts. */
static void run_without_contacts(const sbr_world *world, const sbri_group_member *m, uint32_t index) {
  sbri_character *c = m->character;
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  if (m->parts.steps) /* rigid parts have moved the pins */
    sbri_compute_pin_targets(&now, sbri_deltas(c), sbri_targets(c) + now.first_slot);
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, &now);
  tick.surfaces.external_rad_s = &now.stability.external_rad_s;
  sbri_update_gas_stiffness(&tick);
  sbri_router_scheme(&now, &sbri_island_states(c)[index].recovery)->tick(&tick);
}

static void end_island(const sbr_world *world, sbri_group_member *m, uint32_t index) {
  sbri_character *c = m->character;
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, &now);
  if (is_in_contact(m, index))
    sbri_compute_pin_targets(&now, sbri_deltas(c), sbri_positions(c) + now.first_slot);
  sbri_island_report_contacts(&tick, c);
  if (now.splits && tick.tears->count > 0) tick.tears->unsplit = sbri_island_split(c, index);
  (void)sbri_island_recover(world, c, index, NULL);
  sbri_island_update_sleep(world, c, index);
}

static void end(const sbr_world *world, sbri_group_member *m) {
  sbri_character *c = m->character;
  if (m->parts.steps) sbri_rigid_parts_end(&m->parts);
  sbri_jiggles_tick(c, m->tick_s);
  if (c->model->island_count) sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    if (!is_stepped_here(m, i)) continue;
    if (!is_in_contact(m, i)) run_without_contacts(world, m, i);
    end_island(world, m, i);
  }
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (c->model->islands[i].scheme->forceless) sbri_island_run(world, c, i, NULL);
}

/* Rounds up to one of few step counts: counts that change from tick to tick excite oscillations. */
static uint32_t rounded_steps(uint32_t steps) {
  uint32_t rounded = MIN_STEPS;
  while (rounded < steps) rounded = rounded % 3 ? rounded / 2 * 3 : rounded / 3 * 4;
  return rounded < MAX_STEPS ? rounded : MAX_STEPS;
}

/* Whether a contact resolves deep penetration. Its speed is bounded and its load is steady, so shorter steps
 * would not improve it. */
static bool has_deep_exit(const sbr_world *world, const sbri_contact_group *group) {
  const sbri_contact *contacts = world->body_contacts->contacts + group->first_contact;
  bool any = false;
  for (uint32_t i = 0; i < group->contact_count; i++)
    any |= contacts[i].exits_nearest || contacts[i].exits_common;
  return any;
}

static void run_steps(const sbr_world *world, sbri_contact_group *group, uint32_t steps) {
  sbri_group_member *members = world->body_contacts->members + group->first_member;
  bool deep_exit = has_deep_exit(world, group);
  float begin = 0, from = 0; /* where steps of equal length begin */
  for (uint32_t done = 0; done < steps;) {
    float to = begin + (1 - begin) * ((float)(done + 1) / (float)steps);
    uint32_t max = 0;
    sbri_contacts_solve(world, group, from == 0);
    for (uint32_t i = 0; i < group->member_count; i++) {
      uint32_t needed = advance(world, &members[i], from, to);
      max = needed > max ? needed : max;
    }
    done++, from = to;
    uint32_t left = (uint32_t)ceilf((1 - to) * (float)rounded_steps(max) * 0.9999f);
    if (done == steps || deep_exit || left <= steps - done) continue;
    begin = to, steps = left, done = 0;
    sbri_contacts_scale_impulses(
        world->body_contacts, group, (float)world->time.tick_s * (1 - begin) / (float)steps);
  }
}

void sbri_group_run(sbr_world *world, sbri_contact_group *group) {
  sbri_group_member *members = world->body_contacts->members + group->first_member;
  uint32_t steps = 0;
  for (uint32_t i = 0; i < group->member_count; i++) {
    members[i] = member_of(world, members[i].character, group->origin);
    begin(world, &members[i]);
  }
  sbri_solver_bodies_list(world->body_contacts, group);
  sbri_narrow_phase_update(world, group);
  for (uint32_t i = 0; i < group->member_count; i++) {
    uint32_t needed = count_steps(world, &members[i]);
    steps = needed > steps ? needed : steps;
  }
  group->step_s =
      (float)world->time.tick_s; /* bodies moved by bones are not stepped, but their contacts are stored */
  if (steps > 0) {
    steps = rounded_steps(steps);
    for (uint32_t i = 0; i < group->member_count; i++)
      if (members[i].parts.steps) members[i].parts.tick.substeps = steps;
    group->step_s /= (float)steps;
    sbri_contacts_load_cached(world->body_contacts, group, group->step_s);
    run_steps(world, group, steps);
    sbri_contacts_finish_tick(world->body_contacts, group);
  }
  for (uint32_t i = 0; i < group->member_count; i++) end(world, &members[i]);
}
