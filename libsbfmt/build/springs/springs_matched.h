/* Stiffness of a spring network that approximates isotropic material, point by point. */
#ifndef SBFI_SPRINGS_MATCHED_H
#define SBFI_SPRINGS_MATCHED_H

#include "base/memory.h"
#include "base/progress.h"
#include "sbfmt/base.h"

/* A spring of stiffness k, length L and direction n has the energy k L^2 (n.e.n)^2 / 2 at a small strain e;
 * material of volume V with lambda = mu (Poisson's ratio a quarter) has mu V (e:e + (tr e)^2 / 2). The
 * springs at each point get parts w of k L^2 such that the sum of w n (x) n (x) n (x) n is as close as
 * possible to the tensor of the point's volume, in the mean over all strains, with none below a twentieth of
 * its part by length. This is a quadratic problem in which two springs interact by (n.m)^4; it is solved by
 * gradient descent from the parts by length, and the result is scaled to the volume's energy. A spring gets
 * the sum of the parts of its two ends. (Derived here from the sums of sbfmt/mechanics.h; on a body-centred
 * grid it gives the two kinds of edges 0.6 and 0.4 E times the cell, which is exactly isotropic.) Points with
 * more than 64 springs keep the parts by length. A spring shorter than half the mean of its neighbours gets
 * at most the stiffness for that length.
 *
 * `modulus` is E in Pa; `volumes` (point_count) in m^3. Writes `stiffness` (spring_count) in N/m; springs
 * without length get 0. Memory of `arena`; returns false if it runs out or `progress` ends it. */
bool sbfi_springs_matched(double modulus, const sbf_vec3 *positions, uint32_t point_count,
    const float *volumes, const sbf_uint2 *ends, uint32_t spring_count, float *stiffness,
    sbfi_progress progress, sbfi_arena *arena);

#endif
