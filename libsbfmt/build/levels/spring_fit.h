/* Springs that give as their matter does: two factors, one for the springs over the surface and one for those
 * inside, with which the surface goes where that of a lattice of tetrahedra goes under the same loads. */
#ifndef SBFI_SPRING_FIT_H
#define SBFI_SPRING_FIT_H

#include "build/levels/level_loads.h"

typedef struct sbfi_spring_factors {
  double surface, inner;
  /* Root of the mean over the loads of the square of what is left of the difference between the surfaces, as
   * a share of the displacement; before is that with both factors 1. */
  double before, after;
} sbfi_spring_factors;

/* Least squares over the loads, each weighed by one over its displacement's square. `gives` are the
 * displacements wanted (3 x surface points), NULL: that load does not count. Multiplies the stiffnesses of
 * `statics`, in the order of the level's sets, and refreshes `linear`. False where memory runs out. */
bool sbfi_spring_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear, const double *const *gives,
    sbfi_spring_factors *factors, sbfi_arena *scratch);

#endif
