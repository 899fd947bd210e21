#include "build/lattice/lattice_piece_pins.h"

#include <math.h>

#include "base/union_find.h"
#include "build/geometry/line_width.h"
#include "sbfmt/mechanics.h"

typedef struct work {
  const sbf_vec3 *positions;
  const double *depths2;
  const uint8_t *taken;
  double width;
  uint8_t *is_pinned, *added;
  uint32_t *list; /* pinned points of a piece */
} work;

static double squared_from(sbf_vec3 p, const double middle[3]) {
  double x = p.x - middle[0], y = p.y - middle[1], z = p.z - middle[2];
  return x * x + y * y + z * z;
}

/* Lists the pinned points of the piece; returns their number. */
static uint32_t find_pinned(const work *w, const uint32_t *piece, uint32_t size) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < size; i++)
    if (w->is_pinned[piece[i]]) w->list[count++] = piece[i];
  return count;
}

/* The free point nearest to the centre among those at least `width` away from the line; UINT32_MAX: none. */
static uint32_t nearest_off(const work *w, const uint32_t *piece, uint32_t size, const double middle[3],
    const sbfi_farthest_line *line) {
  uint32_t best = UINT32_MAX;
  double min = INFINITY;
  for (uint32_t i = 0; i < size; i++) {
    uint32_t point = piece[i];
    double squared = squared_from(w->positions[point], middle);
    if (w->is_pinned[point] || w->taken[point] || squared >= min) continue;
    if (sbfi_line_distance(line, w->positions[point]) < w->width) continue;
    min = squared;
    best = point;
  }
  return best;
}

static uint32_t deepest(const work *w, const uint32_t *piece, uint32_t size) {
  uint32_t best = UINT32_MAX;
  for (uint32_t i = 0; i < size; i++)
    if (!w->taken[piece[i]] && (best == UINT32_MAX || w->depths2[piece[i]] > w->depths2[best]))
      best = piece[i];
  return best;
}

/* A second point, and a third off the line through both; if the first two are close, one more. */
static void pin_piece(work *w, const uint32_t *piece, uint32_t size) {
  double middle[3] = {0};
  uint32_t count = find_pinned(w, piece, size);
  if (count == 0) {
    uint32_t first = deepest(w, piece, size);
    if (first == UINT32_MAX) return;
    w->is_pinned[first] = w->added[first] = 1;
    count = find_pinned(w, piece, size);
  }
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 p = w->positions[w->list[i]];
    middle[0] += p.x, middle[1] += p.y, middle[2] += p.z;
  }
  for (int k = 0; k < 3; k++) middle[k] /= count;
  for (int round = 0; round < 3; round++) {
    sbfi_farthest_line line = sbfi_farthest_line_of(w->positions, w->list, count);
    if (line.width >= w->width) return;
    uint32_t next = nearest_off(w, piece, size, middle, &line);
    if (next == UINT32_MAX) return;
    w->is_pinned[next] = w->added[next] = 1;
    w->list[count++] = next;
  }
}

bool sbfi_lattice_pin_pieces(const sbf_level *level, const double *depths2, const uint8_t *taken,
    double width, uint32_t *core, uint32_t *count, sbfi_arena *scratch) {
  uint32_t points = level->positions.count, *sorted, *ends;
  work w = {.positions = level->positions.at, .depths2 = depths2, .taken = taken, .width = width};
  uint32_t *parents = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *parents);
  sorted = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *sorted);
  ends = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *ends);
  w.is_pinned = sbfi_arena_allocate(scratch, (size_t)points + 1, 1);
  w.added = sbfi_arena_allocate(scratch, (size_t)points + 1, 1);
  w.list = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *w.list);
  if (!parents || !sorted || !ends || !w.is_pinned || !w.added || !w.list) return false;
  sbf_level_pinned_points(level, w.is_pinned);
  for (uint32_t i = 0; i < *count; i++) w.is_pinned[core[i]] = w.added[core[i]] = 1;
  sbfi_sets_begin(parents, points);
  for (uint32_t t = 0; t < level->lattice.tetrahedra.count; t++)
    for (int k = 1; k < 4; k++)
      sbfi_sets_join(parents, level->lattice.tetrahedra.at[t].at[0], level->lattice.tetrahedra.at[t].at[k]);
  /* Groups the points by piece. */
  for (uint32_t i = 0; i < points; i++) ends[sbfi_set_root(parents, i)]++;
  for (uint32_t i = 0, before = 0; i < points; i++) {
    uint32_t size = ends[i];
    ends[i] = before;
    before += size;
  }
  for (uint32_t i = 0; i < points; i++) sorted[ends[sbfi_set_root(parents, i)]++] = i;
  for (uint32_t i = 0, from = 0; i < points; from = ends[i++])
    if (ends[i] > from) pin_piece(&w, sorted + from, ends[i] - from);
  *count = 0;
  for (uint32_t i = 0; i < points; i++)
    if (w.added[i]) core[(*count)++] = i;
  return true;
}
