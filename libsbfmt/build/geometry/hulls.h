/* Convex hulls. The only place that knows qhull. */
#ifndef SBFI_HULLS_H
#define SBFI_HULLS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

typedef enum sbfi_hull_outcome {
  SBFI_HULL_MADE,
  SBFI_HULL_FLAT, /* the points lie in a plane, on a line, in one place, or are fewer than four */
  SBFI_HULL_NO_MEMORY
} sbfi_hull_outcome;

/* The convex hull of the points as outward polygons, in memory of `asset`. Triangles in one plane are merged.
 * Points keep their order; each polygon begins with its lowest point, polygons stand in the order of theirs,
 * so that the result does not hang on the order in which qhull found it. Flat means that no point lies
 * farther than 1e-4 of the extent from the plane of three others. */
sbfi_hull_outcome sbfi_hull_make(
    const sbf_vec3 *points, uint32_t count, sbf_asset *asset, sbf_polygon_mesh *hull, sbfi_arena *scratch);

/* Whether the point lies inside the hull or on it. */
bool sbfi_hull_contains(const sbf_polygon_mesh *hull, sbf_vec3 point);

#endif
