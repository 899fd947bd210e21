#include "import/rigging/point_finder.h"

#include <math.h>

/* Cells per longest side of the bounding box, at most this multiple of the root of the point count, so
 * that a cell of a surface contains about one point. */
static const double MAX_CELLS = 4;
/* Cells are longer than twice the query distance, so a query spans at most two per axis. */
static const double CELL_OF_DISTANCE = 4;

typedef struct cell_range {
  int64_t low[3], high[3];
} cell_range;

static double squared_distance(const sbf_vec3 *p, sbfi_d3 to) {
  double x = (double)p->x - to.x, y = (double)p->y - to.y, z = (double)p->z - to.z;
  return x * x + y * y + z * z;
}

static uint32_t slot_of(const sbfi_point_finder *finder, int64_t x, int64_t y, int64_t z) {
  uint64_t hash = (uint64_t)x * 73856093u ^ (uint64_t)y * 19349663u ^ (uint64_t)z * 83492791u;
  return (uint32_t)((hash * 0x9e3779b97f4a7c15u) >> 32) & (finder->slot_count - 1);
}

static uint32_t slot_of_point(const sbfi_point_finder *finder, sbf_vec3 p) {
  sbfi_d3 from_low = sbfi_d3_sub(sbfi_d3_of(p), finder->low);
  return slot_of(finder, (int64_t)floor(from_low.x / finder->cell), (int64_t)floor(from_low.y / finder->cell),
      (int64_t)floor(from_low.z / finder->cell));
}

static void find_bounds(sbfi_point_finder *finder, uint32_t count) {
  finder->low = finder->high = count ? sbfi_d3_of(finder->points[0]) : (sbfi_d3){0, 0, 0};
  for (uint32_t i = 1; i < count; i++) {
    sbfi_d3 p = sbfi_d3_of(finder->points[i]), low = finder->low, high = finder->high;
    finder->low = (sbfi_d3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
    finder->high = (sbfi_d3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
  }
}

bool sbfi_point_finder_make(
    sbfi_point_finder *finder, const sbf_vec3 *points, uint32_t count, double within, sbfi_arena *arena) {
  *finder = (sbfi_point_finder){.points = points, .point_count = count, .slot_count = 16};
  find_bounds(finder, count);
  sbfi_d3 sides = sbfi_d3_sub(finder->high, finder->low);
  double longest = fmax(sides.x, fmax(sides.y, sides.z));
  finder->cell = fmax(longest / (MAX_CELLS * sqrt(count + 1.0)), CELL_OF_DISTANCE * within);
  if (!(finder->cell > 0)) finder->cell = 1;
  while (finder->slot_count / 2 < count) finder->slot_count *= 2;
  finder->starts = sbfi_arena_allocate(arena, (size_t)finder->slot_count + 2, sizeof *finder->starts);
  finder->items = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *finder->items);
  if (!finder->starts || !finder->items) return false;
  for (uint32_t i = 0; i < count; i++) finder->starts[slot_of_point(finder, points[i]) + 2]++;
  for (uint32_t s = 2; s < finder->slot_count + 2; s++) finder->starts[s] += finder->starts[s - 1];
  for (uint32_t i = 0; i < count; i++)
    finder->items[finder->starts[slot_of_point(finder, points[i]) + 1]++] = i;
  return true;
}

/* Range of cells that a query overlaps; false if it overlaps none. */
static bool find_cells(const sbfi_point_finder *finder, sbfi_d3 position, double within, cell_range *cells) {
  const double at[3] = {position.x, position.y, position.z};
  const double low[3] = {finder->low.x, finder->low.y, finder->low.z};
  const double high[3] = {finder->high.x, finder->high.y, finder->high.z};
  for (int k = 0; k < 3; k++) {
    double from = fmax(at[k] - within, low[k]), to = fmin(at[k] + within, high[k]);
    if (!(from <= to)) return false;
    cells->low[k] = (int64_t)floor((from - low[k]) / finder->cell);
    cells->high[k] = (int64_t)floor((to - low[k]) / finder->cell);
  }
  return true;
}

static double count_cells(const cell_range *cells) {
  double count = 1;
  for (int k = 0; k < 3; k++) count *= (double)(cells->high[k] - cells->low[k] + 1);
  return count;
}

/* Different cells may share a slot. Visits only points of the cell itself, so that each point comes once. */
static bool is_in_cell(const sbfi_point_finder *finder, uint32_t point, int64_t x, int64_t y, int64_t z) {
  sbfi_d3 from_low = sbfi_d3_sub(sbfi_d3_of(finder->points[point]), finder->low);
  return (int64_t)floor(from_low.x / finder->cell) == x && (int64_t)floor(from_low.y / finder->cell) == y &&
         (int64_t)floor(from_low.z / finder->cell) == z;
}

typedef struct query {
  const sbfi_point_finder *finder;
  sbfi_d3 position;
  double max_squared; /* of distances; `visit` may lower it */
  void (*visit)(struct query *q, uint32_t point, double squared);
  void *user;
  uint32_t nearest;
} query;

static void visit_cell(query *q, int64_t x, int64_t y, int64_t z) {
  const sbfi_point_finder *finder = q->finder;
  uint32_t slot = slot_of(finder, x, y, z);
  for (uint32_t i = finder->starts[slot]; i < finder->starts[slot + 1]; i++) {
    uint32_t point = finder->items[i];
    double squared = squared_distance(&finder->points[point], q->position);
    if (squared <= q->max_squared && is_in_cell(finder, point, x, y, z)) q->visit(q, point, squared);
  }
}

/* Visits the points within the distance, each once. A query of more cells than points looks at all points
 * instead. */
static void run_query(query *q, double within) {
  const sbfi_point_finder *finder = q->finder;
  cell_range cells;
  if (!find_cells(finder, q->position, within * (1 + 1e-9), &cells)) return;
  if (count_cells(&cells) > finder->point_count) {
    for (uint32_t point = 0; point < finder->point_count; point++) {
      double squared = squared_distance(&finder->points[point], q->position);
      if (squared <= q->max_squared) q->visit(q, point, squared);
    }
    return;
  }
  for (int64_t z = cells.low[2]; z <= cells.high[2]; z++)
    for (int64_t y = cells.low[1]; y <= cells.high[1]; y++)
      for (int64_t x = cells.low[0]; x <= cells.high[0]; x++) visit_cell(q, x, y, z);
}

static void keep_nearest(query *q, uint32_t point, double squared) {
  if (squared == q->max_squared && point >= q->nearest) return;
  q->max_squared = squared;
  q->nearest = point;
}

uint32_t sbfi_point_nearest(
    const sbfi_point_finder *finder, sbfi_d3 position, double within, double *distance) {
  query q = {finder, position, within * within * (1 + 1e-12), keep_nearest, NULL, UINT32_MAX};
  run_query(&q, within);
  if (distance) *distance = q.nearest == UINT32_MAX ? within : sqrt(q.max_squared);
  return q.nearest;
}

typedef struct visitor {
  void (*visit)(void *user, uint32_t point);
  void *user;
} visitor;

static void pass_point(query *q, uint32_t point, double squared) {
  const visitor *v = q->user;
  (void)squared;
  v->visit(v->user, point);
}

void sbfi_find_points_near(const sbfi_point_finder *finder, sbfi_d3 position, double within,
    void (*visit)(void *user, uint32_t point), void *user) {
  visitor v = {visit, user};
  query q = {finder, position, within * within, pass_point, &v, UINT32_MAX};
  run_query(&q, within);
}
