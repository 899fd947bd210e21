/* How far two surfaces are from each other. */
#ifndef SBFI_SURFACE_DISTANCE_H
#define SBFI_SURFACE_DISTANCE_H

#include "base/progress.h"
#include "build/geometry/triangle_tree.h"

/* Hausdorff's distance of the two surfaces, each polygon a fan from its first corner: no place of either is
 * farther from the other,
 * triangles without area left out. Never understated; overstated by 5 per cent, by a hundred-thousandth of
 * the surfaces' size, or by a hundredth of a triangle's longest side, whichever is most. 0 where one has no
 * triangles.
 *
 * Triangles are halved along their sides until none can hold a greater distance: the distance from a triangle
 * is convex, so that it is greatest in a corner, what the other surface covers is near it, and no distance
 * grows faster than the place moves. * False where `progress` ends it. */
bool sbfi_surface_distance(
    double *distance, const sbfi_triangle_tree *a, const sbfi_triangle_tree *b, sbfi_progress progress);

#endif
