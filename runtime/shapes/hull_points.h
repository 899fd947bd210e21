/* Convex hull of a point cloud, for hosts that have no faces of a convex shape. */
#ifndef SBRI_HULL_POINTS_H
#define SBRI_HULL_POINTS_H

#include "base/memory.h"
#include "sbfmt/model.h"

enum { SBRI_HULL_VERTICES = 256 };

typedef struct sbri_point_hull {
  sbf_vec3 *vertices; /* points on the hull, rounded to 2^-20 of the largest extent */
  uint32_t *corners;  /* (triangle_count x 3) counter-clockwise seen from outside */
  uint32_t vertex_count, triangle_count;
} sbri_point_hull;

/* Hull of finite points, in any order, with duplicates and interior points. If it has more than
 * SBRI_HULL_VERTICES, those that extend it most are used. There are no triangles if all points are in a
 * plane. Allocated in the arena; returns false if memory runs out. */
bool sbri_hull_of_points(sbri_point_hull *hull, const sbf_vec3 *points, uint32_t count, sbfi_arena *arena);

#endif
