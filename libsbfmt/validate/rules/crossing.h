/* Finds self-intersections of a surface. */
#ifndef SBFI_CROSSING_H
#define SBFI_CROSSING_H

#include "build/geometry/triangle_tree.h"

/* For each polygon (polygon_count) the lowest-numbered later one that it intersects, SBFI_NO_CROSSING if
 * none. Polygons are fans from their first corner. An intersection requires an edge of one to pass
 * strictly through the interior of the other: surfaces in contact or in one plane do not intersect. On a
 * very crowded surface the search is incomplete, but all reported intersections are real. False if memory
 * runs out. */
#define SBFI_NO_CROSSING UINT32_MAX
bool sbfi_crossings_find(const sbf_polygon_mesh *mesh, uint32_t *partners, sbfi_arena *scratch);

/* Whether a point is inside a closed surface: a ray from it hits an odd number of triangles. */
bool sbfi_surface_encloses(const sbfi_triangle_tree *tree, sbf_vec3 position);

#endif
