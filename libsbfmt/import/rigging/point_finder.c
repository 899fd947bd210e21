#include "import/rigging/point_finder.h"

bool sbfi_point_finder_make(
    sbfi_point_finder *finder, const sbf_vec3 *points, uint32_t count, sbfi_arena *arena) {
  sbfi_box *boxes = sbfi_arena_allocate(arena, count ? count : 1, sizeof *boxes);
  if (!boxes) return false;
  for (uint32_t i = 0; i < count; i++)
    boxes[i] = (sbfi_box){{points[i].x, points[i].y, points[i].z}, {points[i].x, points[i].y, points[i].z}};
  finder->points = points;
  return sbfi_box_tree_build(&finder->tree, boxes, count, arena);
}

static double squared_distance(const void *user, uint32_t item, const double position[3]) {
  const sbf_vec3 *p = &((const sbf_vec3 *)user)[item];
  double x = (double)p->x - position[0], y = (double)p->y - position[1], z = (double)p->z - position[2];
  return x * x + y * y + z * z;
}

uint32_t sbfi_point_nearest(
    const sbfi_point_finder *finder, sbfi_d3 position, double within, double *distance) {
  const double at[3] = {position.x, position.y, position.z};
  double min = within * within * (1 + 1e-12);
  uint32_t found = sbfi_box_tree_nearest(&finder->tree, at, squared_distance, finder->points, &min);
  if (distance) *distance = sqrt(min);
  return found;
}

typedef struct near_points {
  const sbfi_point_finder *finder;
  double position[3], within;
  void (*visit)(void *user, uint32_t point);
  void *user;
} near_points;

static bool visit_near(void *user, uint32_t item) {
  const near_points *n = user;
  if (squared_distance(n->finder->points, item, n->position) <= n->within * n->within)
    n->visit(n->user, item);
  return true;
}

void sbfi_find_points_near(const sbfi_point_finder *finder, sbfi_d3 position, double within,
    void (*visit)(void *user, uint32_t point), void *user) {
  near_points n = {finder, {position.x, position.y, position.z}, within, visit, user};
  sbfi_box box;
  for (int k = 0; k < 3; k++) {
    box.low[k] = nextafterf((float)(n.position[k] - within), -INFINITY);
    box.high[k] = nextafterf((float)(n.position[k] + within), INFINITY);
  }
  sbfi_box_tree_visit(&finder->tree, &box, visit_near, &n);
}
