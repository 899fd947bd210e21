/* Bodies of the host with a mass, as the hulls of a character's rigid parts push them: rigid_guests.c. */
#ifndef SBRI_RIGID_EXTERNAL_BODIES_H
#define SBRI_RIGID_EXTERNAL_BODIES_H

#include "collide/external_body.h"
#include "rigid/rigid_state.h"

struct sbri_rigid_solving;

/* A copy for one body, which is a leaf of the system. */
typedef struct sbri_rigid_external_body {
  sbri_external_body is;
  int32_t node;         /* that pushes it */
  float roots[2][3][3]; /* of its ease and of its ease of turning */
  double d[6][6];       /* of y, then its factor */
  double c[6][6];       /* (node's x, y) between both, then that behind the factor */
  double b[6], y[6];
  double was[6]; /* y of the pass before */
} sbri_rigid_external_body;

/* Which external body, from 1 on, the collider is of to that body; 0: nothing moves it, or there is no room.
 */
uint32_t sbri_rigid_external_body_of(const sbri_rigid_tick *tick, struct sbri_rigid_solving *work,
    uint32_t body, int32_t node, const sbri_collider_frame *frame, uint32_t collider);

/* 1/kg by which a push along n at its arm changes its velocity. */
float sbri_rigid_external_body_inverse_mass(
    const sbri_rigid_external_body *external_body, sbf_vec3 arm, sbf_vec3 n);

/* Whether it is moved along n by more than half as easily as if nothing held it. */
static inline bool sbri_rigid_external_body_gives(const sbri_rigid_external_body *g, sbf_vec3 n) {
  return sbri_dot(n, sbri_external_body_times(g->is.inverse_mass, n)) > 0.5f * g->is.max_inverse_mass;
}

/* At a step's beginning and, if it is good, its end. */
void sbri_rigid_external_bodies_begin(struct sbri_rigid_solving *work, float step_s);
void sbri_rigid_external_bodies_end_step(struct sbri_rigid_solving *work, float step_s);

/* The system's parts: begin; add a contact with stiffness matrix `w` (kg) at its two lever arms; add an
 * impulse; eliminate into the nodes' d; back-substitute. */
void sbri_rigid_external_bodies_clear(struct sbri_rigid_solving *work);
void sbri_rigid_external_body_couple(
    sbri_rigid_external_body *external_body, sbf_vec3 arm, sbf_vec3 own_arm, double w[3][3]);
void sbri_rigid_external_body_push(sbri_rigid_external_body *external_body, sbf_vec3 arm, sbf_vec3 impulse);
void sbri_rigid_external_bodies_factor(struct sbri_rigid_solving *work);
void sbri_rigid_solve(struct sbri_rigid_solving *work);

/* Change of velocity at its arm, by y. */
sbf_vec3 sbri_rigid_external_body_moved(const sbri_rigid_external_body *external_body, sbf_vec3 arm);

/* Together with the nodes' x: store for the next pass, limit, and the kinetic energy along the search
 * direction. */
void sbri_rigid_external_bodies_note(struct sbri_rigid_solving *work);
void sbri_rigid_external_bodies_hold_back(struct sbri_rigid_solving *work, float fraction);
void sbri_rigid_external_bodies_compute_slope(
    const struct sbri_rigid_solving *work, double *slope, double *rise);

/* Gives them the changes that were solved for. */
void sbri_rigid_external_bodies_take(struct sbri_rigid_solving *work);
/* From here on a push in the step changes their velocities, not where they are. */
void sbri_rigid_external_bodies_update_seen(struct sbri_rigid_solving *work);

#endif
