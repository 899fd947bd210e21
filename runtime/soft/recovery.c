/* Recovery of bodies that have lost their shape.
 *
 * A body whose points are scrambled has far more energy than in normal use and oscillates for seconds if it
 * is weakly damped. So its motion is damped out for a while. After that it has either unfolded, or it rests
 * in a false equilibrium, which is detected (collapsed.c), reported and undone. */
#include <math.h>
#include <string.h>

#include "math/vec3.h"
#include "soft/soft.h"
#include "soft/solvers/rigid_motion.h"
#include "soft/solvers/router.h"

/* Ticks after which a collapsed body is reset, and after which a damped body is reset whose shape no load
 * explains. */
enum { COLLAPSED_TICKS = 24, DAMPED_TICKS = 12, CHECK_INTERVAL = 4 };

/* Ticks after which a body that damping cannot stabilise counts as stepped beyond its stability limit. */
enum { UNSTABLE_TICKS = 36 };

/* Maximum duration of damping if unknown loads may strain the body. It happens once per unstable phase, so
 * that bodies with intended high strain are damped only once. */
enum { DAMPING_TICKS = 30 };

/* Positions beyond this many metres from the origin, and speeds beyond as many metres per second, are
 * invalid, even if the numbers are finite. */
static const float MAX_VALID = 1e6f;

static bool are_valid(const float *numbers, size_t count) {
  uint32_t lost = 0;
  for (size_t i = 0; i < count; i++) lost += !(fabsf(numbers[i]) < MAX_VALID);
  return lost == 0;
}

static bool are_velocities_valid(const sbri_character *c, const sbri_island *island) {
  return are_valid(sbri_velocities(c) + 3 * (size_t)island->first_slot, 3 * (size_t)island->free_count);
}

/* The pins get no reaction here. If a pin's body is simulated, the coupled step does this instead. */
static void damp_out(sbri_character *c, uint32_t index, bool coupled) {
  const sbri_island now = sbri_island_now(c, &c->model->islands[index]), *island = &now;
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *drivers = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!body->is_pinned) sbri_rigid_motion_damp(island, body, positions, velocities, SBRI_DAMPING_KEPT, 0);
    for (uint32_t i = 3 * body->slots.begin; body->is_pinned && !coupled && i < 3 * body->slots.end; i++)
      velocities[i] = drivers[i] + (velocities[i] - drivers[i]) * SBRI_DAMPING_KEPT;
  }
}

/* ---- Motion of loose bodies ---- */

static float *velocity_at(const sbri_character *c, const sbri_island *island, uint32_t slot) {
  return sbri_velocities(c) + 3 * (size_t)(island->first_slot + slot / SBRI_BLOCK * SBRI_BLOCK) +
         slot % SBRI_BLOCK;
}

static sbri_rigid_motion motion_of(
    const sbri_character *c, const sbri_island *island, const sbri_body *body) {
  return sbri_rigid_motion_find(island, body, sbri_positions(c) + island->first_slot,
      sbri_velocities(c) + 3 * (size_t)island->first_slot);
}

/* Springs at twice their rest length, or tetrahedra so much stiffer than at rest, may become unstable. */
static const float STABLE_STRETCH = 0.5f, STABLE_STIFFENING = 4;

static bool is_stable(const sbri_island_state *state) {
  return !state->recovery.ticks && !state->unstable && state->min_ratio > 0 &&
         state->stretch < STABLE_STRETCH && state->stiffening < STABLE_STIFFENING;
}

void sbri_island_store_motions(sbri_character *c, uint32_t index) {
  const sbri_island now = sbri_island_now(c, &c->model->islands[index]), *island = &now;
  sbri_island_state *state = &sbri_island_states(c)[index];
  if (!is_stable(state) || island->scheme->forceless || !are_velocities_valid(c, island)) return;
  state->recovery.unsound_ticks = 0;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (body->is_pinned) continue;
    sbri_rigid_motion m = motion_of(c, island, body);
    sbri_driver_motions(c)[island->bodies[b]] = (sbri_driver_motion){m.velocity, m.angular_velocity};
  }
}

/* Rotational energy about the centre per mass, J/kg. */
static float rotational_energy(const sbri_rigid_motion *m, sbf_vec3 angular_velocity) {
  float size = sbri_length(angular_velocity);
  if (!(size > 0)) return 0;
  return 0.5f * size * size * sbri_inertia_about(m->inertia, sbri_scale(angular_velocity, 1 / size)) /
         m->mass_kg;
}

