/* Number of steps in a tick of soft bodies and the rigid bodies that they are pinned to.
 *
 * Implicitly coupled soft bodies need few (attached_bodies.c). All others take the bones' steps: a step is no
 * longer than the soft body's own substep limit, and than the limit from each bone's frequency on its soft
 * bodies. Both limits are computed again after each step, because compressed bodies stiffen and a step that
 * has become too long makes undamped bodies gain energy; the rest of the tick is then divided again. A point
 * also moves by at most a fraction of a cell against its bones in a step, so that the stiffening is noticed
 * in time. Fast impacts bound the step of all (soft/solvers/motion.h). */
#include "coupling/ragdoll/ragdoll.h"
#include "soft/soft.h"
#include "soft/solvers/motion.h"
#include "soft/solvers/router.h"
#include "soft/solvers/tetrahedron_forces.h"

/* Maximum number of steps of rigid parts per tick. */
enum { MAX_STEPS = SBRI_TROUBLED_SOLID_SUBSTEPS };

/* Displacement of a point against its pin frames in a step, as a fraction of its body's cells. */
static const float MAX_TRAVEL = 0.25f;

/* Maximum angular frequency times step size of a bone on a soft body that is stiffer than at rest; at rest
 * the bound is SBRI_RIGID_MAX_SWING. */
static const float MAX_STIFFENED_SWING = 1.2f;

/* Undamped bodies never come to rest, and gain energy by each change of a step size near the stability limit:
 * factor on their number of steps. */
static const float FINER_UNDAMPED = 1.25f;

/* Rounds up to one of few step counts, because a leapfrog gains energy if its step size changes often. */
static uint32_t rounded_steps(uint32_t steps) {
  uint32_t whole = 4;
  while (whole < steps && whole < MAX_STEPS) whole *= 2;
  for (uint32_t quarter = 5; quarter < 8; quarter++)
    if (whole * quarter / 8 >= steps) return whole * quarter / 8;
  return whole;
}

/* The soft body's own number of substeps, so that both have equal steps: modes of a stiff body can resonate
 * with other steps. Sweeping schemes damp these modes and do not need it. */
static uint32_t steps_of(const sbri_island_tick *t, float tick_s) {
  const sbri_island *island = t->island;
  if (island->scheme->sweeps || island->stepping.substeps) return island->stepping.substeps;
  float stretch =
      *t->springs.stretch > island->springs.rest_stretch ? *t->springs.stretch : island->springs.rest_stretch;
  float finer = island->stepping.lightly_damped ? FINER_UNDAMPED : 1;
  return rounded_steps(sbri_scheme_substeps(island, sbri_stiffened_time(t, finer * tick_s), stretch));
}

/* Constant number of steps for the oscillation frequency of a body on its soft bodies at rest. */
static float swung_steps(const sbri_character *c, uint32_t body, float tick_s) {
  return tick_s * sqrtf(c->model->rigid.pinned_squares[body]) / SBRI_RIGID_MAX_SWING;
}

static float tick_of(const sbri_coupled *group) {
  return (float)group->world->time.tick_s * group->character->time_scale;
}

static void request_steps(sbri_coupled *group, float steps) {
  if (steps > (float)group->steps) group->steps = steps < MAX_STEPS ? (uint32_t)ceilf(steps) : MAX_STEPS;
}

static bool may_be_attached(const sbri_character *c, const sbri_island *island) {
  return island->pins.attachment_count == 1 && sbri_can_attach(c, island->pins.attachments[0]);
}

/* The number of steps that the tick needs. Bones with implicitly coupled bodies are checked last, when those
 * of all others are known. */
static void need_steps(sbri_coupled *group, float steps, int32_t attachment) {
  if (attachment < 0 || !sbri_can_attach(group->character, (uint32_t)attachment)) {
    request_steps(group, steps);
    return;
  }
  sbri_attached_load *attached_load = &sbri_attached_loads(group->character)[attachment];
  attached_load->needed_steps = steps > attached_load->needed_steps ? steps : attached_load->needed_steps;
}

/* ---- By displacement ---- */

/* Maximum speed of a point relative to its drivers, m/s. */
static float speed_against_drivers(const sbri_character *c, const sbri_island *island) {
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot,
              *drivers = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  float max = 0;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    for (uint32_t slot = body->slots.begin; body->is_pinned && slot < body->slots.real_end; slot++) {
      size_t at = 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
      const float *v = velocities + at, *u = drivers + at;
      float x = v[0] - u[0], y = v[SBRI_BLOCK] - u[SBRI_BLOCK], z = v[2 * SBRI_BLOCK] - u[2 * SBRI_BLOCK];
      float square = x * x + y * y + z * z;
      max = island->masses[slot] > 0 && square > max ? square : max;
    }
  }
  return sqrtf(max);
}

