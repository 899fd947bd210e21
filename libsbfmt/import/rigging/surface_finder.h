/* Finds the nearest location on a surface, optionally with a given direction. */
#ifndef SBFI_SURFACE_FINDER_H
#define SBFI_SURFACE_FINDER_H

#include "build/geometry/triangle_tree.h"
#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

typedef struct sbfi_surface_finder {
  const sbfi_scene_surface *surface;
  sbfi_triangle_tree tree;
} sbfi_surface_finder;

typedef struct sbfi_surface_location {
  uint32_t points[3];
  double weights[3]; /* of these points, summing to 1 */
  double distance;
} sbfi_surface_location;

/* `surface` must outlive it. False if memory runs out. */
bool sbfi_surface_finder_make(
    sbfi_surface_finder *finder, const sbfi_scene_surface *surface, sbfi_arena *arena);

/* Nearest location within a distance; with a `normal` (unit length) the nearest whose normal is less than
 * 60 degrees from it. False if there is none. */
bool sbfi_surface_nearest(const sbfi_surface_finder *finder, sbfi_d3 position, const sbfi_d3 *normal,
    double within, sbfi_surface_location *found);

sbfi_d3 sbfi_surface_point(const sbfi_scene_surface *surface, const sbfi_surface_location *location);
sbfi_d3 sbfi_surface_normal(const sbfi_scene_surface *surface, const sbfi_surface_location *location);

#endif
