/* Stiffness of a network of springs that stands for isotropic matter, point by point. */
#ifndef SBFI_SPRINGS_MATCHED_H
#define SBFI_SPRINGS_MATCHED_H

#include "base/memory.h"
#include "base/progress.h"
#include "sbfmt/base.h"

/* A spring of stiffness k, length L and direction n answers the small strain e with k L^2 (n.e.n)^2 / 2;
 * matter of volume V with lambda = mu (Poisson's ratio a quarter) with mu V (e:e + (tr e)^2 / 2). The springs
 * at each point are given parts w of k L^2 so that the sum of w n (x) n (x) n (x) n comes as near as it can
 * to what the point's volume asks for, in the mean over all strains, none below a twentieth of its share by
 * length: a quadratic problem in which two springs meet as (n.m)^4, solved by steps downhill from the shares
 * by length, and then scaled to the volume's energy. A spring has the sum of what its two ends give it.
 * (Worked out here, from the sums of sbfmt/mechanics.h; on a body-centred grid it gives the two kinds of
 * edges 0.6 and 0.4 E times the cell, which is isotropic to the last digit.) Points of more than 64 springs
 * keep the shares by length. A spring shorter than half the mean of its neighbours is made no stiffer than
 * one of that length.
 *
 * `modulus` is E in Pa; `volumes` (point_count) in m^3. Writes `stiffness` (spring_count) in N/m; springs
 * without length get 0. Memory of `arena`; false where it runs out or `progress` ends it. */
bool sbfi_springs_matched(double modulus, const sbf_vec3 *positions, uint32_t point_count,
    const float *volumes, const sbf_uint2 *ends, uint32_t spring_count, float *stiffness,
    sbfi_progress progress, sbfi_arena *arena);

#endif
