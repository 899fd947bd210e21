/* Quickhull: a tetrahedron grows by the point farthest outside it until none is outside (C. B. Barber, D. P.
 * Dobkin and H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, 1996). Coordinates are integers, in
 * 2^20ths of the largest extent, so orientation tests are exact: coplanar, collinear and equal points need no
 * tolerance, and every hull is convex. */
#include "shapes/hull_points.h"

#include <math.h>

enum { MAX_FACES = 2 * SBRI_HULL_VERTICES - 4 };
static const uint32_t NONE = UINT32_MAX;
static const double STEPS = 1 << 20; /* sums of products of three of them are below 2^63 */

/* ---- Integer vectors ---- */

typedef struct int3 {
  int64_t x, y, z;
} int3;

static int3 less(int3 a, int3 b) {
  return (int3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static int3 cross(int3 a, int3 b) {
  return (int3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static int64_t dot(int3 a, int3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static double length(int3 a) {
  double x = (double)a.x, y = (double)a.y, z = (double)a.z;
  return sqrt(x * x + y * y + z * z);
}
static int64_t rounded(double x) {
  return (int64_t)(x < 0 ? x - 0.5 : x + 0.5);
}

/* ---- Growth ---- */

typedef struct face {
  uint32_t corners[3];
  int3 normal; /* twice the area, outwards */
  double size;
} face;

typedef struct hull_growth {
  int3 *positions;
  double *height_of; /* of each point above its face, in steps */
  uint32_t *face_of; /* a face with the point outside; NONE: the point is inside, or on the hull */
  uint32_t count, face_count;
  face faces[MAX_FACES], visible[MAX_FACES]; /* of the hull; those visible from the next point */
} hull_growth;

static face make_face(const int3 *positions, uint32_t a, uint32_t b, uint32_t c) {
  face made = {.corners = {a, b, c},
      .normal = cross(less(positions[b], positions[a]), less(positions[c], positions[a]))};
  made.size = length(made.normal);
  return made;
}

/* Height above the face times its size; positive outside. */
static int64_t height_above(const int3 *positions, const face *s, uint32_t point) {
  return dot(s->normal, less(positions[point], positions[s->corners[0]]));
}

/* Finds the face from `first` on that a point is farthest outside of. */
static void check(hull_growth *g, uint32_t point, uint32_t first) {
  g->face_of[point] = NONE;
  g->height_of[point] = 0;
  for (uint32_t i = first; i < g->face_count; i++) {
    double height = (double)height_above(g->positions, &g->faces[i], point) / g->faces[i].size;
    if (height > g->height_of[point]) g->height_of[point] = height, g->face_of[point] = i;
  }
}

/* The point with the largest `measure`; NONE if all are 0. */
static uint32_t furthest(
    const hull_growth *g, double (*measure)(const int3 *, const uint32_t *, uint32_t), const uint32_t *from) {
  uint32_t best = NONE;
  double max = 0;
  for (uint32_t i = 0; i < g->count; i++) {
    double value = measure(g->positions, from, i);
    if (value > max) max = value, best = i;
  }
  return best;
}
static double from_point(const int3 *p, const uint32_t *from, uint32_t i) {
  return length(less(p[i], p[from[0]]));
}
static double from_line(const int3 *p, const uint32_t *from, uint32_t i) {
  return length(cross(less(p[from[1]], p[from[0]]), less(p[i], p[from[0]])));
}
static double from_plane(const int3 *p, const uint32_t *from, uint32_t i) {
  face s = make_face(p, from[0], from[1], from[2]);
  return fabs((double)height_above(p, &s, i));
}

/* Returns false if all points are in a plane. */
static bool begin(hull_growth *g) {
  uint32_t c[4] = {0};
  double (*const measures[3])(const int3 *, const uint32_t *, uint32_t) = {from_point, from_line, from_plane};
  if (!g->count) return false;
  for (uint32_t i = 0; i < 3; i++) {
    c[i + 1] = furthest(g, measures[i], c);
    if (c[i + 1] == NONE) return false;
    if (i == 0) c[0] = furthest(g, from_point, &c[1]);
  }
  face s = make_face(g->positions, c[0], c[1], c[2]);
  if (height_above(g->positions, &s, c[3]) > 0) {
    uint32_t b = c[1];
    c[1] = c[2], c[2] = b;
  }
  const uint32_t corners[4][3] = {
      {c[0], c[1], c[2]}, {c[0], c[3], c[1]}, {c[1], c[3], c[2]}, {c[2], c[3], c[0]}};
  for (uint32_t i = 0; i < 4; i++)
    g->faces[i] = make_face(g->positions, corners[i][0], corners[i][1], corners[i][2]);
  g->face_count = 4;
  for (uint32_t i = 0; i < g->count; i++) check(g, i, 0);
  return true;
}

static bool has_edge(const face *s, uint32_t a, uint32_t b) {
  for (uint32_t i = 0; i < 3; i++)
    if (s->corners[i] == a && s->corners[(i + 1) % 3] == b) return true;
  return false;
}

/* Adds faces from the point to the horizon, the edges between visible and invisible faces. */
static void add_horizon_faces(hull_growth *g, uint32_t point, uint32_t visible_count) {
  for (uint32_t i = 0; i < 3 * visible_count; i++) {
    uint32_t a = g->visible[i / 3].corners[i % 3], b = g->visible[i / 3].corners[(i % 3 + 1) % 3], k = 0;
    while (k < visible_count && !has_edge(&g->visible[k], b, a)) k++;
    if (k == visible_count) g->faces[g->face_count++] = make_face(g->positions, a, b, point);
  }
}

static void add(hull_growth *g, uint32_t point) {
  uint32_t new_of[MAX_FACES], visible_count = 0, face_count = 0;
  for (uint32_t i = 0; i < g->face_count; i++) {
    face s = g->faces[i];
    bool visible = height_above(g->positions, &s, point) > 0;
    new_of[i] = visible ? NONE : face_count;
    *(visible ? &g->visible[visible_count++] : &g->faces[face_count++]) = s;
  }
  g->face_count = face_count;
  add_horizon_faces(g, point, visible_count);
  for (uint32_t i = 0; i < g->count; i++) {
    if (g->face_of[i] == NONE) continue;
    g->face_of[i] = new_of[g->face_of[i]];
    if (g->face_of[i] == NONE) check(g, i, face_count);
  }
}

static void grow(hull_growth *g) {
  for (uint32_t vertices = 4; vertices < SBRI_HULL_VERTICES; vertices++) {
    uint32_t next = NONE;
    double max = 0;
    for (uint32_t i = 0; i < g->count; i++)
      if (g->face_of[i] != NONE && g->height_of[i] > max) max = g->height_of[i], next = i;
    if (next == NONE) return;
    add(g, next);
  }
}

/* ---- Conversion from and to metres ---- */

/* A step is a power of two, so that multiples of it are exact floats. */
static double count_steps(hull_growth *g, const sbf_vec3 *points, int3 *low) {
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
  *low = (int3){rounded(min[0] / step), rounded(min[1] / step), rounded(min[2] / step)};
  for (uint32_t i = 0; i < g->count; i++) {
    int3 at = {rounded((double)points[i].x / step), rounded((double)points[i].y / step),
        rounded((double)points[i].z / step)};
    g->positions[i] = less(at, *low);
  }
  return step;
}

static bool write(const hull_growth *g, double step, int3 low, sbri_point_hull *hull, sbfi_arena *arena) {
  uint32_t written[SBRI_HULL_VERTICES];
  hull->vertices = sbfi_arena_allocate(arena, SBRI_HULL_VERTICES, sizeof *hull->vertices);
  hull->corners = sbfi_arena_allocate(arena, 3 * (size_t)g->face_count, sizeof *hull->corners);
  if (!hull->vertices || !hull->corners) return false;
  for (uint32_t i = 0; i < 3 * g->face_count; i++) {
    uint32_t point = g->faces[i / 3].corners[i % 3], v = 0;
    while (v < hull->vertex_count && written[v] != point) v++;
    hull->corners[i] = v;
    if (v < hull->vertex_count) continue;
    int3 p = g->positions[point];
    written[hull->vertex_count++] = point;
    hull->vertices[v] = (sbf_vec3){(float)((double)(p.x + low.x) * step),
        (float)((double)(p.y + low.y) * step), (float)((double)(p.z + low.z) * step)};
  }
  hull->triangle_count = g->face_count;
  return true;
}

bool sbri_hull_of_points(sbri_point_hull *hull, const sbf_vec3 *points, uint32_t count, sbfi_arena *arena) {
  *hull = (sbri_point_hull){0};
  hull_growth *g = sbfi_arena_allocate(arena, 1, sizeof *g);
  if (!g) return false;
  *g = (hull_growth){.count = count};
  g->positions = sbfi_arena_allocate(arena, count, sizeof *g->positions);
  g->height_of = sbfi_arena_allocate(arena, count, sizeof *g->height_of);
  g->face_of = sbfi_arena_allocate(arena, count, sizeof *g->face_of);
  if (!g->positions || !g->height_of || !g->face_of) return false;
  int3 low = {0};
  double step = count_steps(g, points, &low);
  if (!(step > 0) || !begin(g)) return true;
  grow(g);
  return write(g, step, low, hull, arena);
}
