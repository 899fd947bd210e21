/* Pushes that end a substep on what is held: the point goes where its body takes it, but simulated bodies
 * feel it, as they feel forces (reaction.h).
 *
 * A body gives way as a ball of its mass would that turns as easily about every axis as it does about the
 * easiest. So it is never thought to resist more than it does, and pushes that end a motion by this reckoning
 * take energy, however many there are in a substep. */
#ifndef SBRI_HELD_PUSH_H
#define SBRI_HELD_PUSH_H

#include "math/vec3.h"
#include "model/island_tick.h"

/* NULL: a free point, or what holds it feels nothing. */
static inline sbri_reaction *sbri_reaction_at(const sbri_island_tick *t, uint32_t slot) {
  if (!t->reactions || slot < t->island->free_count) return NULL;
  int32_t carrier = t->island->carrier_of_held[slot - t->island->free_count];
  return carrier >= 0 ? &t->reactions[carrier] : NULL;
}

/* Where a slot shall be: what holds it moves, in the step that follows, by its part of what has been moved at
 * once. */
static inline sbf_vec3 sbri_shifted_place(const sbri_island_tick *t, uint32_t slot) {
  const sbri_reaction *r = sbri_reaction_at(t, slot);
  const sbri_point *p = &t->positions[slot];
  sbf_vec3 at = {p->x, p->y, p->z};
  if (!r) return at;
  sbf_vec3 turn = sbri_cross(r->shift_turn, sbri_sub(at, r->about));
  return sbri_add(at, sbri_add_scaled(sbri_scale(r->shift, r->ease), turn, r->inverse_inertia));
}

static inline sbf_vec3 sbri_reaction_arm(const sbri_island_tick *t, const sbri_reaction *r, uint32_t slot) {
  return sbri_sub(sbri_shifted_place(t, slot), r->about);
}

/* d . v of the held point where it is pushed with d, an impulse; 0 of a free one. */
static inline float sbri_held_ease(const sbri_island_tick *t, uint32_t slot, sbf_vec3 d) {
  const sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return 0;
  sbf_vec3 turn = sbri_cross(sbri_reaction_arm(t, r, slot), d);
  return r->ease * sbri_dot(d, d) + r->inverse_inertia * sbri_dot(turn, turn);
}

/* By how much its velocity is to change by all that its body has been pulled with, m/s. */
static inline sbf_vec3 sbri_held_gain(const sbri_island_tick *t, uint32_t slot) {
  const sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return sbri_vec3(0, 0, 0);
  sbf_vec3 turn = sbri_cross(r->moment, sbri_reaction_arm(t, r, slot));
  return sbri_add_scaled(sbri_scale(r->impulse, r->ease), turn, r->inverse_inertia);
}

static inline void sbri_held_push(const sbri_island_tick *t, uint32_t slot, sbf_vec3 impulse) {
  sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return;
  r->moment = sbri_add(r->moment, sbri_cross(sbri_reaction_arm(t, r, slot), impulse));
  r->impulse = sbri_add(r->impulse, impulse);
}

/* The body's part of what has been moved at once, kg m. */
static inline void sbri_held_shift(const sbri_island_tick *t, uint32_t slot, sbf_vec3 shift) {
  sbri_reaction *r = sbri_reaction_at(t, slot);
  if (!r) return;
  sbf_vec3 speed = sbri_add(sbri_slot_velocity(t, t->velocities, slot), sbri_held_gain(t, slot));
  r->shift_turn = sbri_add(r->shift_turn, sbri_cross(sbri_reaction_arm(t, r, slot), shift));
  r->shift = sbri_add(r->shift, shift);
  r->shift_moment = sbri_add(r->shift_moment, sbri_cross(shift, speed));
}

#endif
