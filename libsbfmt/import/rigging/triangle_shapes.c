#include "import/rigging/triangle_shapes.h"

#include <math.h>

/* Tolerance of side ratios for equal shapes. */
static const double TOLERANCE = 1e-3;
enum { CELLS_ASIDE = 500 };

static bool shape_of(const sbf_vec3 *at, const uint32_t points[3], sbfi_shaped_triangle *to) {
  double sides[3]; /* opposite each corner */
  int order[3] = {0, 1, 2};
  for (int k = 0; k < 3; k++) {
    sbfi_d3 a = sbfi_d3_of(at[points[(k + 1) % 3]]), b = sbfi_d3_of(at[points[(k + 2) % 3]]);
    sides[k] = sbfi_d3_length(sbfi_d3_sub(b, a));
  }
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 2 - i; k++)
      if (sides[order[k]] < sides[order[k + 1]]) {
        int other = order[k];
        order[k] = order[k + 1];
        order[k + 1] = other;
      }
  double longest = sides[order[0]], middle = sides[order[1]], shortest = sides[order[2]];
  if (!(longest > 0)) return false;
  *to = (sbfi_shaped_triangle){{points[order[0]], points[order[1]], points[order[2]]},
      (float)(middle / longest), (float)(shortest / longest), (float)longest};
  static const double separation = 8e-3, flat = 0.02;
  return longest - middle > separation * longest && middle - shortest > separation * longest &&
         middle + shortest - longest > flat * longest;
}

static uint32_t cell_of(const sbfi_shaped_triangle *t, int aside, int below) {
  int x = (int)(t->middle * CELLS_ASIDE) + aside, y = (int)(t->shortest * CELLS_ASIDE) + below;
  x = x < 0 ? 0 : x >= CELLS_ASIDE ? CELLS_ASIDE - 1 : x;
  y = y < 0 ? 0 : y >= CELLS_ASIDE ? CELLS_ASIDE - 1 : y;
  return (uint32_t)(x * CELLS_ASIDE + y);
}

typedef struct collecting {
  sbfi_triangle_shapes *to;
  const sbf_vec3 *at;
  bool filling;
} collecting;

static void collect(collecting *c, uint32_t i, uint32_t k, uint32_t l) {
  sbfi_shaped_triangle t;
  const uint32_t points[3] = {i, k, l};
  if (!shape_of(c->at, points, &t)) return;
  uint32_t *cursor = &c->to->cell_starts[cell_of(&t, 0, 0)];
  if (c->filling)
    c->to->triangles[--*cursor] = t;
  else
    ++*cursor;
}

static void collect_all(collecting *c, const sbf_polygon_mesh *m) {
  for (uint32_t p = 0, at = 0; p < m->polygon_sizes.count; at += m->polygon_sizes.at[p++]) {
    const uint32_t *q = m->polygon_points.at + at, size = m->polygon_sizes.at[p];
    for (uint32_t k = 2; k < size; k++) collect(c, q[0], q[k - 1], q[k]);
    if (size != 4) continue;
    collect(c, q[0], q[1], q[3]);
    collect(c, q[1], q[2], q[3]);
  }
}

bool sbfi_triangle_shapes_make(
    sbfi_triangle_shapes *shapes, const sbfi_scene_surface *surface, sbfi_arena *arena) {
  uint32_t cells = CELLS_ASIDE * CELLS_ASIDE;
  collecting c = {shapes, surface->mesh.positions.at, false};
  *shapes = (sbfi_triangle_shapes){0};
  shapes->cell_starts = sbfi_arena_allocate(arena, cells + 1, sizeof *shapes->cell_starts);
  if (!shapes->cell_starts) return false;
  collect_all(&c, &surface->mesh);
  for (uint32_t i = 0; i < cells; i++) {
    shapes->count += shapes->cell_starts[i];
    shapes->cell_starts[i] = shapes->count; /* the end; filling moves it back to the start */
  }
  shapes->cell_starts[cells] = shapes->count;
  shapes->triangles = sbfi_arena_allocate(arena, shapes->count + 1, sizeof *shapes->triangles);
  if (!shapes->triangles) return false;
  c.filling = true;
  collect_all(&c, &surface->mesh);
  return true;
}

uint32_t sbfi_triangle_shapes_count(const sbfi_triangle_shapes *shapes, const sbfi_shaped_triangle *like) {
  uint32_t count = 0;
  for (int x = -1; x <= 1; x++)
    for (int y = -1; y <= 1; y++) {
      uint32_t cell = cell_of(like, x, y);
      count += shapes->cell_starts[cell + 1] - shapes->cell_starts[cell];
    }
  return count;
}

void sbfi_triangle_shapes_find(const sbfi_triangle_shapes *shapes, const sbfi_shaped_triangle *like,
    bool (*visit)(void *user, const sbfi_shaped_triangle *triangle), void *user) {
  for (int x = -1; x <= 1; x++)
    for (int y = -1; y <= 1; y++) {
      uint32_t cell = cell_of(like, x, y);
      for (uint32_t i = shapes->cell_starts[cell]; i < shapes->cell_starts[cell + 1]; i++) {
        const sbfi_shaped_triangle *t = &shapes->triangles[i];
        if (fabs((double)t->middle - (double)like->middle) < TOLERANCE &&
            fabs((double)t->shortest - (double)like->shortest) < TOLERANCE && !visit(user, t))
          return;
      }
    }
}
