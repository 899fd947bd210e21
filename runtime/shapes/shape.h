/* Host shapes: distance of a point, and entry of a ray. All in the shape's frame. */
#ifndef SBRI_SHAPE_H
#define SBRI_SHAPE_H

#include "sbrun/collision.h"
#include "shapes/hull.h"

/* Triangles with a bounding volume tree; solid behind their faces. */
typedef struct sbri_triangles {
  const sbf_vec3 *points;
  const uint32_t *corners; /* (count x 3) */
  uint32_t count;
  sbri_bounds_tree tree;
} sbri_triangles;

/* A convex edge and the normals of its adjacent faces, in order around it. */
typedef struct sbri_shape_ridge {
  sbf_vec3 at[2], normals[2];
} sbri_shape_ridge;

/* All ridges of a box, a hull or a mesh; shapes/shape_ridges.c. */
typedef struct sbri_shape_ridges {
  const sbri_shape_ridge *at; /* (count) */
  uint32_t count;
  sbri_bounds_tree tree;
  float past_m; /* of a hull: maximum penetration of an edge that still leaves over the ridge */
} sbri_shape_ridges;

struct sbr_shape {
  sbfi_arena arena;
  sbf_allocator allocator;
  sbr_shape_kind kind;
  float radius;
  sbf_vec3 half_sizes;
  sbri_hull hull;           /* of box and hull */
  sbri_triangles triangles; /* of mesh and height field */
  sbri_shape_ridges ridges;
  sbr_host_shape host;
  sbri_box bounds; /* that of a plane is as large as numbers allow */
};

/* Nearest point of a surface. */
typedef struct sbri_nearest {
  float gap; /* distance, negative inside */
  sbf_vec3 position, normal;
} sbri_nearest;

/* False if nothing is within `reach`, or if the point is deeper than `depth` inside triangles. */
bool sbri_shape_nearest(const sbr_shape *shape, sbf_vec3 x, float reach, float depth, sbri_nearest *found);
/* First entry of a ray from x; `fraction` is 0 to 1. A ray that begins inside has no entry. */
bool sbri_shape_enter(
    const sbr_shape *shape, sbf_vec3 x, sbf_vec3 displacement, float *fraction, sbf_vec3 *normal);

/* Entry of a ray into a hull. */
bool sbri_hull_enter(
    const sbri_hull *hull, sbf_vec3 x, sbf_vec3 displacement, float *fraction, sbf_vec3 *normal);
sbf_vec3 sbri_triangle_normal(sbf_vec3 a, sbf_vec3 b, sbf_vec3 c);

#endif
