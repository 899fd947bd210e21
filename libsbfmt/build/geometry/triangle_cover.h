/* Whether a surface lies over the whole of a triangle. */
#ifndef SBFI_TRIANGLE_COVER_H
#define SBFI_TRIANGLE_COVER_H

#include "build/geometry/triangle_tree.h"

/* Whether triangles of the surface that face as this one does cover all of it, seen along its normal, none of
 * them farther from it there than `most`. What is covered twice is not said to be covered: one part of it
 * could hide a hole in another. */
bool sbfi_triangle_is_covered(const sbfi_triangle_tree *by, const double corners[3][3], double max);

#endif
