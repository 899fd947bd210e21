/* Damping of bodies that slide.
 *
 * Coulomb friction couples the pressure on a surface with its shear, and this coupling is not symmetric. It
 * excites vibrations of an elastic body that slides, more so for high coefficients of friction and high
 * Poisson's ratios (flutter; J. A. C. Martins, J. Guimaraes, L. O. Faria, Dynamic surface solutions in linear
 * elasticity and viscoelasticity with frictional boundary conditions, 1995). With only the damping of its
 * lowest mode, a block hops down slopes on which it should stick, from a coefficient of 0.8 on.
 *
 * While a solid body without pins slides, its deformation is damped by 2 k mu^2 s w, where w is its lowest
 * frequency, mu the coefficient of friction, k a constant, and s the net sliding friction as a fraction of
 * its maximum. Its rigid motion does not change, so it slides as Coulomb predicts. A body that sticks has s =
 * 0, and so has one that strikes the ground and spreads in all directions. */
#ifndef SBRI_SLIDE_DAMPING_H
#define SBRI_SLIDE_DAMPING_H

#include "contact/contact.h"

/* Applies the damping, after the contacts of a substep. */
void sbri_slide_damp(const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_rule *rule);

#endif
