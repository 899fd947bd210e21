/* Inside and outside of a body of several shells, and how far a ray runs in it. */
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

/* `surface` must outlive it. False where memory runs out. */
bool sbfi_body_rays_make(sbfi_body_rays *rays, const sbf_polygon_mesh *surface, sbfi_arena *arena);

/* Whether any shell, or what caps close, holds the point. */
bool sbfi_body_holds(const sbfi_body_rays *rays, sbfi_d3 point);

/* Distance from a point along a direction of unit length to where the ray leaves the body, through shells
 * that lie within each other; from outside, to the surface. INFINITY: it meets none. */
double sbfi_body_exit_distance(const sbfi_body_rays *rays, sbfi_d3 from, sbfi_d3 direction);

/* Distance along a direction of unit length to the far side of the shells that hold the point; to the first
 * surface where none does. INFINITY: the ray meets none. */
double sbfi_body_shell_end(
    const sbfi_body_rays *rays, const sbfi_weight_mesh *mesh, sbfi_d3 from, sbfi_d3 direction);

#endif
