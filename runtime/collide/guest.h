/* Bodies of the host with a mass, as a soft body or a rigid one that touches them sees them through a tick.
 *
 * Characters are stepped beside each other, so each body has a copy of its own of what it touches, which its
 * pushes move in each substep. Where several push the same, each copy has its share of the mass
 * (R. Tonge, F. Benevolenti, A. Voroshilov, Mass Splitting for Jitter-Free Parallel Rigid Body Simulation,
 * 2012), and in place of what the others do the difference between what all have pushed it with in the tick
 * before and what this one had as its share: at rest all copies then stand still, whoever bears how much.
 *
 * The host will move its body by its new velocity for all of the tick: x + T (v + sum J / m). So the copy is,
 * after a time t of the tick, at x + t v(t): a push moves it t times the change of its velocity at once, and
 * it ends the tick where the host will put it. Otherwise what is light on what is stiff would swing up: at
 * more than 16 Hz with 60 ticks a second.
 *
 * Lengths and times are the character's own, masses those of its file. */
#ifndef SBRI_GUEST_H
#define SBRI_GUEST_H

#include "collide/colliders.h"

/* What makes copies: a character's tick, and what the body pushed in the one before. */
typedef struct sbri_guest_maker {
  const sbri_collider_set *colliders;
  sbr_double3 origin; /* m, world */
  float scale, tick_s;
  const sbri_touching_one *before; /* (before_count) */
  uint32_t before_count;
} sbri_guest_maker;

/* A copy of what the collider is part of, which has a mass. */
sbri_guest sbri_guest_make(const sbri_guest_maker *maker, const sbri_collider_frame *frame, uint32_t leader);

/* Which of the body's guests, from 1 on, the collider is of; 0: nothing moves it, or there is no room. */
uint8_t sbri_guest_of(
    sbri_guests *guests, const sbri_guest_maker *maker, const sbri_collider_frame *frame, uint32_t collider);

/* At a substep's beginning, of `step_s`: what moves it besides. */
void sbri_guest_begin(sbri_guest *guest, float step_s);
/* And at its end. */
static inline void sbri_guest_go_on(sbri_guest *g, float step_s) {
  g->begin_velocity = g->velocity, g->begin_spin = g->spin;
  g->elapsed_s += step_s;
}

static inline void sbri_guests_begin(sbri_guests *guests, float step_s) {
  for (uint32_t i = 0; i < guests->count; i++) sbri_guest_begin(&guests->at[i], step_s);
}
static inline void sbri_guests_go_on(sbri_guests *guests, float step_s) {
  for (uint32_t i = 0; i < guests->count; i++) sbri_guest_go_on(&guests->at[i], step_s);
}

/* The square roots of its `ease` and `turn_ease`. */
void sbri_guest_roots(
    const sbri_guest *guest, const sbri_collider *leader, float ease[6], float turn_ease[6]);

static inline sbf_vec3 sbri_guest_times(const float m[6], sbf_vec3 v) {
  return (sbf_vec3){m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
      m[4] * v.x + m[5] * v.y + m[2] * v.z};
}

/* By which it goes at a place `arm` from its centre. */
static inline sbf_vec3 sbri_guest_velocity(const sbri_guest *g, sbf_vec3 arm) {
  return sbri_add(g->seen_velocity, sbri_cross(g->seen_spin, arm));
}

/* By how much an impulse there changes that. */
static inline sbf_vec3 sbri_guest_answer(const sbri_guest *g, sbf_vec3 arm, sbf_vec3 impulse) {
  sbf_vec3 turn = sbri_guest_times(g->turn_ease, sbri_cross(arm, impulse));
  return sbri_scale(sbri_add(sbri_guest_times(g->ease, impulse), sbri_cross(turn, arm)), g->lever);
}

static inline void sbri_guest_push(sbri_guest *g, sbf_vec3 arm, sbf_vec3 impulse) {
  sbf_vec3 faster = sbri_guest_times(g->ease, impulse),
           turn = sbri_guest_times(g->turn_ease, sbri_cross(arm, impulse));
  g->velocity = sbri_add(g->velocity, faster), g->spin = sbri_add(g->spin, turn);
  g->seen_velocity = sbri_add_scaled(g->seen_velocity, faster, g->lever);
  g->seen_spin = sbri_add_scaled(g->seen_spin, turn, g->lever);
}

#endif
