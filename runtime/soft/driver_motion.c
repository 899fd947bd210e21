/* Motion of pinned bodies with their drivers. A driver is the position that the pin frames give a point;
 * damping and pins use its velocity. Frames may jump, or start with an acceleration that no material would
 * survive. */
#include <math.h>
#include <string.h>

#include "math/vec3.h"
#include "soft/soft.h"
#include "soft/solvers/rigid_motion.h"
#include "soft/solvers/scheme.h"

/* Driver velocities of a body over the tick, in blocks. Returns false if a driver moves by more than the size
 * of the body: the drivers have jumped. */
static bool find_velocities(
    sbri_character *c, const sbri_island *island, const sbri_body *body, float tick_s) {
  float rate = 1 / tick_s, max_square = 0;
  sbri_point *from = sbri_begins(c) + island->first_slot + body->slots.begin;
  sbri_point *to = sbri_velocity_points(c) + island->first_slot + body->slots.begin;
  sbri_compute_driver_positions(c->model, body, sbri_previous_deltas(c), from);
  sbri_compute_driver_positions(c->model, body, sbri_deltas(c), to);
  sbri_follow_origins(c, body, from);
  sbri_follow_origins(c, body, to);
  float *velocities = sbri_driver_velocities(c) + 3 * (size_t)(island->first_slot + body->slots.begin);
  for (uint32_t i = 0; i < body->slots.end - body->slots.begin; i++) {
    float x = to[i].x - from[i].x, y = to[i].y - from[i].y, z = to[i].z - from[i].z;
    float *v = velocities + 3 * (i / SBRI_BLOCK * SBRI_BLOCK) + i % SBRI_BLOCK,
          square = x * x + y * y + z * z;
    v[0] = x * rate, v[SBRI_BLOCK] = y * rate, v[2 * SBRI_BLOCK] = z * rate;
    max_square = square > max_square ? square : max_square;
  }
  float max = body->rest_size_m + 0.05f * c->model->rest_size_m;
  return !(max_square > max * max);
}

/* Bound of the velocity change of any driver in the tick, m/s. */
static float velocity_change_of(
    const sbri_body *body, const sbri_rigid_motion *now, const sbri_driver_motion *before, float tick_s) {
  float angular_change = sbri_length(sbri_sub(now->angular_velocity, before->angular_velocity));
  angular_change += sbri_dot(before->angular_velocity, before->angular_velocity) * tick_s;
  return sbri_length(sbri_sub(now->velocity, before->velocity)) + angular_change * body->rest_size_m;
}

/* Limits the acceleration of a body by its drivers: adds the excess of their rigid velocity change directly
 * to the points, so that the body moves along without strain. Drivers change velocity at once when a tick
 * begins. */
static void limit_acceleration(sbri_character *c, const sbri_island *island, const sbri_body *body,
    const sbri_rigid_motion *now, const sbri_driver_motion *before, float tick_s) {
  const sbri_point *from = sbri_begins(c) + island->first_slot;
  float max =
      fminf(island->stability.max_acceleration_m_s2 * tick_s, island->stability.max_velocity_change_m_s);
  sbf_vec3 linear_change = sbri_sub(now->velocity, before->velocity),
           angular_change = sbri_sub(now->angular_velocity, before->angular_velocity);
  if (island->scheme->forceless || !(max > 0)) return;
  if (!(velocity_change_of(body, now, before, tick_s) > max)) return;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 arm = sbri_sub(sbri_vec3(from[slot].x, from[slot].y, from[slot].z), now->center);
    sbf_vec3 change = sbri_add(linear_change, sbri_cross(angular_change, arm)),
             inward = sbri_cross(before->angular_velocity, arm);
    change = sbri_add_scaled(change, sbri_cross(before->angular_velocity, inward), tick_s);
    float size = sbri_length(change);
    if (!(island->masses[slot] > 0) || !(size > max)) continue;
    change = sbri_scale(change, 1 - max / size);
    v[0] += change.x, v[SBRI_BLOCK] += change.y, v[2 * SBRI_BLOCK] += change.z;
  }
}

