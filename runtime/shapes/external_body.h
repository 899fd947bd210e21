/* Bodies of the host with a mass, within a tick of a soft or rigid body in contact with them.
 *
 * Characters are stepped in parallel, so each body has its own copy of the host's bodies that it touches, and
 * its impulses move the copy in each substep. If several bodies touch the same one, each copy has a fraction
 * of the mass (R. Tonge, F. Benevolenti, A. Voroshilov, Mass Splitting for Jitter-Free Parallel Rigid Body
 * Simulation, 2012). The effect of the others is predicted: the total impulse of the last tick minus this
 * copy's own. At rest all copies then stand still, however the load is divided.
 *
 * The host will move its body at the new velocity over the whole tick: x + T (v + sum J / m). So after a time
 * t of the tick the copy is at x + t v(t). An impulse moves it at once by t times its velocity change, and it
 * ends the tick where the host will place it. Otherwise a light body on a stiff one would be unstable, from
 * 16 Hz on at 60 ticks per second.
 *
 * Lengths and times are the character's own, masses those of its file. */
#ifndef SBRI_EXTERNAL_BODY_H
#define SBRI_EXTERNAL_BODY_H

#include "shapes/colliders.h"

/* Input for copies of external bodies: a character's tick and the contacts of the previous one. */
typedef struct sbri_external_body_maker {
  const sbri_collider_set *colliders;
  sbr_double3 origin; /* m, world */
  float scale, tick_s;
  const sbri_contact_report *before; /* (before_count) */
  uint32_t before_count;
} sbri_external_body_maker;

/* Makes a copy of the body that the collider belongs to, which has a mass. */
sbri_external_body sbri_external_body_make(
    const sbri_external_body_maker *maker, const sbri_collider_frame *frame, uint32_t leader);

/* 1-based index of the external body that the collider belongs to; 0: immovable, or no free entry. */
uint8_t sbri_external_body_of(sbri_external_bodies *external_bodies, const sbri_external_body_maker *maker,
    const sbri_collider_frame *frame, uint32_t collider);

/* Begins a substep of `step_s`: applies motion other than by contacts. */
void sbri_external_body_begin(sbri_external_body *external_body, float step_s);
/* Ends the substep. */
static inline void sbri_external_body_end_step(sbri_external_body *g, float step_s) {
  g->begin_velocity = g->velocity, g->begin_angular_velocity = g->angular_velocity;
  g->elapsed_s += step_s;
}

static inline void sbri_external_bodies_begin(sbri_external_bodies *external_bodies, float step_s) {
  for (uint32_t i = 0; i < external_bodies->count; i++)
    sbri_external_body_begin(&external_bodies->at[i], step_s);
}
static inline void sbri_external_bodies_end_step(sbri_external_bodies *external_bodies, float step_s) {
  for (uint32_t i = 0; i < external_bodies->count; i++)
    sbri_external_body_end_step(&external_bodies->at[i], step_s);
}

/* Square roots of `inverse_mass` and `inverse_inertia`. */
void sbri_external_body_compute_roots(const sbri_external_body *external_body, const sbri_collider *leader,
    float inverse_mass[6], float inverse_inertia[6]);

static inline sbf_vec3 sbri_external_body_times(const float m[6], sbf_vec3 v) {
  return (sbf_vec3){m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
      m[4] * v.x + m[5] * v.y + m[2] * v.z};
}

/* Velocity at lever arm `arm` from its centre. */
static inline sbf_vec3 sbri_external_body_velocity(const sbri_external_body *g, sbf_vec3 arm) {
  return sbri_add(g->seen_velocity, sbri_cross(g->seen_angular_velocity, arm));
}

/* Velocity change there by an impulse there. */
static inline sbf_vec3 sbri_external_body_response(
    const sbri_external_body *g, sbf_vec3 arm, sbf_vec3 impulse) {
  sbf_vec3 angular_change = sbri_external_body_times(g->inverse_inertia, sbri_cross(arm, impulse));
  return sbri_scale(
      sbri_add(sbri_external_body_times(g->inverse_mass, impulse), sbri_cross(angular_change, arm)),
      g->lever);
}

static inline void sbri_external_body_apply_impulse(sbri_external_body *g, sbf_vec3 arm, sbf_vec3 impulse) {
  sbf_vec3 velocity_change = sbri_external_body_times(g->inverse_mass, impulse),
           angular_change = sbri_external_body_times(g->inverse_inertia, sbri_cross(arm, impulse));
  g->velocity = sbri_add(g->velocity, velocity_change),
  g->angular_velocity = sbri_add(g->angular_velocity, angular_change);
  g->seen_velocity = sbri_add_scaled(g->seen_velocity, velocity_change, g->lever);
  g->seen_angular_velocity = sbri_add_scaled(g->seen_angular_velocity, angular_change, g->lever);
}

#endif
