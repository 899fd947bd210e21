/* Distance between two surfaces. */
#ifndef SBFI_SURFACE_DISTANCE_H
#define SBFI_SURFACE_DISTANCE_H

#include "base/progress.h"
#include "build/geometry/triangle_tree.h"

/* Hausdorff distance of two surfaces; polygons are fans from their first corner; ignores triangles without
 * area. Never underestimated; overestimated by at most the maximum of 5 per cent, a hundred-thousandth of the
 * surfaces' size, and a hundredth of a triangle's longest edge. 0 if one has no triangles.
 *
 * Triangles are bisected until none can contain a larger distance: the distance from a triangle is convex,
 * so it is largest at a corner; parts that the other surface covers are near it; and no distance grows
 * faster than the position moves. False if `progress` cancels. */
bool sbfi_surface_distance(
    double *distance, const sbfi_triangle_tree *a, const sbfi_triangle_tree *b, sbfi_progress progress);

#endif
