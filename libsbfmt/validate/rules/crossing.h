/* Where a surface passes through itself. */
#ifndef SBFI_CROSSING_H
#define SBFI_CROSSING_H

#include "build/geometry/triangle_tree.h"

/* For each polygon the lowest-numbered other one behind it that it passes through, SBFI_NO_CROSSING where
 * there is none (polygon_count). Polygons count as fans from their first corner. Passing through means that a
 * side of one goes from one side of the other to the other side, strictly and inside it: surfaces that touch,
 * or lie in one plane, do not cross. A surface so crowded that boxes overlap without end is looked at in
 * part; what is reported is true all the same. False where memory runs out. */
#define SBFI_NO_CROSSING UINT32_MAX
bool sbfi_crossings_find(const sbf_polygon_mesh *mesh, uint32_t *partners, sbfi_arena *scratch);

/* Whether a place lies inside a closed surface: an odd number of triangles lie on a ray from it. */
bool sbfi_surface_encloses(const sbfi_triangle_tree *tree, sbf_vec3 position);

#endif