/* Rigid motion of the body's drivers. */
static sbri_rigid_motion motion_of(
    const sbri_character *c, const sbri_island *island, const sbri_body *body) {
  return sbri_rigid_motion_find(island, body, sbri_begins(c) + island->first_slot,
      sbri_driver_velocities(c) + 3 * (size_t)island->first_slot);
}

/* Sets the velocities of the bodies to those of their drivers, which must be computed. */
static void set_driver_velocities(sbri_character *c, const sbri_island *island, float tick_s) {
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *drivers = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!body->is_pinned) continue;
    sbri_rigid_motion now = motion_of(c, island, body);
    sbri_driver_motions(c)[island->bodies[b]] = (sbri_driver_motion){now.velocity, now.angular_velocity};
    for (uint32_t i = 3 * body->slots.begin; i < 3 * body->slots.end; i++)
      velocities[i] = island->scheme->forceless ? velocities[i] - drivers[i] * tick_s : drivers[i];
  }
}

/* Moves the island with its frames and at their velocity. */
static void move_with_frames(sbri_character *c, const sbri_island *island, uint32_t index, float tick_s) {
  sbri_island_move_with_frames(c, index);
  set_driver_velocities(c, island, tick_s);
}

/* A jump of pins relative to each other may leave the body crushed. Number of ticks in which this is checked.
 */
enum { JUMPED_TICKS = 240 };

/* Decay rate of the stored acceleration, 1/s: strain by acceleration lasts for some oscillations. */
static const float FORGOTTEN_PER_S = 3;

static void update_acceleration(sbri_recovery *recovery, float change, float tick_s) {
  float decayed = recovery->acceleration_m_s2 * (1 - fminf(FORGOTTEN_PER_S * tick_s, 1));
  recovery->acceleration_m_s2 = fmaxf(decayed, change / tick_s);
}

/* Whether pin frames move by more than half a cell relative to the body's rigid motion. With two frames, each
 * has half of the displacement. */
static bool have_pins_separated(const sbri_character *c, const sbri_island *island, const sbri_body *body,
    const sbri_rigid_motion *now, float tick_s) {
  const float *drivers = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  float max = 0.5f * island->stability.cell_m / tick_s;
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    const sbri_point *p = &sbri_begins(c)[island->first_slot + slot];
    const float *v = drivers + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 arm = sbri_sub(sbri_vec3(p->x, p->y, p->z), now->center);
    sbf_vec3 relative = sbri_sub(sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]),
        sbri_add(now->velocity, sbri_cross(now->angular_velocity, arm)));
    if (island->masses[slot] > 0 && sbri_dot(relative, relative) > max * max) return true;
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
  if (sbri_driver_velocities_find(c, island, tick_s)) set_driver_velocities(c, island, tick_s);
}

bool sbri_island_update_drivers(sbri_character *c, const sbri_island *island, uint32_t index, float tick_s) {
  if (!sbri_driver_velocities_find(c, island, tick_s)) {
    move_with_frames(c, island, index, tick_s);
    return false;
  }
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbri_driver_motion *motion = &sbri_driver_motions(c)[island->bodies[b]];
    if (!body->is_pinned) continue;
    sbri_rigid_motion now = motion_of(c, island, body);
    limit_acceleration(c, island, body, &now, motion, tick_s);
    update_acceleration(
        &sbri_island_states(c)[index].recovery, velocity_change_of(body, &now, motion, tick_s), tick_s);
    if (body->drivers && island->stability.cell_m > 0 && have_pins_separated(c, island, body, &now, tick_s))
      sbri_island_states(c)[index].recovery.jumped_ticks = JUMPED_TICKS;
    *motion = (sbri_driver_motion){now.velocity, now.angular_velocity};
  }
  return true;
}
