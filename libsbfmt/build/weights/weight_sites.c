#include "build/weights/weight_sites.h"

#include <stdlib.h>

#include "base/union_find.h"

/* Maximum distance of coincident points in units of the longest side. */
static const double JOIN_DISTANCE = 1.0 / (1 << 17);

typedef struct keyed_point {
  int32_t key[3];
  uint32_t point;
} keyed_point;

/* An edge from the lower of two positions to the higher, with a point of its piece. */
typedef struct edge {
  uint32_t low, high, point;
} edge;

static int compare_keys(const void *left, const void *right) {
  const keyed_point *a = left, *b = right;
  for (int k = 0; k < 3; k++)
    if (a->key[k] != b->key[k]) return a->key[k] < b->key[k] ? -1 : 1;
  return a->point < b->point ? -1 : a->point > b->point;
}

static int compare_edges(const void *left, const void *right) {
  const edge *a = left, *b = right;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  if (a->high != b->high) return a->high < b->high ? -1 : 1;
  return a->point < b->point ? -1 : a->point > b->point;
}

/* Sorts by key, and gives each point the first point with its key. */
static void find_first(keyed_point *keyed, uint32_t count, uint32_t *first) {
  qsort(keyed, count, sizeof *keyed, compare_keys);
  for (uint32_t i = 0; i < count; i++) {
    keyed_point *k = &keyed[i], *before = k - 1;
    bool same =
        i && k->key[0] == before->key[0] && k->key[1] == before->key[1] && k->key[2] == before->key[2];
    first[k->point] = same ? first[before->point] : k->point;
  }
}

/* Joins points of one triangle, and those of triangles with a common edge. */
static bool join_pieces(
    const sbfi_weights_input *in, const uint32_t *slots, uint32_t *pieces, sbfi_arena *arena) {
  edge *edges = sbfi_arena_allocate(arena, 3 * (size_t)in->triangle_count, sizeof *edges);
  size_t count = 0;
  if (!edges) return false;
  sbfi_sets_begin(pieces, in->point_count);
  for (uint32_t t = 0; t < in->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t a = in->triangles[t][k], b = in->triangles[t][(k + 1) % 3];
      sbfi_sets_join(pieces, a, b);
      if (slots[a] == slots[b]) continue;
      bool ascending = slots[a] < slots[b];
      edges[count++] = (edge){slots[ascending ? a : b], slots[ascending ? b : a], a};
    }
  qsort(edges, count, sizeof *edges, compare_edges);
  for (size_t i = 1; i < count; i++)
    if (edges[i].low == edges[i - 1].low && edges[i].high == edges[i - 1].high)
      sbfi_sets_join(pieces, edges[i].point, edges[i - 1].point);
  return true;
}

bool sbfi_weight_sites_find(sbfi_weight_mesh *m, const sbfi_weights_input *in, sbfi_arena *arena) {
  keyed_point *keyed = sbfi_arena_allocate(arena, in->point_count, sizeof *keyed);
  uint32_t *first = sbfi_arena_allocate(arena, in->point_count, sizeof *first), count = 0;
  uint32_t *pieces = sbfi_arena_allocate(arena, in->point_count, sizeof *pieces);
  bool *is_used = sbfi_arena_allocate(arena, in->point_count, sizeof *is_used);
  m->site_of_point = sbfi_arena_allocate(arena, in->point_count, sizeof *m->site_of_point);
  m->sites = sbfi_arena_allocate(arena, in->point_count, sizeof *m->sites);
  if (!keyed || !first || !pieces || !is_used || !m->site_of_point || !m->sites) return false;
  for (uint32_t t = 0; t < in->triangle_count; t++)
    for (int k = 0; k < 3; k++) is_used[in->triangles[t][k]] = true;
  for (uint32_t i = 0; i < in->point_count; i++) {
    m->site_of_point[i] = UINT32_MAX;
    if (!is_used[i]) continue;
    sbfi_d3 at = sbfi_d3_scale(sbfi_weight_mesh_position(m, in->points[i]), 1 / JOIN_DISTANCE);
    keyed[count++] = (keyed_point){
        {(int32_t)floor(at.x + 0.5), (int32_t)floor(at.y + 0.5), (int32_t)floor(at.z + 0.5)}, i};
  }
  find_first(keyed, count, first);
  if (!join_pieces(in, first, pieces, arena)) return false;
  for (uint32_t i = 0; i < count; i++) { /* second pass: by position and piece */
    uint32_t point = keyed[i].point;
    keyed[i] = (keyed_point){{(int32_t)first[point], (int32_t)sbfi_set_root(pieces, point), 0}, point};
  }
  find_first(keyed, count, first);
  for (uint32_t i = 0; i < in->point_count; i++) {
    if (!is_used[i]) continue;
    if (first[i] == i) {
      m->site_of_point[i] = m->site_count;
      m->sites[m->site_count++] = sbfi_d3_rounded(sbfi_weight_mesh_position(m, in->points[i]));
    } else {
      m->site_of_point[i] = m->site_of_point[first[i]];
    }
  }
  return true;
}
