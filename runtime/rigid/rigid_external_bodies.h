/* Bodies of the host with a mass, in contact with hulls of a character: rigid_external_bodies.c. */
#ifndef SBRI_RIGID_EXTERNAL_BODIES_H
#define SBRI_RIGID_EXTERNAL_BODIES_H

#include "rigid/rigid_state.h"
#include "shapes/external_body.h"

struct sbri_rigid_solving;

/* A copy for one body, which is a leaf of the system. */
typedef struct sbri_rigid_external_body {
  sbri_external_body is;
  int32_t node;         /* node of the body in contact */
  float roots[2][3][3]; /* of its inverse mass and inverse inertia */
  double d[6][6];       /* of y, then its factor */
  double c[6][6];       /* coupling of node's x and y, then its product with the factor */
  double b[6], y[6];
  double was[6]; /* y of the previous iteration */
} sbri_rigid_external_body;

/* 1-based index of the collider's external body for that body; 0: immovable, or no free entry. */
uint32_t sbri_rigid_external_body_of(const sbri_rigid_tick *tick, struct sbri_rigid_solving *work,
    uint32_t body, int32_t node, const sbri_collider_frame *frame, uint32_t collider);

/* Inverse effective mass along n at a lever arm, 1/kg. */
float sbri_rigid_external_body_inverse_mass(
    const sbri_rigid_external_body *external_body, sbf_vec3 arm, sbf_vec3 n);

/* Whether the host's constraints leave it at least half of its mobility along n. */
static inline bool sbri_rigid_external_body_is_mobile(const sbri_rigid_external_body *g, sbf_vec3 n) {
  return sbri_dot(n, sbri_external_body_times(g->is.inverse_mass, n)) > 0.5f * g->is.max_inverse_mass;
}

/* Call at the beginning of a step, and at its end if the step is accepted. */
void sbri_rigid_external_bodies_begin(struct sbri_rigid_solving *work, float step_s);
void sbri_rigid_external_bodies_end_step(struct sbri_rigid_solving *work, float step_s);

/* The system's parts: begin; add a contact with stiffness matrix `w` (kg) at its two lever arms; add an
 * impulse; eliminate into the nodes' d; back-substitute. */
void sbri_rigid_external_bodies_clear(struct sbri_rigid_solving *work);
void sbri_rigid_external_body_couple(
    sbri_rigid_external_body *external_body, sbf_vec3 arm, sbf_vec3 own_arm, double w[3][3]);
void sbri_rigid_external_body_apply_impulse(
    sbri_rigid_external_body *external_body, sbf_vec3 arm, sbf_vec3 impulse);
void sbri_rigid_external_bodies_factor(struct sbri_rigid_solving *work);
void sbri_rigid_solve(struct sbri_rigid_solving *work);

/* Velocity change at a lever arm, by y. */
sbf_vec3 sbri_rigid_external_body_velocity_change(
    const sbri_rigid_external_body *external_body, sbf_vec3 arm);

/* Together with the nodes' x: store for the next pass, limit, and the kinetic energy along the search
 * direction. */
void sbri_rigid_external_bodies_store_solution(struct sbri_rigid_solving *work);
void sbri_rigid_external_bodies_scale_back(struct sbri_rigid_solving *work, float fraction);
void sbri_rigid_external_bodies_compute_slope(
    const struct sbri_rigid_solving *work, double *slope, double *rise);

/* Applies the solved velocity changes. */
void sbri_rigid_external_bodies_apply_solution(struct sbri_rigid_solving *work);
/* From here on an impulse in the step changes velocities, not positions. */
void sbri_rigid_external_bodies_update_seen(struct sbri_rigid_solving *work);

#endif
