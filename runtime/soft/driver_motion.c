/* How bodies follow what holds them: guides are where its frames would have each point, and their velocities
 * what damping and pins go by. Frames may jump, or start with a jerk that no matter would bear. */
#include <math.h>
#include <string.h>

#include "math/vec3.h"
#include "soft/soft.h"
#include "solvers/rigid_motion.h"
#include "solvers/scheme.h"

/* Velocities of a body's guides over the tick, in blocks. False where they go farther in it than the body is
 * large: they have jumped. */
static bool find_velocities(
    sbri_character *c, const sbri_island *island, const sbri_body *body, float tick_s) {
  float rate = 1 / tick_s, farthest = 0;
  sbri_point *from = sbri_begins(c) + island->first_slot + body->slot_begin;
  sbri_point *to = sbri_velocity_points(c) + island->first_slot + body->slot_begin;
  sbri_compute_driver_positions(c->model, body, sbri_previous_deltas(c), from);
  sbri_compute_driver_positions(c->model, body, sbri_deltas(c), to);
  sbri_follow_origins(c, body, from);
  sbri_follow_origins(c, body, to);
  float *velocities = sbri_driver_velocities(c) + 3 * (size_t)(island->first_slot + body->slot_begin);
  for (uint32_t i = 0; i < body->slot_end - body->slot_begin; i++) {
    float x = to[i].x - from[i].x, y = to[i].y - from[i].y, z = to[i].z - from[i].z;
    float *v = velocities + 3 * (i / SBRI_BLOCK * SBRI_BLOCK) + i % SBRI_BLOCK,
          square = x * x + y * y + z * z;
    v[0] = x * rate, v[SBRI_BLOCK] = y * rate, v[2 * SBRI_BLOCK] = z * rate;
    farthest = square > farthest ? square : farthest;
  }
  float max = body->rest_size_m + 0.05f * c->model->rest_size_m;
  return !(farthest > max * max);
}

/* Bound of the change of velocity of the driver of any point in the tick, m/s. */
static float change_of(
    const sbri_body *body, const sbri_rigid_motion *is, const sbri_driver_motion *was, float tick_s) {
  float turn = sbri_length(sbri_sub(is->angular_velocity, was->angular_velocity));
  turn += sbri_dot(was->angular_velocity, was->angular_velocity) * tick_s;
  return sbri_length(sbri_sub(is->velocity, was->velocity)) + turn * body->rest_size_m;
}

/* Gives the body's points what its guides' velocity, as that of a rigid body, has changed by in the tick
 * beyond what it is made to feel: bones that are thrown about and whipped round take it along. Guides change
 * their velocity when a tick begins, all at once. */
static void soften_start(sbri_character *c, const sbri_island *island, const sbri_body *body,
    const sbri_rigid_motion *is, const sbri_driver_motion *was, float tick_s) {
  const sbri_point *from = sbri_begins(c) + island->first_slot;
  float max = fminf(island->max_acceleration_m_s2 * tick_s, island->max_push_m_s);
  sbf_vec3 push = sbri_sub(is->velocity, was->velocity),
           turn = sbri_sub(is->angular_velocity, was->angular_velocity);
  if (island->scheme->forceless || !(max > 0)) return;
  if (!(change_of(body, is, was, tick_s) > max)) return;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot++) {
    float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 arm = sbri_sub(sbri_vec3(from[slot].x, from[slot].y, from[slot].z), is->center);
    sbf_vec3 change = sbri_add(push, sbri_cross(turn, arm)), inward = sbri_cross(was->angular_velocity, arm);
    change = sbri_add_scaled(change, sbri_cross(was->angular_velocity, inward), tick_s);
    float size = sbri_length(change);
    if (!(island->masses[slot] > 0) || !(size > max)) continue;
    change = sbri_scale(change, 1 - max / size);
    v[0] += change.x, v[SBRI_BLOCK] += change.y, v[2 * SBRI_BLOCK] += change.z;
  }
}

