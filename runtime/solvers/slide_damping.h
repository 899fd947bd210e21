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

/* Applies the damping, after the contacts of a substep. */
void sbri_slide_damp(const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_rule *rule);

#endif
