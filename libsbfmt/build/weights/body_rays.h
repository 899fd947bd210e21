/* Inside tests and ray distances for a body of several shells. */
#ifndef SBFI_BODY_RAYS_H
#define SBFI_BODY_RAYS_H

#include "build/geometry/triangle_tree.h"
#include "build/geometry/winding_number.h"
#include "build/weights/weight_mesh.h"

typedef struct sbfi_body_rays {
  sbfi_triangle_tree tree;
  sbfi_soup soup;
  sbfi_winding winding;
} sbfi_body_rays;

/* `surface` must outlive it. False if memory runs out. */
bool sbfi_body_rays_make(sbfi_body_rays *rays, const sbf_polygon_mesh *surface, sbfi_arena *arena);

/* Whether any shell, possibly closed by caps, contains the point. */
bool sbfi_body_contains(const sbfi_body_rays *rays, sbfi_d3 point);

/* Distance from a point along a unit direction to where the ray leaves the body, through nested shells;
 * from outside, to the surface. INFINITY: no hit. */
double sbfi_body_exit_distance(const sbfi_body_rays *rays, sbfi_d3 from, sbfi_d3 direction);

/* Distance along a unit direction to the far side of the shells that contain the point; to the first
 * surface if none does. INFINITY: no hit. */
double sbfi_body_shell_end(
    const sbfi_body_rays *rays, const sbfi_weight_mesh *mesh, sbfi_d3 from, sbfi_d3 direction);

#endif
