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
#ifndef SBRI_EXTERNAL_BODY_H
#define SBRI_EXTERNAL_BODY_H

#include "collide/colliders.h"

/* What makes copies: a character's tick, and what the body pushed in the one before. */
typedef struct sbri_external_body_maker {
  const sbri_collider_set *colliders;
  sbr_double3 origin; /* m, world */
  float scale, tick_s;
  const sbri_touching_one *before; /* (before_count) */
  uint32_t before_count;
} sbri_external_body_maker;

/* A copy of what the collider is part of, which has a mass. */
sbri_external_body sbri_external_body_make(
    const sbri_external_body_maker *maker, const sbri_collider_frame *frame, uint32_t leader);

/* Which of the body's external bodies, from 1 on, the collider is of; 0: nothing moves it, or there is no
 * room. */
uint8_t sbri_external_body_of(sbri_external_bodies *external_bodies, const sbri_external_body_maker *maker,
    const sbri_collider_frame *frame, uint32_t collider);

/* At a substep's beginning, of `step_s`: what moves it besides. */
void sbri_external_body_begin(sbri_external_body *external_body, float step_s);
/* And at its end. */
static inline void sbri_external_body_go_on(sbri_external_body *g, float step_s) {
  g->begin_velocity = g->velocity, g->begin_spin = g->spin;
  g->elapsed_s += step_s;
}

static inline void sbri_external_bodies_begin(sbri_external_bodies *external_bodies, float step_s) {
  for (uint32_t i = 0; i < external_bodies->count; i++)
    sbri_external_body_begin(&external_bodies->at[i], step_s);
}
static inline void sbri_external_bodies_go_on(sbri_external_bodies *external_bodies, float step_s) {
  for (uint32_t i = 0; i < external_bodies->count; i++)
    sbri_external_body_go_on(&external_bodies->at[i], step_s);
}

/* The square roots of its `ease` and `inverse_inertia`. */
void sbri_external_body_roots(const sbri_external_body *external_body, const sbri_collider *leader,
    float ease[6], float inverse_inertia[6]);

static inline sbf_vec3 sbri_external_body_times(const float m[6], sbf_vec3 v) {
  return (sbf_vec3){m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
      m[4] * v.x + m[5] * v.y + m[2] * v.z};
}

/* By which it goes at a place `arm` from its centre. */
static inline sbf_vec3 sbri_external_body_velocity(const sbri_external_body *g, sbf_vec3 arm) {
  return sbri_add(g->seen_velocity, sbri_cross(g->seen_spin, arm));
}

/* By how much an impulse there changes that. */
static inline sbf_vec3 sbri_external_body_answer(
    const sbri_external_body *g, sbf_vec3 arm, sbf_vec3 impulse) {
  sbf_vec3 turn = sbri_external_body_times(g->inverse_inertia, sbri_cross(arm, impulse));
  return sbri_scale(sbri_add(sbri_external_body_times(g->ease, impulse), sbri_cross(turn, arm)), g->lever);
}

static inline void sbri_external_body_push(sbri_external_body *g, sbf_vec3 arm, sbf_vec3 impulse) {
  sbf_vec3 faster = sbri_external_body_times(g->ease, impulse),
           turn = sbri_external_body_times(g->inverse_inertia, sbri_cross(arm, impulse));
  g->velocity = sbri_add(g->velocity, faster), g->spin = sbri_add(g->spin, turn);
  g->seen_velocity = sbri_add_scaled(g->seen_velocity, faster, g->lever);
  g->seen_spin = sbri_add_scaled(g->seen_spin, turn, g->lever);
}

#endif
