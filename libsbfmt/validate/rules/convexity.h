/* Whether a hull is what it should be: a closed convex polyhedron that faces outwards. */
#ifndef SBFI_CONVEXITY_H
#define SBFI_CONVEXITY_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef enum sbfi_hull_fault {
  SBFI_HULL_FAULT_NONE,
  SBFI_HULL_FAULT_OPEN,    /* some edge has not two polygons that pass it in opposite directions */
  SBFI_HULL_FAULT_CONCAVE, /* some point lies outside some face, by more than a thousandth of the hull's size
                            */
  SBFI_HULL_FAULT_MEMORY
} sbfi_hull_fault;

/* Small hulls are compared point by face. Of large ones each face is compared with its neighbours' points:
 * a closed surface that bends outwards at every edge is convex or winds around itself more than once. */
sbfi_hull_fault sbfi_hull_check(const sbf_polygon_mesh *hull, sbfi_arena *scratch);

#endif
