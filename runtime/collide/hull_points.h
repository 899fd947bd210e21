/* The convex hull of a cloud of points, for hosts that know no more of a convex shape. */
#ifndef SBRI_HULL_POINTS_H
#define SBRI_HULL_POINTS_H

#include "base/memory.h"
#include "sbfmt/model.h"

enum { SBRI_HULL_VERTICES = 256 };

typedef struct sbri_point_hull {
  sbf_vec3 *vertices; /* the points on it, rounded by a 2^21st of the largest extent at most */
  uint32_t *corners;  /* (triangle_count x 3) counter-clockwise seen from outside */
  uint32_t vertex_count, triangle_count;
} sbri_point_hull;

/* Of finite points, in any order, repeated or inside as they may be. Of more than SBRI_HULL_VERTICES those
 * that stand out the furthest. No triangles where all points lie in a plane. Made in the arena; false where
 * memory runs out. */
bool sbri_hull_of_points(sbri_point_hull *hull, const sbf_vec3 *points, uint32_t count, sbfi_arena *arena);

#endif
