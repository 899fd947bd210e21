/* Convex hulls. The only user of qhull. */
#ifndef SBFI_HULLS_H
#define SBFI_HULLS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

typedef enum sbfi_hull_outcome {
  SBFI_HULL_MADE,
  SBFI_HULL_FLAT, /* the points are in a plane, on a line, at one position, or fewer than four */
  SBFI_HULL_NO_MEMORY
} sbfi_hull_outcome;

/* Convex hull of the points as outward polygons, owned by `asset`. Merges coplanar triangles. Points keep
 * their order; each polygon begins with its lowest point, and polygons are sorted by those, so that the
 * result does not depend on qhull's order. Flat means that no point is farther than 1e-4 of the extent
 * from the plane of three others. */
sbfi_hull_outcome sbfi_hull_make(
    const sbf_vec3 *points, uint32_t count, sbf_asset *asset, sbf_polygon_mesh *hull, sbfi_arena *scratch);

/* Whether the point is inside or on the hull. */
bool sbfi_hull_contains(const sbf_polygon_mesh *hull, sbf_vec3 point);

#endif
