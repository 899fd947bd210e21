/* Moduli of a coarse lattice, element by element, with which its parts take as much work as the same parts of
 * a fine lattice do.
 *
 * Where forces are given, work goes with one over the modulus: so a part that takes less than it should is
 * too stiff by that much, and another modulus puts it right but for what its neighbours change. Loads are the
 * pushes of level_loads.h, under which thin parts are stressed as well as thick ones. It is the numerical
 * coarsening of Kharevych, Mullen, Owhadi and Desbrun (ACM Transactions on Graphics 28 (3), 2009) by works
 * instead of stresses, with isotropic matter, and smoothed over three elements or so. */
#ifndef SBFI_LOCAL_FIT_H
#define SBFI_LOCAL_FIT_H

#include "build/levels/level_loads.h"

typedef struct sbfi_push_works {
  sbfi_level_pushes pushes;
  double totals[SBFI_PUSHES]; /* J, of each push */
  double *fractions;          /* (level points) their parts of the totals, all pushes together */
  double *gives[SBFI_PUSHES]; /* (3 x surface points) m */
} sbfi_push_works;

/* Of the level that is the model; `linear` is of its network. Memory of `arena`; false where it runs out
 * or the work is ended. */
bool sbfi_push_works_make(sbfi_push_works *works, const sbfi_level_statics *statics,
    sbfi_linear_statics *linear, sbfi_progress progress, sbfi_arena *arena);

/* Multiplies the moduli of `statics`, a level of tetrahedra, by factors between an eighth and two, and
 * refreshes `linear`; `of` is the level that `works` were found of. False where memory runs out or the work
 * is ended. */
bool sbfi_local_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear, const sbfi_level_statics *of,
    const sbfi_push_works *works, sbfi_progress progress, sbfi_arena *scratch);

#endif
