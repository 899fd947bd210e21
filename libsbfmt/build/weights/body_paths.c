#include "build/weights/body_paths.h"

/* Dijkstra's algorithm with buckets one cell wide (Dial 1969). No step is shorter than a bucket, so cells
 * of one bucket do not improve each other; none is longer than all buckets but one. */
enum { BUCKETS = 128 };

bool sbfi_body_paths_make(sbfi_body_paths *p, const sbfi_body_grid *grid, sbfi_arena *arena) {
  size_t count = (size_t)grid->cell_count + 1;
  *p = (sbfi_body_paths){.grid = grid,
      .distances = sbfi_arena_allocate(arena, count, sizeof *p->distances),
      .first = sbfi_arena_allocate(arena, BUCKETS, sizeof *p->first),
      .next = sbfi_arena_allocate(arena, count, sizeof *p->next),
      .previous = sbfi_arena_allocate(arena, count, sizeof *p->previous)};
  return p->distances && p->first && p->next && p->previous;
}

static uint32_t bucket_of(float distance) {
  return (uint32_t)distance % BUCKETS;
}

static void remove_cell(sbfi_body_paths *p, uint32_t cell) {
  uint32_t before = p->previous[cell], after = p->next[cell];
  if (before == UINT32_MAX)
    p->first[bucket_of(p->distances[cell])] = after;
  else
    p->next[before] = after;
  if (after != UINT32_MAX) p->previous[after] = before;
}

/* Returns whether the cell was not in any bucket. */
static bool improve(sbfi_body_paths *p, uint32_t cell, float distance) {
  if (!(distance < p->distances[cell])) return false;
  bool is_new = p->distances[cell] == INFINITY;
  if (!is_new) remove_cell(p, cell);
  p->distances[cell] = distance;
  uint32_t *first = &p->first[bucket_of(distance)];
  p->next[cell] = *first;
  p->previous[cell] = UINT32_MAX;
  if (*first != UINT32_MAX) p->previous[*first] = cell;
  *first = cell;
  return is_new;
}

static double distance_in_cells(const sbfi_body_grid *g, const sbfi_bone_segment *bone, uint32_t cell) {
  sbfi_d3 middle = sbfi_body_box_middle(g, g->box_of_cell[cell]);
  return sqrt(sbfi_segment_distance2(bone, middle)) * SBFI_BODY_CELLS;
}

/* Starts at the cells that a bone crosses. Returns how many are new. */
static uint32_t begin_inside(sbfi_body_paths *p, const sbfi_bone_segment *bone) {
  const sbfi_body_grid *g = p->grid;
  sbfi_d3 along = sbfi_d3_sub(bone->tail, bone->head);
  double steps = ceil(fmin(sbfi_d3_length(along), 8) * 4 * SBFI_BODY_CELLS) + 1;
  uint32_t count = 0;
  for (double step = 0; step <= steps; step++) {
    sbfi_d3 at = sbfi_d3_add(bone->head, sbfi_d3_scale(along, step / steps));
    uint32_t box = sbfi_body_box_at(g, at);
    sbfi_d3 aside = sbfi_d3_sub(at, sbfi_body_box_middle(g, box));
    double farthest = fmax(fabs(aside.x), fmax(fabs(aside.y), fabs(aside.z))) * SBFI_BODY_CELLS;
    int32_t cell = g->cell_of_box[box];
    if (cell != SBF_NONE && farthest < 0.75)
      count += improve(p, (uint32_t)cell, (float)distance_in_cells(g, bone, (uint32_t)cell));
  }
  return count;
}

/* A start that waits until the buckets reach its distance. */
typedef struct late_start {
  uint32_t cell;
  float distance;
  bool is_waiting;
} late_start;

static late_start find_nearest(const sbfi_body_paths *p, const sbfi_bone_segment *bone) {
  late_start nearest = {0, 0, true};
  double min = INFINITY;
  for (uint32_t cell = 0; cell < p->grid->cell_count; cell++) {
    double distance = distance_in_cells(p->grid, bone, cell);
    if (distance < min) min = distance, nearest.cell = cell;
  }
  nearest.distance = (float)fmin(min, 1e6);
  return nearest;
}

/* Starts at the cells of all segments; if the first has none, later at the nearest. Returns the number of
 * cells that are new now. */
static uint32_t begin(
    sbfi_body_paths *p, const sbfi_bone_segment *segments, uint32_t segment_count, late_start *late) {
  uint32_t count = begin_inside(p, &segments[0]);
  *late = count ? (late_start){.is_waiting = false} : find_nearest(p, &segments[0]);
  for (uint32_t i = 1; i < segment_count; i++) count += begin_inside(p, &segments[i]);
  return count;
}

static uint32_t expand(sbfi_body_paths *p, uint32_t cell) {
  const sbfi_body_grid *g = p->grid;
  uint32_t added = 0, low = 0, high = g->bridge_count;
  int64_t box = g->box_of_cell[cell];
  for (int direction = 0; direction < SBFI_BODY_DIRECTIONS; direction++) {
    int32_t other = g->cell_of_box[box + g->steps[direction]];
    if (other != SBF_NONE) added += improve(p, (uint32_t)other, p->distances[cell] + g->lengths[direction]);
  }
  while (low < high) {
    uint32_t middle = (low + high) / 2;
    if (g->bridges[middle].from < cell)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < g->bridge_count && g->bridges[low].from == cell; low++)
    added += improve(p, g->bridges[low].to, p->distances[cell] + g->bridges[low].length);
  return added;
}

void sbfi_body_paths_from(sbfi_body_paths *p, const sbfi_bone_segment *segments, uint32_t segment_count) {
  for (uint32_t i = 0; i < p->grid->cell_count; i++) p->distances[i] = INFINITY;
  for (uint32_t b = 0; b < BUCKETS; b++) p->first[b] = UINT32_MAX;
  if (!p->grid->cell_count) return;
  late_start late;
  uint32_t waiting = begin(p, segments, segment_count, &late);
  for (uint32_t level = 0; waiting || late.is_waiting; level++) {
    if (!waiting) level = (uint32_t)late.distance;
    /* All waiting cells are in the buckets from this level on; a farther one would come too early. */
    if (late.is_waiting && (uint32_t)late.distance < level + BUCKETS - 1) {
      waiting += improve(p, late.cell, late.distance);
      late.is_waiting = false;
    }
    const uint32_t bucket = level % BUCKETS;
    while (p->first[bucket] != UINT32_MAX) {
      uint32_t cell = p->first[bucket];
      p->first[bucket] = p->next[cell];
      if (p->next[cell] != UINT32_MAX) p->previous[p->next[cell]] = UINT32_MAX;
      p->next[cell] = p->previous[cell] = UINT32_MAX;
      waiting--;
      waiting += expand(p, cell);
    }
  }
}
