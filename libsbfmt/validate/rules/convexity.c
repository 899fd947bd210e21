#include "validate/rules/convexity.h"

#include "build/geometry/topology.h"
#include "mechanics/polygon.h"
#include "validate/rules/pose.h"

enum { MAX_COMPARISONS = 4000000 };

typedef struct face {
  sbfi_d3 normal, middle;
} face;

static face face_of(const sbf_polygon_mesh *hull, const uint32_t *corners, uint32_t size) {
  face f = {.middle = sbfi_polygon_middle(hull->positions.at, corners, size)};
  f.normal = sbfi_d3_normal(sbfi_polygon_area(hull->positions.at, corners, size, f.middle));
  return f;
}

static bool is_behind(const face *f, sbf_vec3 point, double slack) {
  return sbfi_d3_dot(f->normal, sbfi_d3_sub(sbfi_d3_of(point), f->middle)) <= slack;
}

static bool all_behind(const sbf_polygon_mesh *hull, const face *f, double slack) {
  for (uint32_t i = 0; i < hull->positions.count; i++)
    if (!is_behind(f, hull->positions.at[i], slack)) return false;
  return true;
}

static bool neighbours_behind(
    const sbf_polygon_mesh *hull, const sbfi_topology *t, uint32_t polygon, const face *f, double slack) {
  for (uint32_t c = t->corner_begins[polygon]; c < t->corner_begins[polygon + 1]; c++) {
    uint32_t edge = t->corner_edges[c];
    for (uint32_t e = t->edge_polygon_begins[edge]; e < t->edge_polygon_begins[edge + 1]; e++) {
      uint32_t other = t->edge_polygons[e];
      for (uint32_t k = t->corner_begins[other]; k < t->corner_begins[other + 1]; k++)
        if (!is_behind(f, hull->positions.at[hull->polygon_points.at[k]], slack)) return false;
    }
  }
  return true;
}

sbfi_hull_fault sbfi_hull_check(const sbf_polygon_mesh *hull, sbfi_arena *scratch) {
  sbfi_topology t;
  if (!sbfi_topology_build(&t, hull, scratch)) return SBFI_HULL_FAULT_MEMORY;
  if (t.polygon_count < 4 || t.boundary_edge_count || t.nonmanifold_edge_count || t.clashing_edge_count ||
      t.degenerate_side_count)
    return SBFI_HULL_FAULT_OPEN;
  double slack = 1e-3 * sbfi_extent(hull->positions);
  bool small = (uint64_t)t.polygon_count * t.point_count <= MAX_COMPARISONS;
  for (uint32_t p = 0; p < t.polygon_count; p++) {
    const uint32_t *corners = hull->polygon_points.at + t.corner_begins[p];
    face f = face_of(hull, corners, t.corner_begins[p + 1] - t.corner_begins[p]);
    if (small ? !all_behind(hull, &f, slack) : !neighbours_behind(hull, &t, p, &f, slack))
      return SBFI_HULL_FAULT_CONCAVE;
  }
  return SBFI_HULL_FAULT_NONE;
}
