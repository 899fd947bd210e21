/* Fallback for bodies that no scheme can step: moves them rigidly, see soft/recovery.c.
 *
 * Pinned bodies follow their pin frames. Loose bodies fall and rotate freely. If a point gets below a contact
 * plane, the body is moved back onto it and loses its velocity into the plane, the friction part of its
 * tangential velocity (Coulomb), and all of its angular velocity. */
#include "math/quat.h"
#include "math/vec3.h"
#include "soft/solvers/rigid_motion.h"
#include "soft/solvers/scheme.h"

enum { STEPS = 8 };

static float *velocity_at(const sbri_island_tick *t, uint32_t slot) {
  return t->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

static sbf_vec3 position_of(const sbri_island_tick *t, uint32_t slot) {
  return sbri_vec3(t->positions[slot].x, t->positions[slot].y, t->positions[slot].z);
}

static void set_position(const sbri_island_tick *t, uint32_t slot, sbf_vec3 x) {
  t->positions[slot] = (sbri_point){x.x, x.y, x.z, 0};
}

static void follow_drivers(const sbri_island_tick *t, const sbri_body *body) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    const float *drivers = t->driver_velocities + (velocity_at(t, slot) - t->velocities);
    float *v = velocity_at(t, slot);
    for (uint32_t k = 0; k < 3 * SBRI_BLOCK; k += SBRI_BLOCK) v[k] = drivers[k];
    set_position(t, slot,
        sbri_add_scaled(position_of(t, slot), sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]), t->tick_s));
  }
}

/* Resolves one point below its plane; adds the penetration correction of the body to `correction`. */
static void resolve_penetration(
    sbri_rigid_motion *motion, sbf_vec3 *correction, sbf_vec3 normal, float depth, float friction) {
  depth -= sbri_dot(*correction, normal);
  if (!(depth > 0)) return;
  *correction = sbri_add_scaled(*correction, normal, depth);
  float speed = sbri_dot(motion->velocity, normal);
  if (!(speed < 0)) return;
  sbf_vec3 tangential = sbri_add_scaled(motion->velocity, normal, -speed);
  float size = sbri_length(tangential), max = -speed * friction;
  motion->velocity = sbri_scale(tangential, size > max ? 1 - max / size : 0);
  motion->angular_velocity = sbri_vec3(0, 0, 0);
}

static void resolve_planes(
    const sbri_island_tick *t, const sbri_body *body, sbri_rigid_motion *motion, sbf_vec3 *correction) {
  for (uint32_t slot = body->slots.begin; !body->contact.samples && slot < body->slots.real_end; slot++) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    if (!t->contacts.near_ground[block]) continue;
    const float *plane = t->contacts.planes + 4 * SBRI_BLOCK * (size_t)block + lane;
    sbf_vec3 n = {plane[0], plane[SBRI_BLOCK], plane[2 * SBRI_BLOCK]};
    resolve_penetration(motion, correction, n, plane[3 * SBRI_BLOCK] - sbri_dot(n, position_of(t, slot)),
        body->contact.friction);
  }
  for (uint32_t i = 0; i < sbri_soft_contact_count(t, body); i++) {
    const sbri_soft_contact *contact = &t->contacts.at[body->contact.first + i];
    if (contact->collider == SBRI_ITSELF) continue;
    float depth = contact->offset - sbri_dot(contact->normal, sbri_sample_position(t, &contact->sample));
    resolve_penetration(
        motion, correction, contact->normal, depth, body->contact.friction * contact->friction_scale);
  }
}

static void integrate(const sbri_island_tick *t, const sbri_body *body, sbri_rigid_motion *motion, float h) {
  float rate = sbri_length(motion->angular_velocity), sine, cosine;
  sbri_sincos(0.5f * rate * h, &sine, &cosine);
  sbf_vec3 axis = sbri_scale(motion->angular_velocity, rate > 0 ? sine / rate : 0);
  sbf_quat rotation = {axis.x, axis.y, axis.z, cosine};
  sbf_vec3 to = sbri_add_scaled(motion->center, motion->velocity, h);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++)
    set_position(
        t, slot, sbri_add(to, sbri_rotate(rotation, sbri_sub(position_of(t, slot), motion->center))));
  motion->center = to;
}

static void move_loose(const sbri_island_tick *t, const sbri_body *body) {
  float h = t->tick_s / STEPS;
  sbri_rigid_motion motion = sbri_rigid_motion_find(t->island, body, t->positions, t->velocities);
  for (int s = 0; s < STEPS; s++) {
    sbf_vec3 correction = {0, 0, 0};
    motion.velocity =
        sbri_add_scaled(motion.velocity, t->environment.gravity, h * body->source->attributes.gravity_scale);
    integrate(t, body, &motion, h);
    resolve_planes(t, body, &motion, &correction);
    motion.center = sbri_add(motion.center, correction);
    for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++)
      set_position(t, slot, sbri_add(position_of(t, slot), correction));
  }
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    sbf_vec3 arm = sbri_sub(position_of(t, slot), motion.center);
    sbf_vec3 velocity = sbri_add(motion.velocity, sbri_cross(motion.angular_velocity, arm));
    float *v = velocity_at(t, slot);
    v[0] = velocity.x, v[SBRI_BLOCK] = velocity.y, v[2 * SBRI_BLOCK] = velocity.z;
  }
}

static void tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[island->bodies[b]];
    if (body->slots.begin == body->slots.end) continue;
    if (body->is_pinned)
      follow_drivers(t, body);
    else
      move_loose(t, body);
  }
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++)
    t->positions[slot] = t->targets[slot];
  *t->springs.stretch = island->springs.rest_stretch, *t->solids.stiffening = 1, *t->solids.min_ratio = 1;
}

const sbri_scheme sbri_rigid_shape = {.kind = SBF_SCHEME_AUTOMATIC, .tick = tick};
