/* Topology for tearing: neighbours of each tetrahedron, and the tetrahedra around each point.
 */
#include <stdlib.h>
#include <string.h>

#include "mechanics/neo_hookean.h"
#include "prepare/prepare.h"

/* A face of a tetrahedron: its points in ascending order, then its element. */
typedef struct side {
  uint32_t points[3], tetrahedron, corner;
} side;

static int compare_sides(const void *a, const void *b) {
  const side *p = a, *q = b;
  const uint32_t *x = p->points, *y = q->points;
  for (int k = 0; k < 3; k++)
    if (x[k] != y[k]) return x[k] < y[k] ? -1 : 1;
  return p->tetrahedron < q->tetrahedron ? -1 : p->tetrahedron > q->tetrahedron;
}

static uint32_t corner_of(const sbri_island *island, uint32_t t, uint32_t k) {
  uint32_t at = island->tetrahedra.lanes[2 * t];
  return island->tetrahedra.blocks[at / SBRI_BLOCK].corners[k][at % SBRI_BLOCK];
}

static side side_of(const sbri_island *island, uint32_t t, uint32_t corner) {
  side s = {.tetrahedron = t, .corner = corner};
  for (uint32_t k = 0, n = 0; k < 4; k++) {
    if (k == corner) continue;
    uint32_t slot = corner_of(island, t, k), at = n++;
    for (; at > 0 && s.points[at - 1] > slot; at--) s.points[at] = s.points[at - 1];
    s.points[at] = slot;
  }
  return s;
}

static void find_neighbours(const sbri_island *island, side *sides, uint32_t (*neighbours)[4]) {
  size_t count = 4 * (size_t)island->tetrahedra.count;
  for (uint32_t i = 0; i < count; i++) sides[i] = side_of(island, i / 4, i % 4);
  qsort(sides, count, sizeof *sides, compare_sides);
  memset(neighbours, 0xff, island->tetrahedra.count * sizeof *neighbours);
  for (size_t i = 1; i < count; i++) {
    const side *a = &sides[i - 1], *b = &sides[i];
    if (memcmp(a->points, b->points, sizeof a->points) != 0) continue;
    neighbours[a->tetrahedron][a->corner] = b->tetrahedron;
    neighbours[b->tetrahedron][b->corner] = a->tetrahedron;
  }
}

static void find_around(const sbri_island *island, uint32_t *begins, uint32_t *around) {
  for (uint32_t t = 0; t < island->tetrahedra.count; t++)
    for (uint32_t k = 0; k < 4; k++) {
      uint32_t slot = corner_of(island, t, k);
      if (slot < island->free_count) begins[slot]++;
    }
  uint32_t end = 0;
  for (uint32_t slot = 0; slot <= island->free_count; slot++) {
    uint32_t count = slot < island->free_count ? begins[slot] : 0;
    end += count;
    begins[slot] = end;
  }
  for (uint32_t t = island->tetrahedra.count; t-- > 0;)
    for (uint32_t k = 0; k < 4; k++) {
      uint32_t slot = corner_of(island, t, k);
      if (slot < island->free_count) around[--begins[slot]] = t;
    }
}

bool sbri_tear_table_make(sbr_model *model, sbri_island *island) {
  bool tears = false;
  for (uint32_t b = 0; b < island->body_count; b++)
    tears = tears || sbri_body_tears(&model->bodies[island->bodies[b]]);
  size_t count = island->tetrahedra.count;
  if (!tears || count == 0) return true;
  sbfi_arena *arena = &model->arena, scratch;
  sbfi_arena_init(&scratch, &arena->allocator, 0);
  sbri_tear_table *table = sbfi_arena_allocate(arena, 1, sizeof *table);
  uint32_t(*neighbours)[4] = sbfi_arena_allocate(arena, count, sizeof *neighbours);
  uint32_t *begins = sbfi_arena_allocate(arena, (size_t)island->free_count + 1, sizeof *begins);
  uint32_t *around = sbfi_arena_allocate(arena, 4 * count, sizeof *around);
  float *volumes = sbfi_arena_allocate(arena, count, sizeof *volumes);
  side *sides = sbfi_arena_allocate(&scratch, 4 * count, sizeof *sides);
  bool good = table && neighbours && begins && around && volumes && sides;
  if (good) {
    find_neighbours(island, sides, neighbours);
    find_around(island, begins, around);
    for (uint32_t t = 0; t < count; t++) {
      uint32_t at = island->tetrahedra.lanes[2 * t];
      float inverse = island->tetrahedra.blocks[at / SBRI_BLOCK].inverse_volume[at % SBRI_BLOCK];
      volumes[t] = inverse > 0 ? 1 / (6 * inverse) : 0;
    }
    *table = (sbri_tear_table){(const uint32_t(*)[4])neighbours, begins, around, volumes};
    island->tetrahedra.tears = table;
  }
  sbfi_arena_free(&scratch);
  return good;
}
