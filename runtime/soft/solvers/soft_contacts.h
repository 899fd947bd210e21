/* Sequential contacts of surface samples: self-contacts, contacts with external bodies, and ground and
 * collider contacts of bodies that have either. All others are solved eight at a time
 * (soft/solvers/contact_lanes.h).
 *
 * An impulse at a sample x = sum w_i x_i changes the velocity of point i by w_i / m_i per unit, and the
 * velocity of the sample by the sum of w_i^2 / m_i: the response to a force on the surface.
 *
 * Samples share points, so impulses interact. All impulses of a substep are found by projected Gauss-Seidel
 * over accumulated impulses (E. Catto, Iterative Dynamics with Temporal Coherence, 2005), warm started with
 * those of the previous substep. Warm starting keeps resting bodies still. Friction, restitution and
 * penetration follow contact/contact.h. */
#ifndef SBRI_SOFT_CONTACTS_H
#define SBRI_SOFT_CONTACTS_H

#include "contact/contact.h"
#include "shapes/contact_reports.h"

/* Solves the contacts of a body for the coming substep: changes `velocities` so that no sample passes its
 * plane, and corrects the penetration of deep samples. */
void sbri_soft_contacts_solve(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, const sbri_contact_rule *rule);

/* Sums over the sliding contacts of a body, N s. Contacts count equally where masses are equal. */
typedef struct sbri_sliding {
  float load, limit; /* normal impulses; normal impulses times the friction coefficient */
  sbf_vec3 friction; /* friction impulses of sliding contacts */
} sbri_sliding;
sbri_sliding sbri_soft_contacts_sum_sliding(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule);

/* Moves contact planes with their colliders, at the end of a substep. */
void sbri_soft_contacts_advance(const sbri_island_tick *t, const sbri_body *body, float step_s);

/* Reports the contacts of the body, at the end of a tick. */
void sbri_soft_contacts_report(
    const sbri_island_tick *t, const sbri_body *body, sbri_contact_reports *touching);

/* Call before and after a position correction that changes velocities (soft/solvers/volume_preservation.h).
 * Undoes penetration that the correction has caused, as sbri_contact_bound does for points. */
void sbri_soft_contacts_store(const sbri_island_tick *t, const sbri_body *body);
void sbri_soft_contacts_bound(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule);

#endif
