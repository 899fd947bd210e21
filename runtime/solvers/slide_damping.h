/* Damping of bodies that slide.
 *
 * Coulomb friction couples the pressure on a surface with its shear, and this coupling is not symmetric: it
 * feeds vibrations of an elastic body that slides, more so for high coefficients of friction and high
 * Poisson's ratios (flutter; J. A. C. Martins, J. Guimaraes, L. O. Faria, Dynamic surface solutions in linear
 * elasticity and viscoelasticity with frictional boundary conditions, 1995). Without more damping than that
 * of the lowest mode, a block hops down slopes that should hold it, from a coefficient of 0.8 on.
 *
 * While a solid body that nothing holds slides, its deformation is damped by 2 k mu^2 s w: w its lowest
 * frequency, mu the coefficient of friction, s the friction that slides in one direction over the most there
 * could be, k a constant. Its rigid motion stays as it is, so that it slides as Coulomb says. A body that
 * sticks, and one that strikes the ground and spreads there in all directions, has s = 0. */
#ifndef SBRI_SLIDE_DAMPING_H
#define SBRI_SLIDE_DAMPING_H

#include "contact/contact.h"

/* Finds the rate of the damping from the contacts of a substep, into tick->slide_rates. */
void sbri_slide_damping_find(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_rule *rule);

static inline bool sbri_is_slide_damped(const sbri_island_tick *tick, const sbri_body *body) {
  return tick->slide_rates && tick->slide_rates[body - tick->model->bodies] > 0;
}

/* Damps `velocities` by the rate of the substep before, between the forces and the contacts of a substep: a
 * symplectic step whose velocities are damped after the positions moved is stable for half the stiffness. */
void sbri_slide_damp(const sbri_island_tick *tick, const sbri_body *body, float *velocities, float step_s);

#endif