/* Motion of the body when it was last stable, plus free fall since then if nothing near may support it. */
static sbri_driver_motion expected_motion(
    const sbri_character *c, const sbri_island *island, uint32_t body_index, sbf_vec3 fall_velocity) {
  const sbri_body *body = &c->model->bodies[body_index];
  sbri_driver_motion m = sbri_driver_motions(c)[body_index];
  if (sbri_contact_counts(c)[body_index] > 0) return m;
  for (uint32_t block = body->slots.begin / SBRI_BLOCK; block < body->slots.end / SBRI_BLOCK; block++)
    if (sbri_near_ground(c)[island->first_slot / SBRI_BLOCK + block]) return m;
  m.velocity = sbri_add(m.velocity, fall_velocity);
  return m;
}

/* Motion of the body after a reset: the present one, unless it has more energy than the last stable motion
 * and gravity explain; then that of expected_motion. */
static sbri_driver_motion motion_to_keep(const sbr_world *world, const sbri_character *c,
    const sbri_island *island, uint32_t body_index, bool are_numbers_valid) {
  const sbri_body *body = &c->model->bodies[body_index];
  const sbri_recovery *recovery = &sbri_island_states(c)[body->island].recovery;
  sbf_vec3 g = world->has_gravity ? world->gravity : c->model->asset->environment.gravity;
  float elapsed_s = (float)(recovery->unsound_ticks + 1) * (float)world->time.tick_s * c->time_scale;
  sbf_vec3 fall_velocity = sbri_scale(g, body->source->attributes.gravity_scale * elapsed_s);
  sbri_driver_motion last_stable = sbri_driver_motions(c)[body_index];
  sbri_driver_motion expected = expected_motion(c, island, body_index, fall_velocity);
  if (!are_numbers_valid) return expected;
  float speed = sbri_length(last_stable.velocity) + sbri_length(fall_velocity);
  sbri_rigid_motion now = motion_of(c, island, body);
  if (!(now.mass_kg > 0)) return expected;
  float max = 0.5f * speed * speed + rotational_energy(&now, last_stable.angular_velocity);
  float energy = 0.5f * sbri_dot(now.velocity, now.velocity) + rotational_energy(&now, now.angular_velocity);
  return energy <= max ? (sbri_driver_motion){now.velocity, now.angular_velocity} : expected;
}

static void set_motion(
    sbri_character *c, const sbri_island *island, const sbri_body *body, const sbri_driver_motion *motion) {
  sbri_rigid_motion current = motion_of(c, island, body);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    const sbri_point *p = &sbri_positions(c)[island->first_slot + slot];
    sbf_vec3 arm = sbri_sub(sbri_vec3(p->x, p->y, p->z), current.center);
    sbf_vec3 velocity = sbri_add(motion->velocity, sbri_cross(motion->angular_velocity, arm));
    float *v = velocity_at(c, island, slot);
    v[0] = velocity.x, v[SBRI_BLOCK] = velocity.y, v[2 * SBRI_BLOCK] = velocity.z;
  }
}

/* ---- Reset ---- */

/* A body that is reset this many times in a row, each within REPEAT_WINDOW_TICKS of the last, moves as a
 * rigid body for a while: at first for RIGID_TICKS, then for twice as long each time, up to eight times. */
enum { REPEAT_WINDOW_TICKS = 30, ROW_BEFORE_RIGID = 3, RIGID_TICKS = 60, MAX_DOUBLINGS = 3 };

static void count_reset(sbri_recovery *recovery, bool may_be_rigid) {
  recovery->row = recovery->repeat_window_ticks > 0 ? recovery->row + 1 : 1;
  recovery->ticks = SBRI_RECOVERING_TICKS;
  recovery->rigid_ticks = 0;
  if (may_be_rigid && recovery->row >= ROW_BEFORE_RIGID) {
    uint32_t doublings = recovery->row - ROW_BEFORE_RIGID;
    recovery->rigid_ticks = RIGID_TICKS << (doublings < MAX_DOUBLINGS ? doublings : MAX_DOUBLINGS);
  }
  recovery->repeat_window_ticks = REPEAT_WINDOW_TICKS + recovery->rigid_ticks;
}

static void count_tick(sbri_recovery *recovery) {
  recovery->unsound_ticks++;
  if (recovery->jumped_ticks > 0) recovery->jumped_ticks--;
  if (recovery->repeat_window_ticks > 0) recovery->repeat_window_ticks--;
  if (recovery->rigid_ticks > 0) recovery->rigid_ticks--;
}

