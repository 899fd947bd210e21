#include "import/rigging/surface_finder.h"

bool sbfi_surface_finder_make(
    sbfi_surface_finder *finder, const sbfi_scene_surface *surface, sbfi_arena *arena) {
  finder->surface = surface;
  return sbfi_triangle_tree_build(&finder->tree, &surface->mesh, arena);
}

typedef struct query {
  const sbfi_surface_finder *finder;
  const sbfi_d3 *normal;
} query;

static void closest(const sbfi_surface_finder *finder, uint32_t triangle, const double position[3],
    sbfi_surface_location *to) {
  const sbfi_triangle *t = &finder->tree.triangles[triangle];
  double corners[3][3];
  for (int k = 0; k < 3; k++) {
    sbf_vec3 p = finder->surface->mesh.positions.at[t->points[k]];
    to->points[k] = t->points[k];
    corners[k][0] = (double)p.x;
    corners[k][1] = (double)p.y;
    corners[k][2] = (double)p.z;
  }
  to->distance = sbfi_triangle_closest(corners[0], corners[1], corners[2], position, to->weights);
}

static double facing_distance(const void *user, uint32_t item, const double position[3]) {
  static const double cosine = 0.5;
  const query *q = user;
  sbfi_surface_location here;
  closest(q->finder, item, position, &here);
  if (!q->normal) return here.distance;
  sbfi_d3 normal = sbfi_surface_normal(q->finder->surface, &here);
  return sbfi_d3_dot(normal, *q->normal) > cosine ? here.distance : INFINITY;
}

bool sbfi_surface_nearest(const sbfi_surface_finder *finder, sbfi_d3 position, const sbfi_d3 *normal,
    double within, sbfi_surface_location *found) {
  const double at[3] = {position.x, position.y, position.z};
  const query q = {finder, normal};
  double min = within * within;
  uint32_t triangle = sbfi_box_tree_nearest(&finder->tree.tree, at, facing_distance, &q, &min);
  if (triangle == UINT32_MAX) return false;
  closest(finder, triangle, at, found);
  found->distance = sqrt(found->distance);
  return true;
}

sbfi_d3 sbfi_surface_point(const sbfi_scene_surface *surface, const sbfi_surface_location *location) {
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    sum = sbfi_d3_add(sum,
        sbfi_d3_scale(sbfi_d3_of(surface->mesh.positions.at[location->points[k]]), location->weights[k]));
  return sum;
}

sbfi_d3 sbfi_surface_normal(const sbfi_scene_surface *surface, const sbfi_surface_location *location) {
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    sum = sbfi_d3_add(
        sum, sbfi_d3_scale(sbfi_d3_of(surface->normals[location->points[k]]), location->weights[k]));
  return sbfi_d3_normal(sum);
}