/* Predicts a step of the present length. */
static void check_directions(sbri_coupled *group) {
  sbri_character *c = group->character;
  float fraction = 1 / (float)group->steps, step_s = tick_of(group) * fraction;
  bool any = false;
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    const sbri_island *island = &c->model->islands[i];
    if (!sbri_island_is_coupled(c, i) || may_be_attached(c, island) || island->scheme->sweeps ||
        !(island->stability.cell_m > 0))
      continue;
    if (!any) {
      sbri_rigid_pose(c, group->animated, 0, 0, sbri_vec3(0, 0, 0), sbri_stepped_pose(c));
      sbri_deltas_make(c, sbri_stepped_pose(c), 0, sbri_previous_deltas(c));
      sbri_rigid_pose(c, group->animated, fraction, step_s, sbri_vec3(0, 0, 0), sbri_stepped_pose(c));
      sbri_deltas_make(c, sbri_stepped_pose(c), fraction, sbri_deltas(c));
      any = true;
    }
    (void)sbri_driver_velocities_find(c, island, step_s);
    request_steps(
        group, tick_of(group) * speed_against_drivers(c, island) / (MAX_TRAVEL * island->stability.cell_m));
  }
  if (any) sbri_deltas_make(c, sbri_previous_pose(c), 0, sbri_previous_deltas(c));
}

/* ---- By impact ---- */

/* For impacts faster than a body's own substeps resolve, at about its speed of sound. Bones of attached
 * bodies take as many: a soft body between a bone and the ground supports the bone, but only after a step. */
static void request_steps_of_impact(sbri_coupled *group, const sbri_island_tick *tick) {
  float steps = fminf(ceilf(sbri_impact_substeps(tick, tick_of(group))), MAX_STEPS);
  if (steps > (float)group->steps && steps > (float)steps_of(tick, tick_of(group)))
    request_steps(group, (float)rounded_steps((uint32_t)steps));
}

/* ---- For a tick, and for its remainder ---- */

void sbri_coupled_request_steps(sbri_coupled *group, const sbri_island_tick *tick) {
  const sbri_island *island = tick->island;
  int32_t attachment = island->pins.attachment_count == 1 ? (int32_t)island->pins.attachments[0] : -1;
  need_steps(group, (float)steps_of(tick, tick_of(group)), attachment);
  request_steps_of_impact(group, tick);
}

/* Whether a coupled body is undamped. */
static bool is_lightly_damped(const sbri_character *c) {
  bool any = false;
  for (uint32_t i = 0; i < c->model->island_count; i++)
    any = any || (c->model->islands[i].stepping.lightly_damped && sbri_island_is_coupled(c, i));
  return any;
}

/* Undamped bodies gain energy whenever the step size changes near the stability limit. So the number of steps
 * stays as before unless half as many would suffice. */
void sbri_coupled_request_steps_of_bones(sbri_coupled *group) {
  const sbri_character *c = group->character;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    float steps = swung_steps(c, b, tick_of(group));
    if (!sbri_rigid_is_simulated(c, b)) continue;
    need_steps(group, steps < SBRI_RIGID_MAX_SUBSTEPS ? steps : SBRI_RIGID_MAX_SUBSTEPS, (int32_t)b);
    float needed = sbri_attached_loads(c)[b].needed_steps;
    if (!(needed > (float)group->steps)) continue;
    float bearing = sbri_bearing_steps(c, b, tick_of(group));
    request_steps(group, needed < bearing ? needed : bearing);
  }
  check_directions(group);
  if (is_lightly_damped(c) && 2 * group->steps > sbri_rigid_drive(c)->soft_steps)
    request_steps(group, (float)sbri_rigid_drive(c)->soft_steps);
}

void sbri_coupled_request_steps_now(sbri_coupled *group, const sbri_island_tick *tick) {
  const sbri_character *c = group->character;
  const sbri_island *island = tick->island;
  request_steps_of_impact(group, tick);
  if (island->scheme->sweeps || may_be_attached(c, island)) return;
  request_steps(group, (float)steps_of(tick, tick_of(group)));
  double stiffened_s = sbri_stiffened_time(tick, tick_of(group));
  for (uint32_t i = 0; i < island->pins.attachment_count; i++) {
    uint32_t b = island->pins.attachments[i];
    if (sbri_rigid_is_simulated(c, b))
      request_steps(
          group, (float)stiffened_s * sqrtf(c->model->rigid.pinned_squares[b]) / MAX_STIFFENED_SWING);
  }
}

uint32_t sbri_coupled_steps_left(const sbri_coupled *group, float rest, uint32_t left) {
  uint32_t needed = group->any ? (uint32_t)ceilf(rest * (float)group->steps * 0.9999f) : 1;
  return needed > left ? needed : left;
}
