/* Each element's own stiffness or modulus, so that a surface goes where it is wanted under given loads: where
 * a few springs or coarse tetrahedra stand for matter, what each of them has to bear differs by much more
 * than one factor for all can say.
 *
 * Least squares over the factors' logarithms. Their gradient costs one more solution a load: with K u = f and
 * K y = dE/du, it is -y K_e u, K_e the element's own part of K, summed over the loads. Steps are those of
 * resilient backpropagation (Riedmiller and Braun, IEEE International Conference on Neural Networks, 1993),
 * which takes the gradient's signs alone, so that elements that matter little find their way as well; the
 * best of all rounds is kept. */
#ifndef SBFI_STIFFNESS_DESCENT_H
#define SBFI_STIFFNESS_DESCENT_H

#include "build/levels/level_loads.h"

/* What is wanted of a level: displacements (3 x surface points) m, NULL: that load does not count. */
typedef struct sbfi_wanted {
  const double *const *gives;      /* under the small loads of 1 m/s^2, as sbfi_level_lean gives them */
  const sbfi_level_pushes *pushes; /* NULL: none are given */
  const double *const *pushed;     /* (SBFI_PUSHES) under each of them */
} sbfi_wanted;

/* How far factors may go. */
typedef struct sbfi_factor_bounds {
  double min, max;
  double max_raise; /* of springs: none holds a point by more than this many times what the most tightly held
                        point for its mass was: the highest frequency grows by its root at most */
  double fraction;  /* displacements are solved right to that */
  uint32_t rounds;  /* fewer of them where there are many points, that no body takes many seconds */
} sbfi_factor_bounds;

/* What is left of the difference to what is wanted: root of the mean over the loads of its square's integral
 * over the surface, as a share of that of the displacements wanted. As the network now is; `linear` is up to
 * date. False where memory runs out. */
bool sbfi_stiffness_mismatch(const sbfi_level_statics *statics, sbfi_linear_statics *linear,
    const sbfi_wanted *wanted, double *left, sbfi_arena *scratch);

/* From the moduli that `statics` has, or of a level of springs the stiffnesses, goes on to better ones, and
 * refreshes `linear`; `stated` (elements) Pa or N/m are those that factors count from. `*left` as above, in
 * the end. False where memory runs out or the work is ended. */
bool sbfi_stiffness_descent(sbfi_level_statics *statics, sbfi_linear_statics *linear, const float *stated,
    const sbfi_wanted *wanted, const sbfi_factor_bounds *bounds, double *left, sbfi_progress progress,
    sbfi_arena *scratch);

#endif
