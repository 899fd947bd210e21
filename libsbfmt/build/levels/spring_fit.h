/* Springs that give as their matter does: two factors, one for the springs over the surface and one for those
 * inside, with which the surface goes where that of a lattice of tetrahedra goes under the same loads; and
 * from there on each spring's own (stiffness_descent.h). */
#ifndef SBFI_SPRING_FIT_H
#define SBFI_SPRING_FIT_H

#include "build/levels/stiffness_descent.h"

typedef struct sbfi_spring_factors {
  double surface, inner; /* means over the springs of either kind */
  double min, max;
  /* Root of the mean over the loads of the square of what is left of the difference between the surfaces, as
   * a share of the displacement; with all factors 1, with two, with each spring's own. */
  double before, by_kind, after;
} sbfi_spring_factors;

/* Least squares over the loads, each weighed by one over its displacement's square; the two factors by the
 * small loads alone, each spring's own by all that is wanted. Multiplies the stiffnesses of
 * `statics`, in the order of the level's sets, and refreshes `linear`. False where memory runs out or the
 * work is ended. */
bool sbfi_spring_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear, const sbfi_wanted *wanted,
    sbfi_spring_factors *factors, sbfi_progress progress, sbfi_arena *scratch);

#endif
