/* Each spring's own stiffness, so that a surface goes where it is wanted under given loads: where a few
 * springs stand for matter, what each of them has to bear differs by much more than one factor for all can
 * say.
 *
 * Least squares over the factors' logarithms. Their gradient costs one more solution a load: with K u = f and
 * K y = dE/du, it is -k (y along the spring) (u along it), summed over the loads. Steps are those of
 * resilient backpropagation (Riedmiller and Braun, IEEE International Conference on Neural Networks, 1993),
 * which takes the gradient's signs alone, so that springs that matter little find their way as well; the best
 * of all rounds is kept.
 *
 * A factor stays within an eighth and sixteen. No point's springs are raised beyond four times what the most
 * tightly held point for its mass had: the highest frequency then at most doubles, and so do the substeps. */
#ifndef SBFI_SPRING_DESCENT_H
#define SBFI_SPRING_DESCENT_H

#include "build/levels/level_loads.h"

/* What is left of the difference to the displacements wanted, `gives` (loads, 3 x surface points; NULL: that
 * load does not count): root of the mean over the loads of its square's integral over the surface, as a share
 * of that of the displacements wanted. As the network now is; `linear` is up to date. False where memory
 * runs out. */
bool sbfi_spring_mismatch(const sbfi_level_statics *statics, sbfi_linear_statics *linear,
    const double *const *gives, double *left, sbfi_arena *scratch);

/* From the stiffnesses that `statics` has goes on to better ones, and refreshes `linear`; `stated` (springs)
 * N/m are those that factors count from. `*left` as above, in the end. False where memory runs out or the
 * work is ended. */
bool sbfi_spring_descent(sbfi_level_statics *statics, sbfi_linear_statics *linear, const float *stated,
    const double *const *gives, double *left, sbfi_progress progress, sbfi_arena *scratch);

#endif
