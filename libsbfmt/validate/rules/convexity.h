/* Checks that a hull is a closed convex polyhedron that faces outwards. */
#ifndef SBFI_CONVEXITY_H
#define SBFI_CONVEXITY_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef enum sbfi_hull_fault {
  SBFI_HULL_FAULT_NONE,
  SBFI_HULL_FAULT_OPEN, /* an edge does not have exactly two polygons that traverse it in opposite directions
                         */
  SBFI_HULL_FAULT_CONCAVE, /* a point is outside a face by more than a thousandth of the hull's size */
  SBFI_HULL_FAULT_MEMORY
} sbfi_hull_fault;

/* Compares all points and faces of small hulls. For large hulls compares each face with its neighbours'
 * points only: a closed surface that is convex at every edge is convex or winds around itself more than
 * once. */
sbfi_hull_fault sbfi_hull_check(const sbf_polygon_mesh *hull, sbfi_arena *scratch);

#endif
