#include "import/rigging/mesh_borders.h"

#include <stdlib.h>

int sbfi_compare_positions(const sbf_vec3 *a, const sbf_vec3 *b) {
  if (a->x != b->x) return a->x < b->x ? -1 : 1;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  return a->z == b->z ? 0 : a->z < b->z ? -1 : 1;
}

static int compare_edges(const void *a, const void *b) {
  const sbfi_border_edge *x = a, *y = b;
  for (int k = 0; k < 2; k++) {
    int order = sbfi_compare_positions(&x->ends[k], &y->ends[k]);
    if (order) return order;
  }
  return x->mesh == y->mesh ? 0 : x->mesh < y->mesh ? -1 : 1;
}

bool sbfi_borders_coincide(const sbfi_border_edge *a, const sbfi_border_edge *b) {
  return sbfi_compare_positions(&a->ends[0], &b->ends[0]) == 0 &&
         sbfi_compare_positions(&a->ends[1], &b->ends[1]) == 0;
}

static uint32_t add_edges(const sbfi_scene_mesh *mesh, uint32_t number, sbfi_border_edge *to) {
  uint32_t count = 0;
  for (uint32_t p = 0; p < mesh->polygon_count; p++)
    for (uint32_t k = mesh->polygon_starts[p]; k < mesh->polygon_starts[p + 1]; k++) {
      uint32_t next = k + 1 < mesh->polygon_starts[p + 1] ? k + 1 : mesh->polygon_starts[p];
      sbf_vec3 a = mesh->points[mesh->corner_points[k]], b = mesh->points[mesh->corner_points[next]];
      bool ordered = sbfi_compare_positions(&a, &b) < 0;
      to[count++] = (sbfi_border_edge){{ordered ? a : b, ordered ? b : a}, number};
    }
  return count;
}

bool sbfi_borders_find(sbfi_borders *borders, const sbfi_scene_mesh *meshes, uint32_t mesh_count,
    const bool *is_included, sbfi_arena *arena) {
  size_t total = 0, count = 0;
  for (uint32_t m = 0; m < mesh_count; m++) total += is_included[m] ? meshes[m].corner_count : 0;
  *borders = (sbfi_borders){sbfi_arena_allocate(arena, total + 1, sizeof *borders->at), 0};
  if (!borders->at) return false;
  for (uint32_t m = 0; m < mesh_count; m++)
    if (is_included[m]) count += add_edges(&meshes[m], m, borders->at + count);
  qsort(borders->at, count, sizeof *borders->at, compare_edges);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && compare_edges(&borders->at[end], &borders->at[i]) == 0;) end++;
    if ((end - i) % 2) borders->at[borders->count++] = borders->at[i];
  }
  return true;
}
