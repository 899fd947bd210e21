/* Solver of contact constraints: velocity of a constraint, response to an impulse, and the solve itself. */
#ifndef SBRI_CONSTRAINT_SOLVER_H
#define SBRI_CONSTRAINT_SOLVER_H

#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"

static inline sbf_vec3 sbri_constraint_side_velocity(const sbri_constraint_side *end) {
  if (end->body)
    return sbri_add(sbri_four_xyz(end->body->velocity),
        sbri_cross(sbri_four_xyz(end->body->angular_velocity), end->lever_arm));
  sbf_vec3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < end->count; k++) {
    const float *v = end->velocities[k];
    sum = sbri_add_scaled(sum, sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]), end->weights[k]);
  }
  return sbri_add_scaled(end->prescribed_velocity, sum, end->velocity_scale);
}

/* Velocity of a relative to b, m/s. */
static inline sbf_vec3 sbri_constraint_velocity(const sbri_contact_constraint *r) {
  return sbri_sub(sbri_constraint_side_velocity(&r->a), sbri_constraint_side_velocity(&r->b));
}

static inline void sbri_constraint_side_apply_impulse(const sbri_constraint_side *end, sbf_vec3 p) {
  sbri_solver_body *m = end->body;
  for (uint32_t k = 0; k < end->count; k++) {
    float *v = end->velocities[k], response = end->point_responses[k];
    v[0] += response * p.x, v[SBRI_BLOCK] += response * p.y, v[2 * SBRI_BLOCK] += response * p.z;
  }
  if (!m) return;
  sbf_vec3 l = sbri_cross(end->lever_arm, p);
  m->velocity = sbri_four_add_scaled(m->velocity, sbri_four_of(p), m->inverse_mass);
  m->angular_velocity = sbri_four_add(m->angular_velocity,
      sbri_four_of(sbri_vec3(
          m->inverse_inertia[0][0] * l.x + m->inverse_inertia[0][1] * l.y + m->inverse_inertia[0][2] * l.z,
          m->inverse_inertia[1][0] * l.x + m->inverse_inertia[1][1] * l.y + m->inverse_inertia[1][2] * l.z,
          m->inverse_inertia[2][0] * l.x + m->inverse_inertia[2][1] * l.y + m->inverse_inertia[2][2] * l.z)));
  m->impulse = sbri_add(m->impulse, p);
  m->angular_impulse = sbri_add(m->angular_impulse, l);
}

/* Applies an impulse to a and its reaction to b, N s. */
static inline void sbri_constraint_apply_impulse(const sbri_contact_constraint *r, sbf_vec3 impulse) {
  sbri_constraint_side_apply_impulse(&r->a, impulse);
  sbri_constraint_side_apply_impulse(&r->b, sbri_scale(impulse, -1));
}

/* Velocity that a contact of rigid bodies still lacks: target minus current velocity, minus what its
 * compliance gives way, m/s. */
static inline sbri_four sbri_rigid_velocity_error(const sbri_contact_constraint *r) {
  const sbri_solver_body *a = r->wide.bodies[0], *b = r->wide.bodies[1];
  sbri_four v = sbri_four_sub(
      a->velocity, b->velocity); /* and the cross products of angular velocity and arm, in yzx order: */
  sbri_four w = sbri_four_sub(sbri_four_mul(a->angular_velocity, r->wide.permuted_arms[0]),
      sbri_four_mul(sbri_four_yzx(a->angular_velocity), r->wide.lever_arms[0]));
  sbri_four u = sbri_four_sub(sbri_four_mul(b->angular_velocity, r->wide.permuted_arms[1]),
      sbri_four_mul(sbri_four_yzx(b->angular_velocity), r->wide.lever_arms[1]));
  sbri_four velocity = sbri_four_add(v, sbri_four_yzx(sbri_four_sub(w, u)));
  return sbri_four_add_scaled(sbri_four_sub(r->wide.target, velocity), r->wide.impulse, -r->compliance);
}

/* ---- active_contacts.c ---- */

/* Finds the change of the impulses, `active.step`, that the contacts that press now need. Does not apply it.
 * All contacts are of rigid bodies. Ends when no residual exceeds `converged_m_s`. Returns the number of its
 * steps. */
int sbri_solve_active_contacts(sbri_contact_constraint *rows, uint32_t count, float converged_m_s);

/* ---- constraint_solver.c ---- */

/* Solves the impulses of all constraints; starts from those already applied. */
void sbri_solve_constraints(sbri_contact_constraint *rows, uint32_t count);

#endif
