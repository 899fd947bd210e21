/* Sums in a fixed order: eight partial sums, one per lane, joined as a tree. The order, and so the rounding,
 * does not depend on the SIMD width. */
#ifndef SBRI_REDUCE_H
#define SBRI_REDUCE_H

#include "math/wide.h"

static inline float sbri_tree_sum(const float lanes[SBRI_BLOCK]) {
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

/* Sum of `count` numbers, and the maximum of them (`least` if there are none). */
float sbri_sum(const float *values, size_t count);
float sbri_greatest(const float *values, size_t count, float min);

#endif