/* How the body's guides move, as a rigid body. */
static sbri_rigid_motion motion_of(
    const sbri_character *c, const sbri_island *island, const sbri_body *body) {
  return sbri_rigid_motion_find(island, body, sbri_begins(c) + island->first_slot,
      sbri_driver_velocities(c) + 3 * (size_t)island->first_slot);
}

/* With the velocities of its guides, which are found. */
static void move_along(sbri_character *c, const sbri_island *island, float tick_s) {
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *drivers = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!body->is_pinned) continue;
    sbri_rigid_motion now = motion_of(c, island, body);
    sbri_driver_motions(c)[island->bodies[b]] = (sbri_driver_motion){now.velocity, now.angular_velocity};
    for (uint32_t i = 3 * body->slot_begin; i < 3 * body->slot_end; i++)
      velocities[i] = island->scheme->forceless ? velocities[i] - drivers[i] * tick_s : drivers[i];
  }
}

/* Carries the island with its frames, as fast as they go. */
static void ride(sbri_character *c, const sbri_island *island, uint32_t index, float tick_s) {
  sbri_island_carry(c, index);
  move_along(c, island, tick_s);
}

/* A jump of pins relative to each other may leave the body crushed. For so many ticks after it, that is
 * checked.
 */
enum { JUMPED_TICKS = 240 };

/* What acceleration has strained stays so for some swings. */
static const float FORGOTTEN_PER_S = 3;

static void note_acceleration(sbri_recovery *recovery, float change, float tick_s) {
  float kept = recovery->acceleration_m_s2 * (1 - fminf(FORGOTTEN_PER_S * tick_s, 1));
  recovery->acceleration_m_s2 = fmaxf(kept, change / tick_s);
}

/* Whether pin frames move by more than half a cell against the body's rigid motion; with two frames each
 * moves by half of the displacement. */
static bool is_fully_torn(const sbri_character *c, const sbri_island *island, const sbri_body *body,
    const sbri_rigid_motion *is, float tick_s) {
  const float *drivers = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  float max = 0.5f * island->cell_m / tick_s;
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot++) {
    const sbri_point *p = &sbri_begins(c)[island->first_slot + slot];
    const float *v = drivers + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 arm = sbri_sub(sbri_vec3(p->x, p->y, p->z), is->center);
    sbf_vec3 off = sbri_sub(sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]),
        sbri_add(is->velocity, sbri_cross(is->angular_velocity, arm)));
    if (island->masses[slot] > 0 && sbri_dot(off, off) > max * max) return true;
  }
  return false;
}

bool sbri_driver_velocities_find(sbri_character *c, const sbri_island *island, float tick_s) {
  bool jumped = false;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    jumped = (body->is_pinned && !find_velocities(c, island, body, tick_s)) || jumped;
  }
  return !jumped;
}

void sbri_drivers_advance(sbri_character *c, const sbri_island *island, float tick_s) {
  if (sbri_driver_velocities_find(c, island, tick_s)) move_along(c, island, tick_s);
}

bool sbri_island_update_drivers(sbri_character *c, const sbri_island *island, uint32_t index, float tick_s) {
  if (!sbri_driver_velocities_find(c, island, tick_s)) {
    ride(c, island, index, tick_s);
    return false;
  }
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbri_driver_motion *motion = &sbri_driver_motions(c)[island->bodies[b]];
    if (!body->is_pinned) continue;
    sbri_rigid_motion now = motion_of(c, island, body);
    soften_start(c, island, body, &now, motion, tick_s);
    note_acceleration(&sbri_island_states(c)[index].recovery, change_of(body, &now, motion, tick_s), tick_s);
    if (body->drivers && island->cell_m > 0 && is_fully_torn(c, island, body, &now, tick_s))
      sbri_island_states(c)[index].recovery.jumped_ticks = JUMPED_TICKS;
    *motion = (sbri_driver_motion){now.velocity, now.angular_velocity};
  }
  return true;
}
