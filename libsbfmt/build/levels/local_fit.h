/* Fits moduli of a coarse lattice element by element, so that its parts do as much work as the same parts of
 * a fine lattice.
 *
 * For given forces work is inversely proportional to the modulus. A part with too little work is too stiff
 * by that ratio, and a new modulus corrects it except for effects of its neighbours. The loads are the
 * pushes of level_loads.h, which stress thin and thick parts alike. This is the numerical coarsening of
 * Kharevych, Mullen, Owhadi and Desbrun (ACM Transactions on Graphics 28 (3), 2009) with work instead of
 * stress, isotropic materials, and smoothing over about three elements. */
#ifndef SBFI_LOCAL_FIT_H
#define SBFI_LOCAL_FIT_H

#include "build/levels/level_loads.h"

typedef struct sbfi_push_works {
  sbfi_level_pushes pushes;
  double totals[SBFI_PUSHES];         /* J, of each push */
  double *fractions;                  /* (level points) their fractions of the totals, over all pushes */
  double *displacements[SBFI_PUSHES]; /* (3 x surface points) m */
} sbfi_push_works;

/* For the reference level; `linear` is of its network. Allocates from `arena`; false if memory runs out or
 * the build is cancelled. */
bool sbfi_push_works_make(sbfi_push_works *works, const sbfi_level_statics *statics,
    sbfi_linear_statics *linear, sbfi_progress progress, sbfi_arena *arena);

/* Multiplies the moduli of `statics`, a level of tetrahedra, by factors between an eighth and two, and
 * refreshes `linear`; `of` is the level of `works`. False if memory runs out or the build is cancelled. */
bool sbfi_local_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear, const sbfi_level_statics *of,
    const sbfi_push_works *works, sbfi_progress progress, sbfi_arena *scratch);

#endif
