#include "build/geometry/polygon_repeats.h"

#include <string.h>

#include "build/geometry/key_set.h"

static int compare(uint32_t a, uint32_t b) {
  return a < b ? -1 : a > b;
}

/* Heap sort: polygons have few corners, but a hostile one may have millions. */
static void sift(uint32_t *at, uint32_t root, uint32_t count) {
  for (uint32_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && compare(at[child], at[child + 1]) < 0) child++;
    if (compare(at[root], at[child]) >= 0) return;
    uint32_t swap = at[root];
    at[root] = at[child];
    at[child] = swap;
  }
}

static void sort(uint32_t *at, uint32_t count) {
  for (uint32_t i = count / 2; i-- > 0;) sift(at, i, count);
  for (uint32_t end = count; end-- > 1;) {
    uint32_t swap = at[0];
    at[0] = at[end];
    at[end] = swap;
    sift(at, 0, end);
  }
}

static sbfi_key key_of(const uint32_t *sorted, uint32_t count) {
  uint64_t hash = count;
  for (uint32_t i = 0; i < count; i++) {
    hash = (hash ^ sorted[i]) * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 31;
  }
  return (sbfi_key){{count, (uint32_t)hash, (uint32_t)(hash >> 32), 0}};
}

bool sbfi_polygon_repeats_find(const sbf_polygon_mesh *mesh, uint32_t *firsts, sbfi_arena *scratch) {
  uint32_t polygons = mesh->polygon_sizes.count;
  sbfi_key_set set;
  uint32_t *begins = sbfi_arena_allocate(scratch, (size_t)polygons + 1, sizeof *begins);
  uint32_t *sorted = sbfi_arena_allocate(scratch, (size_t)mesh->polygon_points.count + 1, sizeof *sorted);
  if (!begins || !sorted || !sbfi_key_set_init(&set, polygons, scratch)) return false;
  if (polygons) memcpy(sorted, mesh->polygon_points.at, mesh->polygon_points.count * sizeof *sorted);
  for (uint32_t p = 0; p < polygons; p++) {
    uint32_t size = mesh->polygon_sizes.at[p];
    begins[p + 1] = begins[p] + size;
    sort(sorted + begins[p], size);
    uint32_t *seen = sbfi_key_set_find(&set, key_of(sorted + begins[p], size));
    if (*seen == UINT32_MAX) *seen = p;
    const uint32_t *one = sorted + begins[*seen], *other = sorted + begins[p];
    bool same = mesh->polygon_sizes.at[*seen] == size && memcmp(one, other, size * sizeof *one) == 0;
    firsts[p] = same ? *seen : p;
  }
  return true;
}
