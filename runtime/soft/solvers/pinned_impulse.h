/* Impulses on pinned points. A pinned point follows its frame, but a simulated rigid body behind the frame
 * receives the impulse (reaction.h).
 *
 * The body responds as a sphere with its mass and its smallest moment of inertia. This never overestimates
 * its resistance, so impulses that stop a motion remove energy, however many there are in a substep. */
#ifndef SBRI_PINNED_IMPULSE_H
#define SBRI_PINNED_IMPULSE_H

#include "math/vec3.h"
#include "model/island_tick.h"

/* The reaction of the rigid body that the slot is pinned to. NULL: the point is free, or its frame is not
 * simulated. */
static inline sbri_reaction *sbri_reaction_at(const sbri_island_tick *t, uint32_t slot) {
  if (!t->reactions || slot < t->island->free_count) return NULL;
  int32_t rigid_body = t->island->pins.rigid_bodies[slot - t->island->free_count];
  return rigid_body >= 0 ? &t->reactions[rigid_body] : NULL;
}

/* Position of a slot after the immediate shifts of its rigid body. */
static inline sbf_vec3 sbri_shifted_position(const sbri_island_tick *t, uint32_t slot) {
  const sbri_reaction *r = sbri_reaction_at(t, slot);
  const sbri_point *p = &t->positions[slot];
  sbf_vec3 at = {p->x, p->y, p->z};
  if (!r) return at;
  sbf_vec3 arm_cross = sbri_cross(r->shift_turn, sbri_sub(at, r->about));
  return sbri_add(at, sbri_add_scaled(sbri_scale(r->shift, r->inverse_mass), arm_cross, r->inverse_inertia));
}

static inline sbf_vec3 sbri_reaction_arm(const sbri_island_tick *t, const sbri_reaction *r, uint32_t slot) {
  return sbri_sub(sbri_shifted_position(t, slot), r->about);
}

/* Inverse effective mass of a pinned point along d (velocity along d per impulse d); 0 for a free point. */
static inline float sbri_pinned_inverse_mass(const sbri_island_tick *t, uint32_t slot, sbf_vec3 d) {
  const sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return 0;
  sbf_vec3 arm_cross = sbri_cross(sbri_reaction_arm(t, r, slot), d);
  return r->inverse_mass * sbri_dot(d, d) + r->inverse_inertia * sbri_dot(arm_cross, arm_cross);
}

/* Velocity change of a pinned point by all impulses on its rigid body, m/s. */
static inline sbf_vec3 sbri_pinned_velocity_change(const sbri_island_tick *t, uint32_t slot) {
  const sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return sbri_vec3(0, 0, 0);
  sbf_vec3 arm_cross = sbri_cross(r->moment, sbri_reaction_arm(t, r, slot));
  return sbri_add_scaled(sbri_scale(r->impulse, r->inverse_mass), arm_cross, r->inverse_inertia);
}

static inline void sbri_pinned_apply_impulse(const sbri_island_tick *t, uint32_t slot, sbf_vec3 impulse) {
  sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return;
  r->moment = sbri_add(r->moment, sbri_cross(sbri_reaction_arm(t, r, slot), impulse));
  r->impulse = sbri_add(r->impulse, impulse);
}

/* Adds the rigid body's part of an immediate shift, kg m. */
static inline void sbri_pinned_apply_shift(const sbri_island_tick *t, uint32_t slot, sbf_vec3 shift) {
  sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return;
  sbf_vec3 speed = sbri_add(sbri_slot_velocity(t, t->velocities, slot), sbri_pinned_velocity_change(t, slot));
  r->shift_turn = sbri_add(r->shift_turn, sbri_cross(sbri_reaction_arm(t, r, slot), shift));
  r->shift = sbri_add(r->shift, shift);
  r->shift_moment = sbri_add(r->shift_moment, sbri_cross(shift, speed));
}

#endif
