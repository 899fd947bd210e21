/* Whether a surface covers a whole triangle. */
#ifndef SBFI_TRIANGLE_COVER_H
#define SBFI_TRIANGLE_COVER_H

#include "build/geometry/triangle_tree.h"

/* Whether triangles of the surface with the same facing cover the whole triangle, seen along its normal,
 * at a distance of at most `max`. Overlapping covers count as not covered: their sum could hide a hole. */
bool sbfi_triangle_is_covered(const sbfi_triangle_tree *by, const double corners[3][3], double max);

#endif
