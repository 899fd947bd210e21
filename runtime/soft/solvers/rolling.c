#include "soft/solvers/rolling.h"

#include "contact/contact.h"
#include "math/trig.h"
#include "math/vec3.h"
#include "soft/solvers/rigid_motion.h"

static const float PI = 3.14159265f;

/* Distance from the ground, as a fraction of the body's size, within which points are in contact. */
static const float TOUCHING_FRACTION = 1e-3f;

float sbri_rolling_fraction(float damping_ratio) {
  return (1 - sbri_exp(-2 * PI * damping_ratio)) * 2 / (3 * PI);
}

/* Contact patch: sum of the normals, and the range of coordinates along a direction. */
typedef struct patch {
  sbf_vec3 normal, along;
  float low, high;
  uint32_t count;
} patch;

static void add_to_patch(patch *p, sbf_vec3 at, sbf_vec3 normal) {
  float coordinate = sbri_dot(p->along, at);
  p->low = p->count == 0 || coordinate < p->low ? coordinate : p->low;
  p->high = p->count == 0 || coordinate > p->high ? coordinate : p->high;
  p->normal = sbri_add(p->normal, normal);
  p->count++;
}

static void add_points(patch *p, const sbri_island_tick *t, const sbri_body *body, float max_separation) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    if (!t->contacts.near_ground[block]) {
      slot = (block + 1) * SBRI_BLOCK - 1;
      continue;
    }
    const float *plane = t->contacts.planes + 4 * SBRI_BLOCK * (size_t)block + lane;
    sbf_vec3 n = {plane[0], plane[SBRI_BLOCK], plane[2 * SBRI_BLOCK]};
    sbf_vec3 at = {t->positions[slot].x, t->positions[slot].y, t->positions[slot].z};
    if (sbri_dot(n, at) - plane[3 * SBRI_BLOCK] <= max_separation) add_to_patch(p, at, n);
  }
}

static patch find_patch(const sbri_island_tick *t, const sbri_body *body, sbf_vec3 along) {
  patch p = {.along = along};
  float max_separation = TOUCHING_FRACTION * body->rest_size_m;
  for (uint32_t i = 0; i < sbri_soft_contact_count(t, body); i++) {
    const sbri_soft_contact *contact = &t->contacts.at[body->contact.first + i];
    if (contact->collider == SBRI_ITSELF) continue;
    sbf_vec3 x = sbri_sample_position(t, &contact->sample);
    if (sbri_dot(contact->normal, x) - contact->offset <= max_separation)
      add_to_patch(&p, x, contact->normal);
  }
  if (!body->contact.samples) add_points(&p, t, body, max_separation);
  return p;
}

static void change_angular_velocity(
    const sbri_island_tick *t, const sbri_body *body, sbf_vec3 center, sbf_vec3 angular_velocity) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    const sbri_point *at = &t->positions[slot];
    float *v = t->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 change = sbri_cross(angular_velocity, sbri_sub(sbri_vec3(at->x, at->y, at->z), center));
    v[0] += change.x, v[SBRI_BLOCK] += change.y, v[2 * SBRI_BLOCK] += change.z;
  }
}

void sbri_rolling_apply_resistance(const sbri_island_tick *t, const sbri_body *body) {
  if (body->is_pinned || !(body->contact.rolling_fraction > 0)) return;
  patch touching = find_patch(t, body, sbri_vec3(0, 0, 0));
  if (touching.count == 0) return;
  sbf_vec3 n = sbri_normalize(touching.normal, sbri_vec3(0, 1, 0));
  sbri_rigid_motion motion = sbri_rigid_motion_find(t->island, body, t->positions, t->velocities);
  sbf_vec3 angular_velocity =
      sbri_add_scaled(motion.angular_velocity, n, -sbri_dot(motion.angular_velocity, n));
  float rate = sbri_length(angular_velocity);
  float weight =
      -sbri_dot(t->environment.gravity, n) * body->source->attributes.gravity_scale * motion.mass_kg;
  if (!(rate > 0) || !(weight > 0)) return;
  sbf_vec3 axis = sbri_scale(angular_velocity, 1 / rate);
  patch wide = find_patch(t, body, sbri_cross(axis, n));
  float moment = body->contact.rolling_fraction * 0.5f * (wide.high - wide.low) * weight;
  float inertia = sbri_inertia_about(motion.inertia, axis);
  float change = inertia > 0 ? moment * t->tick_s / inertia : 0;
  change_angular_velocity(t, body, motion.center, sbri_scale(axis, change < rate ? -change : -rate));
}
