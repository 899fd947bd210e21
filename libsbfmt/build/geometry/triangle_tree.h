/* Search tree of a surface's triangles: the nearest to a point, the first that a ray hits. */
#ifndef SBFI_TRIANGLE_TREE_H
#define SBFI_TRIANGLE_TREE_H

#include "build/geometry/box_tree.h"
#include "sbfmt/model.h"

typedef struct sbfi_triangle {
  uint32_t points[3], polygon;
} sbfi_triangle;

typedef struct sbfi_triangle_tree {
  const sbf_vec3 *positions;
  sbfi_triangle *triangles; /* by polygon, each as a fan from its first corner */
  uint32_t triangle_count;
  sbfi_box_tree tree;
} sbfi_triangle_tree;

/* `positions` must outlive the tree. False if memory runs out. */
bool sbfi_triangle_tree_build(sbfi_triangle_tree *tree, const sbf_polygon_mesh *mesh, sbfi_arena *arena);

/* Nearest triangle whose squared distance is below `*min`, which receives that distance; otherwise
 * UINT32_MAX. */
uint32_t sbfi_triangle_tree_nearest(const sbfi_triangle_tree *tree, sbf_vec3 point, double *min);

/* First triangle that the ray from `origin` through `point` hits, on either side, up to `max` times the
 * distance of the point; UINT32_MAX: none. */
uint32_t sbfi_triangle_tree_pierced(
    const sbfi_triangle_tree *tree, sbf_vec3 origin, sbf_vec3 point, double max);

/* Weights of the corners a, b, c for the point of the triangle nearest to `point`; returns its squared
 * distance. A degenerate triangle counts as its longest edge, or one point. */
double sbfi_triangle_closest(
    const double a[3], const double b[3], const double c[3], const double point[3], double weights[3]);

#endif
