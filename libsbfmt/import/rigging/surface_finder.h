/* Finds the nearest location on a surface, optionally with a given direction. */
#ifndef SBFI_SURFACE_FINDER_H
#define SBFI_SURFACE_FINDER_H

#include "build/geometry/triangle_tree.h"
#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

/* Directions within an angle of an axis: those of all normals in a node of a tree. */
typedef struct sbfi_normal_cone {
  sbfi_d3 axis;
  double cosine; /* -1: all directions; never between that and 0 */
  bool is_empty; /* no normals */
} sbfi_normal_cone;

typedef struct sbfi_surface_finder {
  const sbfi_scene_surface *surface;
  sbfi_triangle_tree tree;
  sbfi_normal_cone *cones; /* (tree.tree.node_count) */
} sbfi_surface_finder;

typedef struct sbfi_surface_location {
  uint32_t points[3];
  double weights[3]; /* of these points, summing to 1 */
  double distance;
} sbfi_surface_location;

/* `surface` must outlive it. False if memory runs out. */
bool sbfi_surface_finder_make(
    sbfi_surface_finder *finder, const sbfi_scene_surface *surface, sbfi_arena *arena);

/* Cone around two others. */
sbfi_normal_cone sbfi_normal_cone_join(const sbfi_normal_cone *a, const sbfi_normal_cone *b);
/* Whether the cone may hold a direction less than 60 degrees from a unit vector. */
bool sbfi_normal_cone_may_face(const sbfi_normal_cone *cone, sbfi_d3 normal);

/* Nearest location within a distance; with a `normal` (unit length) the nearest whose normal is less than
 * 60 degrees from it. False if there is none. */
bool sbfi_surface_nearest(const sbfi_surface_finder *finder, sbfi_d3 position, const sbfi_d3 *normal,
    double within, sbfi_surface_location *found);

sbfi_d3 sbfi_surface_point(const sbfi_scene_surface *surface, const sbfi_surface_location *location);
sbfi_d3 sbfi_surface_normal(const sbfi_scene_surface *surface, const sbfi_surface_location *location);

#endif