/* Whether a jump of the pins has left the island in a crushed shape. A reset is tried once: if all shapes are
 * crushed, the body returns to the same one. */
static bool is_crushed_by_jump(sbri_recovery *recovery, const sbri_shape *shape) {
  bool crushed = shape->crushed && recovery->jumped_ticks > 0;
  recovery->crushed_ticks = crushed ? recovery->crushed_ticks + CHECK_INTERVAL : 0;
  if (recovery->crushed_ticks < COLLAPSED_TICKS) return false;
  recovery->jumped_ticks = recovery->crushed_ticks = 0;
  return true;
}

static void reset(
    const sbr_world *world, sbri_character *c, uint32_t index, bool are_numbers_valid, bool coupled) {
  const sbri_island now = sbri_island_now(c, &c->model->islands[index]), *island = &now;
  sbri_island_state *state = &sbri_island_states(c)[index];
  sbri_point *motions =
      sbri_velocity_points(c) + island->first_slot; /* a loose body has at least one block of slots */
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (body->slots.begin == body->slots.end) continue;
    sbri_driver_motion m = motion_to_keep(world, c, island, island->bodies[b], are_numbers_valid);
    motions[body->slots.begin] = (sbri_point){m.velocity.x, m.velocity.y, m.velocity.z, 0};
    motions[body->slots.begin + 1] =
        (sbri_point){m.angular_velocity.x, m.angular_velocity.y, m.angular_velocity.z, 0};
  }
  sbri_island_reset_flow(c, index);
  sbri_island_reset_in_place(c, index, &c->ground);
  memcpy(sbri_previous_positions(c) + island->first_slot, sbri_positions(c) + island->first_slot,
      island->slot_count * sizeof(sbri_point));
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (body->is_pinned || body->slots.begin == body->slots.end || island->scheme->forceless) continue;
    const sbri_point *v = &motions[body->slots.begin], *w = v + 1;
    sbri_driver_motion m = {{v->x, v->y, v->z}, {w->x, w->y, w->z}};
    set_motion(c, island, body, &m);
    sbri_driver_motions(c)[island->bodies[b]] = m;
  }
  state->recoveries++;
  count_reset(&state->recovery, !coupled && !island->scheme->forceless);
}

static bool put_back(const sbr_world *world, sbri_character *c, uint32_t index, sbri_whole_momentum *lost) {
  if (lost) *lost = sbri_island_momentum(c, index);
  reset(world, c, index, true, lost != NULL);
  return true;
}

bool sbri_island_recover(
    const sbr_world *world, sbri_character *c, uint32_t index, sbri_whole_momentum *lost) {
  const sbri_island *island = &c->model->islands[index];
  sbri_island_state *state = &sbri_island_states(c)[index];
  if (!are_valid(&sbri_positions(c)[island->first_slot].x, 4 * (size_t)island->slot_count) ||
      !are_velocities_valid(c, island)) {
    if (lost) lost->mass = 0;
    reset(world, c, index, false, lost != NULL);
    return true;
  }
  count_tick(&state->recovery);
  if (state->damping_ticks > 0) {
    state->damping_ticks--;
    damp_out(c, index, lost != NULL);
  }
  if ((world->time.ticks + index) % CHECK_INTERVAL)
    return state->recovery.ticks > 0 && sbri_is_inside_out(c, index) && put_back(world, c, index, lost);
  sbri_shape shape = sbri_shape_of(world, c, index);
  if (!shape.unstable)
    state->damping_ticks = 0;
  else if ((shape.is_reported || !state->unstable) && !island->scheme->forceless)
    state->damping_ticks = DAMPING_TICKS;
  state->unstable = shape.unstable ? state->unstable + CHECK_INTERVAL : 0;
  state->excess_j = shape.excess_j;
  state->collapsed_ticks = shape.collapsed ? state->collapsed_ticks + CHECK_INTERVAL : 0;
  if (shape.collapsed) state->recovery.ticks = SBRI_RECOVERING_TICKS;
  bool is_collapsed =
      state->collapsed_ticks >= (shape.unstable && shape.is_reported ? DAMPED_TICKS : COLLAPSED_TICKS);
  bool jumped = is_crushed_by_jump(&state->recovery, &shape);
  if (!is_collapsed && !jumped && !shape.inside_out &&
      !(shape.is_reported && shape.heaped && state->unstable >= UNSTABLE_TICKS))
    return false;
  return put_back(world, c, index, lost);
}
