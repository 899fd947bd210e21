/* Tetrahedra too stiff for the explicit scheme's budget of SBRI_MAX_SUBSTEPS are stepped as softer ones.
 *
 * The budget bounds the angular frequency w of any mode at w_max = 2 SBRI_MAX_SUBSTEPS / (1.1 tick), 112,000
 * rad/s at 1/60 s. Modes near that deform single elements. A compact body of n elements across then still has
 * its lowest mode at about w_max / n and sags under its weight by g (n / w_max)^2: less than a micrometre. An
 * implicit scheme at a lower cost loses more: its oscillations, its bounce and, unless it iterates to
 * convergence, the balance of its energy.
 *
 * Each element is bounded by itself, so that one sliver does not soften its neighbours: its fastest mode,
 * with its contribution to the mass of its corners, is at most a common cap (Irons and Treharne, A Bound
 * Theorem in Eigenvalues, 1971: no mode of the body is faster than that of its fastest element). The cap is
 * then raised to where the body's fastest mode meets w_max. An element above the cap loses bulk modulus
 * first, down to a Poisson's ratio of 0.35, then both moduli in proportion. */
#ifndef SBRI_SOFTENING_H
#define SBRI_SOFTENING_H

#include "prepare/island_maker.h"

/* The fastest mode at rest, rad/s. `scratch` has 6 doubles per point. */
double sbri_fastest(const sbf_spring_network *network, double *scratch);

/* Softens the moduli of the island's bodies and of `network` if the budget is exceeded and the runtime
 * chooses the scheme, or the substeps of the position-based one; sets softened_shear and softened_bulk.
 * Returns false if memory runs out. */
bool sbri_soften(sbri_island_maker *m, sbf_spring_network *network, double *scratch);

#endif
