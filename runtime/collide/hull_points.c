/* Quickhull: a tetrahedron grows by the point farthest outside of it until none is outside (C. B. Barber, D.
 * P. Dobkin and H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, 1996). Coordinates are integers, in
 * 2^20ths of the largest extent, so orientation tests are exact: coplanar, collinear and equal points need no
 * tolerance, and every hull is convex. */
#include "collide/hull_points.h"

#include <math.h>

enum { MAX_SIDES = 2 * SBRI_HULL_VERTICES - 4 };
static const uint32_t NONE = UINT32_MAX;
static const double STEPS = 1 << 20; /* products of three of them, summed, are below 2^63 */

/* ---- Whole numbers ---- */

typedef struct location {
  int64_t x, y, z;
} location;

static location less(location a, location b) {
  return (location){a.x - b.x, a.y - b.y, a.z - b.z};
}
static location cross(location a, location b) {
  return (location){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static int64_t dot(location a, location b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static double length(location a) {
  double x = (double)a.x, y = (double)a.y, z = (double)a.z;
  return sqrt(x * x + y * y + z * z);
}
static int64_t rounded(double x) {
  return (int64_t)(x < 0 ? x - 0.5 : x + 0.5);
}

/* ---- Growing ---- */

typedef struct side {
  uint32_t corners[3];
  location normal; /* twice its area, outwards */
  double size;
} side;

typedef struct growing {
  location *positions;
  double *height_of; /* of each place over its side, in steps */
  uint32_t *side_of; /* a face that each point is outside of; NONE: it is inside, or on the hull */
  uint32_t count, side_count;
  side sides[MAX_SIDES], seen[MAX_SIDES]; /* of the hull; and from the point that comes next */
} growing;

static side make_side(const location *positions, uint32_t a, uint32_t b, uint32_t c) {
  side made = {.corners = {a, b, c},
      .normal = cross(less(positions[b], positions[a]), less(positions[c], positions[a]))};
  made.size = length(made.normal);
  return made;
}

/* Above 0 outside; how far, times the side's size. */
static int64_t over(const location *positions, const side *s, uint32_t point) {
  return dot(s->normal, less(positions[point], positions[s->corners[0]]));
}

/* Of the sides from `first` on, the one that a point is the furthest outside of. */
static void check(growing *g, uint32_t point, uint32_t first) {
  g->side_of[point] = NONE;
  g->height_of[point] = 0;
  for (uint32_t i = first; i < g->side_count; i++) {
    double height = (double)over(g->positions, &g->sides[i], point) / g->sides[i].size;
    if (height > g->height_of[point]) g->height_of[point] = height, g->side_of[point] = i;
  }
}

/* The place that `measure` is the greatest of; NONE where it is 0 of all. */
static uint32_t furthest(
    const growing *g, double (*measure)(const location *, const uint32_t *, uint32_t), const uint32_t *from) {
  uint32_t best = NONE;
  double max = 0;
  for (uint32_t i = 0; i < g->count; i++) {
    double now = measure(g->positions, from, i);
    if (now > max) max = now, best = i;
  }
  return best;
}
static double from_point(const location *p, const uint32_t *from, uint32_t i) {
  return length(less(p[i], p[from[0]]));
}
static double from_line(const location *p, const uint32_t *from, uint32_t i) {
  return length(cross(less(p[from[1]], p[from[0]]), less(p[i], p[from[0]])));
}
static double from_plane(const location *p, const uint32_t *from, uint32_t i) {
  side s = make_side(p, from[0], from[1], from[2]);
  return fabs((double)over(p, &s, i));
}

/* False where all lie in a plane. */
static bool begin(growing *g) {
  uint32_t c[4] = {0};
  double (*const measures[3])(const location *, const uint32_t *, uint32_t) = {
      from_point, from_line, from_plane};
  if (!g->count) return false;
  for (uint32_t i = 0; i < 3; i++) {
    c[i + 1] = furthest(g, measures[i], c);
    if (c[i + 1] == NONE) return false;
    if (i == 0) c[0] = furthest(g, from_point, &c[1]);
  }
  side s = make_side(g->positions, c[0], c[1], c[2]);
  if (over(g->positions, &s, c[3]) > 0) {
    uint32_t b = c[1];
    c[1] = c[2], c[2] = b;
  }
  const uint32_t corners[4][3] = {
      {c[0], c[1], c[2]}, {c[0], c[3], c[1]}, {c[1], c[3], c[2]}, {c[2], c[3], c[0]}};
  for (uint32_t i = 0; i < 4; i++)
    g->sides[i] = make_side(g->positions, corners[i][0], corners[i][1], corners[i][2]);
  g->side_count = 4;
  for (uint32_t i = 0; i < g->count; i++) check(g, i, 0);
  return true;
}

static bool has_edge(const side *s, uint32_t a, uint32_t b) {
  for (uint32_t i = 0; i < 3; i++)
    if (s->corners[i] == a && s->corners[(i + 1) % 3] == b) return true;
  return false;
}

/* New faces from the horizon to the point: from edges between a visible and an invisible face. */
static void join(growing *g, uint32_t point, uint32_t seen_count) {
  for (uint32_t i = 0; i < 3 * seen_count; i++) {
    uint32_t a = g->seen[i / 3].corners[i % 3], b = g->seen[i / 3].corners[(i % 3 + 1) % 3], k = 0;
    while (k < seen_count && !has_edge(&g->seen[k], b, a)) k++;
    if (k == seen_count) g->sides[g->side_count++] = make_side(g->positions, a, b, point);
  }
}

static void add(growing *g, uint32_t point) {
  uint32_t new_of[MAX_SIDES], seen_count = 0, kept = 0;
  for (uint32_t i = 0; i < g->side_count; i++) {
    side s = g->sides[i];
    bool seen = over(g->positions, &s, point) > 0;
    new_of[i] = seen ? NONE : kept;
    *(seen ? &g->seen[seen_count++] : &g->sides[kept++]) = s;
  }
  g->side_count = kept;
  join(g, point, seen_count);
  for (uint32_t i = 0; i < g->count; i++) {
    if (g->side_of[i] == NONE) continue;
    g->side_of[i] = new_of[g->side_of[i]];
    if (g->side_of[i] == NONE) check(g, i, kept);
  }
}

static void grow(growing *g) {
  for (uint32_t vertices = 4; vertices < SBRI_HULL_VERTICES; vertices++) {
    uint32_t next = NONE;
    double max = 0;
    for (uint32_t i = 0; i < g->count; i++)
      if (g->side_of[i] != NONE && g->height_of[i] > max) max = g->height_of[i], next = i;
    if (next == NONE) return;
    add(g, next);
  }
}

/* ---- From and to metres ---- */

/* A step is a power of two, so that what is rounded to one is a float again. */
static double count_steps(growing *g, const sbf_vec3 *points, location *low) {
  double min[3] = {INFINITY, INFINITY, INFINITY}, extent = 0, step = 1;
  for (int k = 0; k < 3; k++) {
    double max = -INFINITY;
    for (uint32_t i = 0; i < g->count; i++) {
      double x = (double)(k == 0 ? points[i].x : k == 1 ? points[i].y : points[i].z);
      min[k] = x < min[k] ? x : min[k], max = x > max ? x : max;
    }
    extent = fmax(extent, max - min[k]);
  }
  if (!(extent > 0)) return 0;
  while (extent > (STEPS - 1) * step) step *= 2;
  while (extent <= (STEPS - 1) * step / 2) step /= 2;
  *low = (location){rounded(min[0] / step), rounded(min[1] / step), rounded(min[2] / step)};
  for (uint32_t i = 0; i < g->count; i++) {
    location at = {rounded((double)points[i].x / step), rounded((double)points[i].y / step),
        rounded((double)points[i].z / step)};
    g->positions[i] = less(at, *low);
  }
  return step;
}

static bool write(const growing *g, double step, location low, sbri_point_hull *hull, sbfi_arena *arena) {
  uint32_t written[SBRI_HULL_VERTICES];
  hull->vertices = sbfi_arena_allocate(arena, SBRI_HULL_VERTICES, sizeof *hull->vertices);
  hull->corners = sbfi_arena_allocate(arena, 3 * (size_t)g->side_count, sizeof *hull->corners);
  if (!hull->vertices || !hull->corners) return false;
  for (uint32_t i = 0; i < 3 * g->side_count; i++) {
    uint32_t point = g->sides[i / 3].corners[i % 3], v = 0;
    while (v < hull->vertex_count && written[v] != point) v++;
    hull->corners[i] = v;
    if (v < hull->vertex_count) continue;
    location p = g->positions[point];
    written[hull->vertex_count++] = point;
    hull->vertices[v] = (sbf_vec3){(float)((double)(p.x + low.x) * step),
        (float)((double)(p.y + low.y) * step), (float)((double)(p.z + low.z) * step)};
  }
  hull->triangle_count = g->side_count;
  return true;
}

bool sbri_hull_of_points(sbri_point_hull *hull, const sbf_vec3 *points, uint32_t count, sbfi_arena *arena) {
  *hull = (sbri_point_hull){0};
  growing *g = sbfi_arena_allocate(arena, 1, sizeof *g);
  if (!g) return false;
  *g = (growing){.count = count};
  g->positions = sbfi_arena_allocate(arena, count, sizeof *g->positions);
  g->height_of = sbfi_arena_allocate(arena, count, sizeof *g->height_of);
  g->side_of = sbfi_arena_allocate(arena, count, sizeof *g->side_of);
  if (!g->positions || !g->height_of || !g->side_of) return false;
  location low = {0};
  double step = count_steps(g, points, &low);
  if (!(step > 0) || !begin(g)) return true;
  grow(g);
  return write(g, step, low, hull, arena);
}
