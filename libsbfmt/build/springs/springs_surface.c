/* Springs over the surface: along edges, across polygons, and straight on across a point. */
#include <math.h>

#include "build/springs/pair_set.h"
#include "build/springs/springs.h"

enum { MAX_NEIGHBOURS = 64 };

static void add(sbfi_spring_list *list, sbfi_pair_set *known, uint32_t a, uint32_t b) {
  if (a == b || sbfi_pair_set_has(known, a, b)) return;
  sbfi_pair_set_add(known, a, b, 0);
  list->at[list->count++] = (sbf_uint2){{a, b}};
}

/* The corner of a triangle that is not on the edge. */
static uint32_t opposite_corner(
    const sbfi_topology *t, const sbf_polygon_mesh *mesh, uint32_t triangle, uint32_t edge) {
  const uint32_t *corners = mesh->polygon_points.at + t->corner_begins[triangle];
  for (int k = 0; k < 3; k++)
    if (corners[k] != t->edges[edge].at[0] && corners[k] != t->edges[edge].at[1]) return corners[k];
  return corners[0];
}

static void add_shear(sbfi_spring_list *list, sbfi_pair_set *known, const sbfi_topology *t,
    const sbf_polygon_mesh *mesh, uint32_t polygon) {
  uint32_t begin = t->corner_begins[polygon], size = t->corner_begins[polygon + 1] - begin;
  const uint32_t *corners = mesh->polygon_points.at + begin;
  if (size > 3) {
    for (uint32_t k = 0; k < size; k++) add(list, known, corners[k], corners[(k + 2) % size]);
    return;
  }
  for (uint32_t k = 0; k < size; k++) {
    uint32_t edge = t->corner_edges[begin + k];
    if (edge == SBFI_NO_INDEX) continue;
    uint32_t first = t->edge_polygon_begins[edge];
    if (t->edge_polygon_begins[edge + 1] - first != 2) continue;
    uint32_t one = t->edge_polygons[first], two = t->edge_polygons[first + 1];
    if (one == two || mesh->polygon_sizes.at[one] != 3 || mesh->polygon_sizes.at[two] != 3) continue;
    add(list, known, opposite_corner(t, mesh, one, edge), opposite_corner(t, mesh, two, edge));
  }
}

static bool have_common_polygon(const sbfi_topology *t, uint32_t edge, uint32_t other) {
  for (uint32_t i = t->edge_polygon_begins[edge]; i < t->edge_polygon_begins[edge + 1]; i++)
    for (uint32_t j = t->edge_polygon_begins[other]; j < t->edge_polygon_begins[other + 1]; j++)
      if (t->edge_polygons[i] == t->edge_polygons[j]) return true;
  return false;
}

/* Adds pairs of opposite neighbours of one point. */
static void add_flexion(sbfi_spring_list *list, sbfi_pair_set *known, const sbfi_topology *t,
    const sbf_vec3 *positions, uint32_t point) {
  const uint32_t *edges = t->point_edges + t->point_edge_begins[point];
  uint32_t count = t->point_edge_begins[point + 1] - t->point_edge_begins[point];
  if (count > MAX_NEIGHBOURS) return;
  uint32_t neighbours[MAX_NEIGHBOURS], straightest[MAX_NEIGHBOURS];
  double directions[MAX_NEIGHBOURS][3];
  for (uint32_t i = 0; i < count; i++) {
    neighbours[i] = sbfi_edge_other(t, edges[i], point);
    sbf_vec3 a = positions[point], b = positions[neighbours[i]];
    double d[3] = {(double)b.x - a.x, (double)b.y - a.y, (double)b.z - a.z};
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) directions[i][k] = length > 0 ? d[k] / length : 0;
  }
  for (uint32_t i = 0; i < count; i++) {
    double min = 2;
    straightest[i] = SBFI_NO_INDEX;
    for (uint32_t j = 0; j < count; j++) {
      const double *a = directions[i], *b = directions[j];
      double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      if (j == i || cosine >= min || have_common_polygon(t, edges[i], edges[j])) continue;
      min = cosine;
      straightest[i] = j;
    }
  }
  for (uint32_t i = 0; i < count; i++) {
    uint32_t j = straightest[i];
    if (j != SBFI_NO_INDEX && j > i && straightest[j] == i) add(list, known, neighbours[i], neighbours[j]);
  }
}

bool sbfi_springs_surface(sbfi_surface_springs *springs, const sbf_polygon_mesh *mesh, const sbfi_topology *t,
    bool flexion, sbfi_arena *arena) {
  /* Bounds: one edge or diagonal per corner; a pair of opposite neighbours takes two of a point's edges. */
  size_t corners = (size_t)t->corner_count + 1, pairs = (flexion ? (size_t)t->edge_count : 0) + 1;
  sbfi_pair_set known;
  *springs = (sbfi_surface_springs){.structural.at = sbfi_arena_allocate(arena, corners, sizeof(sbf_uint2)),
      .shear.at = sbfi_arena_allocate(arena, corners, sizeof(sbf_uint2)),
      .flexion.at = sbfi_arena_allocate(arena, pairs, sizeof(sbf_uint2))};
  if (!springs->structural.at || !springs->shear.at || !springs->flexion.at) return false;
  if (!sbfi_pair_set_init(&known, 2 * corners + pairs, arena)) return false;
  for (uint32_t e = 0; e < t->edge_count; e++)
    add(&springs->structural, &known, t->edges[e].at[0], t->edges[e].at[1]);
  for (uint32_t p = 0; p < t->polygon_count; p++) add_shear(&springs->shear, &known, t, mesh, p);
  for (uint32_t i = 0; flexion && i < t->point_count; i++)
    add_flexion(&springs->flexion, &known, t, mesh->positions.at, i);
  return true;
}
