#include "build/geometry/triangle_tree.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void minus(const double a[3], const double b[3], double difference[3]) {
  for (int k = 0; k < 3; k++) difference[k] = a[k] - b[k];
}

static void cross(const double a[3], const double b[3], double product[3]) {
  product[0] = a[1] * b[2] - a[2] * b[1];
  product[1] = a[2] * b[0] - a[0] * b[2];
  product[2] = a[0] * b[1] - a[1] * b[0];
}

static void load(sbf_vec3 from, double to[3]) {
  to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

/* Nearest point of the edge a b: `fraction` receives the weight of b; returns the squared distance. */
static double closest_on_side(const double a[3], const double b[3], const double point[3], double *fraction) {
  double side[3], direction[3], left[3];
  minus(b, a, side);
  minus(point, a, direction);
  double squared = dot(side, side), t = squared > 0 ? dot(direction, side) / squared : 0;
  *fraction = t < 0 ? 0 : t > 1 ? 1 : t;
  for (int k = 0; k < 3; k++) left[k] = direction[k] - *fraction * side[k];
  return dot(left, left);
}

double sbfi_triangle_closest(
    const double a[3], const double b[3], const double c[3], const double point[3], double weights[3]) {
  double ab[3], ac[3], ap[3], normal[3], part[3];
  minus(b, a, ab);
  minus(c, a, ac);
  minus(point, a, ap);
  cross(ab, ac, normal);
  double squared = dot(normal, normal), longest = dot(ab, ab) > dot(ac, ac) ? dot(ab, ab) : dot(ac, ac);
  if (squared > 1e-24 * longest * longest) {
    cross(ap, ac, part);
    weights[1] = dot(part, normal) / squared;
    cross(ab, ap, part);
    weights[2] = dot(part, normal) / squared;
    weights[0] = 1 - weights[1] - weights[2];
    double height = dot(ap, normal);
    if (weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0) return height * height / squared;
  }
  /* Beside the triangle, or it has no area: the nearest of its edges. */
  const double *corners[3] = {a, b, c};
  double best = INFINITY;
  for (int k = 0; k < 3; k++) {
    double fraction, d = closest_on_side(corners[k], corners[(k + 1) % 3], point, &fraction);
    if (!(d < best)) continue;
    best = d;
    weights[k] = 1 - fraction;
    weights[(k + 1) % 3] = fraction;
    weights[(k + 2) % 3] = 0;
  }
  return best;
}

static void load_corners(const sbfi_triangle_tree *tree, uint32_t triangle, double corners[3][3]) {
  for (int k = 0; k < 3; k++) load(tree->positions[tree->triangles[triangle].points[k]], corners[k]);
}

static double distance(const void *user, uint32_t triangle, const double point[3]) {
  double corners[3][3], weights[3];
  load_corners(user, triangle, corners);
  return sbfi_triangle_closest(corners[0], corners[1], corners[2], point, weights);
}

/* Möller and Trumbore's test, two-sided. */
static double collide(
    const void *user, uint32_t triangle, const double origin[3], const double direction[3]) {
  double corners[3][3], ab[3], ac[3], to_origin[3], p[3], q[3];
  load_corners(user, triangle, corners);
  minus(corners[1], corners[0], ab);
  minus(corners[2], corners[0], ac);
  minus(origin, corners[0], to_origin);
  cross(direction, ac, p);
  double determinant = dot(ab, p);
  if (determinant == 0) return -1;
  double u = dot(to_origin, p) / determinant;
  cross(to_origin, ab, q);
  double v = dot(direction, q) / determinant, slack = 1e-9; /* so that no ray slips between two triangles */
  if (u < -slack || v < -slack || u + v > 1 + slack) return -1;
  return dot(ac, q) / determinant;
}

bool sbfi_triangle_tree_build(sbfi_triangle_tree *tree, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  *tree = (sbfi_triangle_tree){.positions = mesh->positions.at};
  size_t count = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) count += mesh->polygon_sizes.at[p] - 2;
  if (count == 0) return true;
  tree->triangles = sbfi_arena_allocate(arena, count, sizeof *tree->triangles);
  sbfi_box *boxes = sbfi_arena_allocate(arena, count, sizeof *boxes);
  if (!tree->triangles || !boxes) return false;
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      uint32_t triangle = tree->triangle_count++;
      tree->triangles[triangle] = (sbfi_triangle){{corners[0], corners[k - 1], corners[k]}, p};
      for (int c = 0; c < 3; c++) {
        sbf_vec3 at = tree->positions[tree->triangles[triangle].points[c]];
        const float position[3] = {at.x, at.y, at.z};
        for (int axis = 0; axis < 3; axis++) {
          float *low = &boxes[triangle].low[axis], *high = &boxes[triangle].high[axis];
          if (c == 0 || position[axis] < *low) *low = position[axis];
          if (c == 0 || position[axis] > *high) *high = position[axis];
        }
      }
    }
  }
  return sbfi_box_tree_build(&tree->tree, boxes, tree->triangle_count, arena);
}

uint32_t sbfi_triangle_tree_nearest(const sbfi_triangle_tree *tree, sbf_vec3 point, double *min) {
  double at[3];
  load(point, at);
  return sbfi_box_tree_nearest(&tree->tree, at, distance, tree, min);
}

uint32_t sbfi_triangle_tree_pierced(
    const sbfi_triangle_tree *tree, sbf_vec3 origin, sbf_vec3 point, double max) {
  double from[3], to[3], direction[3];
  load(origin, from);
  load(point, to);
  minus(to, from, direction);
  return sbfi_box_tree_pierced(&tree->tree, from, direction, max, collide, tree);
}
