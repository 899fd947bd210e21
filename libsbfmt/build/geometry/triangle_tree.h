/* The triangles of a surface, to be searched: which lies nearest to a point, which does a ray meet. */
#ifndef SBFI_TRIANGLE_TREE_H
#define SBFI_TRIANGLE_TREE_H

#include "build/geometry/box_tree.h"
#include "sbfmt/model.h"

typedef struct sbfi_triangle {
  uint32_t points[3], polygon;
} sbfi_triangle;

typedef struct sbfi_triangle_tree {
  const sbf_vec3 *positions;
  sbfi_triangle *triangles; /* polygon after polygon, each as a fan from its first corner */
  uint32_t triangle_count;
  sbfi_box_tree tree;
} sbfi_triangle_tree;

/* `positions` must outlive the tree. False where memory runs out. */
bool sbfi_triangle_tree_build(sbfi_triangle_tree *tree, const sbf_polygon_mesh *mesh, sbfi_arena *arena);

/* The nearest triangle whose squared distance is below `*least`, which then becomes that; else UINT32_MAX. */
uint32_t sbfi_triangle_tree_nearest(const sbfi_triangle_tree *tree, sbf_vec3 point, double *min);

/* The first triangle that the ray from `origin` through `point` meets, on either side, up to `most` times as
 * far as the point is; UINT32_MAX: none. */
uint32_t sbfi_triangle_tree_pierced(
    const sbfi_triangle_tree *tree, sbf_vec3 origin, sbf_vec3 point, double max);

/* Weights of the corners a, b, c that give the point of the triangle nearest to `point`; returns the square
 * of its distance. A triangle without area is its longest side, or one point. */
double sbfi_triangle_closest(
    const double a[3], const double b[3], const double c[3], const double point[3], double weights[3]);

#endif
