#include "build/geometry/topology.h"

#include "base/union_find.h"
#include "build/springs/pair_set.h"

/* Converts group sizes, stored at index + 1, to begins: a running sum. */
static void sum_up(uint32_t *begins, size_t count) {
  for (size_t i = 0; i < count; i++) begins[i + 1] += begins[i];
}

static bool collect_edges(sbfi_topology *t, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  sbfi_pair_set known;
  t->corner_begins = sbfi_arena_allocate(arena, (size_t)t->polygon_count + 1, sizeof *t->corner_begins);
  t->corner_edges = sbfi_arena_allocate(arena, (size_t)t->corner_count + 1, sizeof *t->corner_edges);
  t->edges = sbfi_arena_allocate(arena, (size_t)t->corner_count + 1, sizeof *t->edges);
  if (!t->corner_begins || !t->corner_edges || !t->edges) return false;
  if (!sbfi_pair_set_init(&known, t->corner_count, arena)) return false;
  uint32_t begin = 0;
  for (uint32_t p = 0; p < t->polygon_count; p++) {
    uint32_t size = mesh->polygon_sizes.at[p];
    t->corner_begins[p] = begin;
    for (uint32_t k = 0; k < size; k++) {
      uint32_t a = mesh->polygon_points.at[begin + k];
      uint32_t b = mesh->polygon_points.at[begin + (k + 1 < size ? k + 1 : 0)];
      uint32_t edge = a == b ? SBFI_NO_INDEX : sbfi_pair_set_add(&known, a, b, t->edge_count);
      t->corner_edges[begin + k] = edge;
      if (edge == t->edge_count) t->edges[t->edge_count++] = (sbf_uint2){{a, b}};
      t->degenerate_side_count += a == b;
    }
    begin += size;
  }
  t->corner_begins[t->polygon_count] = begin;
  return true;
}

static bool group_by_edge(sbfi_topology *t, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  t->edge_polygon_begins = sbfi_arena_allocate(arena, (size_t)t->edge_count + 1, sizeof(uint32_t));
  t->edge_polygons = sbfi_arena_allocate(arena, (size_t)t->corner_count + 1, sizeof(uint32_t));
  uint32_t *filled = sbfi_arena_allocate(arena, (size_t)t->edge_count + 1, sizeof(uint32_t));
  uint32_t *forward = sbfi_arena_allocate(arena, (size_t)t->edge_count + 1, sizeof(uint32_t));
  if (!t->edge_polygon_begins || !t->edge_polygons || !filled || !forward) return false;
  for (uint32_t c = 0; c < t->corner_count; c++)
    if (t->corner_edges[c] != SBFI_NO_INDEX) t->edge_polygon_begins[t->corner_edges[c] + 1]++;
  sum_up(t->edge_polygon_begins, t->edge_count);
  for (uint32_t p = 0; p < t->polygon_count; p++) {
    for (uint32_t c = t->corner_begins[p]; c < t->corner_begins[p + 1]; c++) {
      uint32_t edge = t->corner_edges[c];
      if (edge == SBFI_NO_INDEX) continue;
      t->edge_polygons[t->edge_polygon_begins[edge] + filled[edge]++] = p;
      forward[edge] += mesh->polygon_points.at[c] == t->edges[edge].at[0];
    }
  }
  for (uint32_t e = 0; e < t->edge_count; e++) {
    t->boundary_edge_count += filled[e] == 1;
    t->nonmanifold_edge_count += filled[e] > 2;
    t->clashing_edge_count += filled[e] == 2 && forward[e] != 1;
  }
  return true;
}

static bool group_by_point(sbfi_topology *t, sbfi_arena *arena) {
  t->point_edge_begins = sbfi_arena_allocate(arena, (size_t)t->point_count + 1, sizeof(uint32_t));
  t->point_edges = sbfi_arena_allocate(arena, 2 * (size_t)t->edge_count + 1, sizeof(uint32_t));
  uint32_t *filled = sbfi_arena_allocate(arena, (size_t)t->point_count + 1, sizeof(uint32_t));
  if (!t->point_edge_begins || !t->point_edges || !filled) return false;
  for (uint32_t e = 0; e < t->edge_count; e++)
    for (int end = 0; end < 2; end++) t->point_edge_begins[t->edges[e].at[end] + 1]++;
  sum_up(t->point_edge_begins, t->point_count);
  for (uint32_t e = 0; e < t->edge_count; e++) {
    for (int end = 0; end < 2; end++) {
      uint32_t point = t->edges[e].at[end];
      t->point_edges[t->point_edge_begins[point] + filled[point]++] = e;
    }
  }
  return true;
}

/* Finds components by union of the ends of each edge; the root is the lowest point, so that components are
 * numbered by point. */
static bool number_components(sbfi_topology *t, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  t->point_components = sbfi_arena_allocate(arena, (size_t)t->point_count + 1, sizeof(uint32_t));
  uint32_t *parents = sbfi_arena_allocate(arena, (size_t)t->point_count + 1, sizeof(uint32_t));
  uint8_t *used = sbfi_arena_allocate(arena, (size_t)t->point_count + 1, 1);
  if (!t->point_components || !parents || !used) return false;
  sbfi_sets_begin(parents, t->point_count);
  for (uint32_t e = 0; e < t->edge_count; e++) sbfi_sets_join(parents, t->edges[e].at[0], t->edges[e].at[1]);
  for (uint32_t c = 0; c < t->corner_count; c++) used[mesh->polygon_points.at[c]] = 1;
  for (uint32_t i = 0; i < t->point_count; i++) {
    uint32_t root = sbfi_set_root(parents, i);
    t->unused_point_count += !used[i];
    if (!used[i])
      t->point_components[i] = SBFI_NO_INDEX;
    else
      t->point_components[i] = root == i ? t->component_count++ : t->point_components[root];
  }
  return true;
}

bool sbfi_topology_build(sbfi_topology *topology, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  *topology = (sbfi_topology){.point_count = mesh->positions.count,
      .polygon_count = mesh->polygon_sizes.count,
      .corner_count = mesh->polygon_points.count};
  return collect_edges(topology, mesh, arena) && group_by_edge(topology, mesh, arena) &&
         group_by_point(topology, arena) && number_components(topology, mesh, arena);
}
