#include "build/weights/body_bridges.h"

#include <stdlib.h>

#include "base/union_find.h"

typedef struct bridge_search {
  const sbfi_body_grid *grid;
  uint32_t *parents; /* (cell_count) sets of connected cells */
  uint32_t *nearest; /* (box_count) nearest cell, UINT32_MAX: not reached */
} bridge_search;

static void join_neighbours(const bridge_search *b) {
  const sbfi_body_grid *g = b->grid;
  sbfi_sets_begin(b->parents, g->cell_count);
  for (uint32_t cell = 0; cell < g->cell_count; cell++)
    for (int direction = SBFI_BODY_DIRECTIONS / 2; direction < SBFI_BODY_DIRECTIONS; direction++) {
      int32_t other = g->cell_of_box[(int64_t)g->box_of_cell[cell] + g->steps[direction]];
      if (other != SBF_NONE) sbfi_sets_join(b->parents, cell, (uint32_t)other);
    }
}

static uint32_t count_sets(const bridge_search *b) {
  uint32_t count = 0;
  for (uint32_t cell = 0; cell < b->grid->cell_count; cell++)
    count += sbfi_set_root(b->parents, cell) == cell;
  return count;
}

/* Flood fill: gives each box the cell that reaches it first. */
static bool flood(bridge_search *b, sbfi_arena *arena) {
  const sbfi_body_grid *g = b->grid;
  uint32_t *queue = sbfi_arena_allocate(arena, g->box_count, sizeof *queue), count = 0;
  b->nearest = sbfi_arena_allocate(arena, g->box_count, sizeof *b->nearest);
  if (!queue || !b->nearest) return false;
  for (uint32_t box = 0; box < g->box_count; box++) {
    b->nearest[box] = g->cell_of_box[box] == SBF_NONE ? UINT32_MAX : (uint32_t)g->cell_of_box[box];
    if (b->nearest[box] != UINT32_MAX) queue[count++] = box;
  }
  for (uint32_t next = 0; next < count; next++)
    for (int direction = 0; direction < SBFI_BODY_DIRECTIONS; direction++) {
      int64_t box = (int64_t)queue[next] + g->steps[direction];
      if (box < 0 || box >= g->box_count || b->nearest[box] != UINT32_MAX) continue;
      b->nearest[box] = b->nearest[queue[next]];
      queue[count++] = (uint32_t)box;
    }
  return true;
}

static int compare_bridges(const void *left, const void *right) {
  const sbfi_body_bridge *a = left, *b = right;
  if (a->length != b->length) return a->length < b->length ? -1 : 1;
  if (a->from != b->from) return a->from < b->from ? -1 : 1;
  return a->to < b->to ? -1 : a->to > b->to;
}

static int compare_ends(const void *left, const void *right) {
  const sbfi_body_bridge *a = left, *b = right;
  if (a->from != b->from) return a->from < b->from ? -1 : 1;
  return a->to < b->to ? -1 : a->to > b->to;
}

/* Fronts from two sets that touch give candidates for bridges. */
static bool find_candidates(bridge_search *b, sbfi_array *candidates) {
  const sbfi_body_grid *g = b->grid;
  for (uint32_t box = 0; box < g->box_count; box++)
    for (int direction = SBFI_BODY_DIRECTIONS / 2; direction < SBFI_BODY_DIRECTIONS; direction++) {
      int64_t other = (int64_t)box + g->steps[direction];
      if (other < 0 || other >= g->box_count) continue;
      uint32_t from = b->nearest[box], to = b->nearest[other];
      if (from == to || sbfi_set_root(b->parents, from) == sbfi_set_root(b->parents, to)) continue;
      sbfi_d3 separation = sbfi_d3_sub(
          sbfi_body_box_middle(g, g->box_of_cell[from]), sbfi_body_box_middle(g, g->box_of_cell[to]));
      sbfi_body_bridge bridge = {from < to ? from : to, from < to ? to : from,
          (float)(sbfi_d3_length(separation) * SBFI_BODY_CELLS)};
      if (!sbfi_array_append(candidates, &bridge, 1)) return false;
    }
  qsort(candidates->at, candidates->count, sizeof(sbfi_body_bridge), compare_bridges);
  return true;
}

static void keep_shortest(bridge_search *b, const sbfi_array *candidates, sbfi_body_grid *grid) {
  const sbfi_body_bridge *all = candidates->at;
  for (size_t i = 0; i < candidates->count; i++) {
    if (sbfi_set_root(b->parents, all[i].from) == sbfi_set_root(b->parents, all[i].to)) continue;
    sbfi_sets_join(b->parents, all[i].from, all[i].to);
    grid->bridges[grid->bridge_count++] = all[i];
    grid->bridges[grid->bridge_count++] = (sbfi_body_bridge){all[i].to, all[i].from, all[i].length};
  }
  qsort(grid->bridges, grid->bridge_count, sizeof *grid->bridges, compare_ends);
}

bool sbfi_body_bridges_make(sbfi_body_grid *grid, sbfi_arena *arena) {
  bridge_search b = {.grid = grid};
  b.parents = sbfi_arena_allocate(arena, (size_t)grid->cell_count + 1, sizeof *b.parents);
  if (!b.parents) return false;
  join_neighbours(&b);
  uint32_t sets = count_sets(&b);
  if (sets < 2) return true;
  grid->bridges = sbfi_arena_allocate(arena, 2 * (size_t)sets, sizeof *grid->bridges);
  if (!grid->bridges || !flood(&b, arena)) return false;
  sbfi_array candidates;
  sbfi_array_init(&candidates, &arena->allocator, sizeof(sbfi_body_bridge));
  bool good = find_candidates(&b, &candidates);
  if (good) keep_shortest(&b, &candidates, grid);
  sbfi_array_free(&candidates);
  return good;
}
