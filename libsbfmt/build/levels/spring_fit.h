/* Fits springs so that they behave like their material: one factor for surface springs and one for interior
 * springs, chosen so that the surface moves like the surface of a lattice of tetrahedra under the same loads;
 * then each spring's own factor (stiffness_descent.h). */
#ifndef SBFI_SPRING_FIT_H
#define SBFI_SPRING_FIT_H

#include "build/levels/stiffness_descent.h"

typedef struct sbfi_spring_factors {
  double surface, inner; /* means over the springs of each kind */
  double min, max;
  /* Relative difference between the displacements of both surfaces, root mean square over the loads: with
   * all factors 1, with two factors, with each spring's own. */
  double before, by_kind, after;
} sbfi_spring_factors;

/* Least squares over the loads, each weighted by the inverse of its squared displacement; the two factors
 * use only the small loads, each spring's own uses all targets. Multiplies the stiffnesses of `statics`,
 * in the order of the level's sets, and refreshes `linear`. False if memory runs out or the build is
 * cancelled. */
bool sbfi_spring_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear,
    const sbfi_target_displacements *target, sbfi_spring_factors *factors, sbfi_progress progress,
    sbfi_arena *scratch);

#endif
