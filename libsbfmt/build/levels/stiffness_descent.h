/* Fits each element's own stiffness or modulus so that a surface has given displacements under given loads:
 * if a few springs or coarse tetrahedra represent a material, their required stiffnesses vary much more than
 * one common factor allows.
 *
 * Least squares over the factors' logarithms. The gradient costs one more solution per load: with K u = f
 * and K y = dE/du it is -y K_e u, where K_e is the element's part of K, summed over the loads. Steps are
 * those of resilient backpropagation (Riedmiller and Braun, IEEE International Conference on Neural
 * Networks, 1993), which uses only the signs of the gradient, so that elements of small influence converge
 * too. Keeps the best round. */
#ifndef SBFI_STIFFNESS_DESCENT_H
#define SBFI_STIFFNESS_DESCENT_H

#include "build/levels/level_loads.h"

/* Target displacements of a level (3 x surface points) m, NULL: the load is ignored. */
typedef struct sbfi_target_displacements {
  const double *const *displacements; /* under the small loads of 1 m/s^2, as in sbfi_level_solve_linear */
  const sbfi_level_pushes *pushes;    /* NULL: none */
  const double *const *pushed;        /* (SBFI_PUSHES) under each push */
} sbfi_target_displacements;

/* Bounds of factors. */
typedef struct sbfi_factor_bounds {
  double min, max;
  double max_raise; /* for springs: maximum stiffness per mass of a point, relative to the originally stiffest
                     * point: the highest frequency grows at most by its root */
  double fraction;  /* relative accuracy of displacements */
  uint32_t rounds;  /* fewer with many points, so that no body takes many seconds */
} sbfi_factor_bounds;

/* Remaining relative difference from the targets: root mean square over the loads of the difference
 * integrated over the surface, relative to the target displacements. For the current network; `linear` is
 * up to date. False if memory runs out. */
bool sbfi_stiffness_mismatch(const sbfi_level_statics *statics, sbfi_linear_statics *linear,
    const sbfi_target_displacements *target, double *left, sbfi_arena *scratch);

/* Improves the moduli of `statics`, or the stiffnesses of a level of springs, and refreshes `linear`;
 * factors are relative to `stated` (elements) Pa or N/m. `*left` receives the final mismatch as above.
 * False if memory runs out or the build is cancelled. */
bool sbfi_stiffness_descent(sbfi_level_statics *statics, sbfi_linear_statics *linear, const float *stated,
    const sbfi_target_displacements *target, const sbfi_factor_bounds *bounds, double *left,
    sbfi_progress progress, sbfi_arena *scratch);

#endif
