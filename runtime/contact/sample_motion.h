/* Positions and velocities of surface samples from the present points of an island. */
#ifndef SBRI_SAMPLE_MOTION_H
#define SBRI_SAMPLE_MOTION_H

#include "math/vec3.h"
#include "model/island_tick.h"

/* Velocity of a point, m/s; that of a pinned point is towards its target. */
static inline sbf_vec3 sbri_point_velocity(const sbri_island_tick *t, uint32_t slot) {
  if (slot < t->island->free_count) return sbri_slot_velocity(t, t->velocities, slot);
  const sbri_point *from = &t->positions[slot], *to = &t->targets[slot];
  return sbri_scale(sbri_vec3(to->x - from->x, to->y - from->y, to->z - from->z), 1 / t->tick_s);
}

static inline sbf_vec3 sbri_sample_velocity(const sbri_island_tick *t, const sbri_sample *s) {
  sbf_vec3 v = {0, 0, 0};
  for (int k = 0; k < 4; k++) v = sbri_add_scaled(v, sbri_point_velocity(t, s->slots[k]), s->weights[k]);
  return v;
}

/* Gap of a contact at the end of the tick at its present velocity, m; the present gap if it opens. The
 * velocity of an external body counts as 0. */
static inline float sbri_contact_predicted_gap(const sbri_island_tick *t, const sbri_soft_contact *contact) {
  sbf_vec3 n = contact->normal, v = sbri_sample_velocity(t, &contact->sample);
  float gap = sbri_dot(n, sbri_sample_position(t, &contact->sample)) - contact->offset;
  float speed = sbri_dot(n, contact->external_body ? v : sbri_sub(v, contact->velocity));
  return gap + t->tick_s * (speed < 0 ? speed : 0);
}

/* A point of the level as a sample. */
static inline sbri_sample sbri_point_sample(const sbri_island_tick *t, uint32_t slot) {
  return (sbri_sample){{slot, slot, slot, slot}, {1, 0, 0, 0}, t->island->masses[slot], UINT32_MAX};
}

/* A sample with its present points: after a tear it may have other points with other masses. */
static inline sbri_sample sbri_sample_now(
    const sbri_island_tick *t, const sbri_sample *first, const sbri_skin *surface) {
  sbri_sample s = *first;
  if (!t->island->splits) return s;
  if (s.vertex != UINT32_MAX) return sbri_sample_of(t->island, surface, s.vertex);
  s.mass_kg = t->island->masses[s.slots[0]];
  return s;
}

#endif
