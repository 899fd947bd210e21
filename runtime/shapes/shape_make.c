/* Builds shapes from the host's definitions. */
#include <math.h>
#include <string.h>

#include "base/diagnostic.h"
#include "shapes/hull_points.h"
#include "shapes/shape_ridges.h"

enum { SHAPE_COOKIE = 0x5b727368 };

/* Extent of a plane, m. */
static const float FAR_M = 1e9f;

sbr_shape_definition sbr_default_shape_definition(void) {
  return (sbr_shape_definition){
      .cookie = SHAPE_COOKIE, .kind = SBR_SHAPE_SPHERE, .radius = 0.5f, .half_sizes = {0.5f, 0.5f, 0.5f}};
}

static bool make_hull(sbr_shape *s, const sbf_vec3 *points, uint32_t point_count, const uint32_t *sizes,
    uint32_t face_count, const uint32_t *corners) {
  sbf_vec3 *own = sbfi_arena_allocate(&s->arena, point_count, sizeof *own);
  if (!own) return false;
  memcpy(own, points, point_count * sizeof *own);
  if (!sbri_hull_make(&s->hull, own, point_count, sizes, face_count, corners, &s->arena)) return false;
  s->bounds = sbri_box_of_point(points[0]);
  for (uint32_t i = 1; i < point_count; i++) s->bounds = sbri_box_with(s->bounds, points[i]);
  return true;
}

static bool make_box(sbr_shape *s) {
  static const uint32_t corners[24] = {
      0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  static const uint32_t sizes[6] = {4, 4, 4, 4, 4, 4};
  sbf_vec3 points[8], h = s->half_sizes;
  for (int i = 0; i < 8; i++)
    points[i] = sbri_vec3(i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z);
  return make_hull(s, points, 8, sizes, 6, corners);
}

static bool make_hull_of_triangles(sbr_shape *s, const sbf_vec3 *points, uint32_t point_count,
    const uint32_t *triangles, uint32_t triangle_count) {
  uint32_t *sizes = sbfi_arena_allocate(&s->arena, triangle_count, sizeof *sizes);
  if (!sizes) return false;
  for (uint32_t i = 0; i < triangle_count; i++) sizes[i] = 3;
  return make_hull(s, points, point_count, sizes, triangle_count, triangles);
}

/* Without triangles, builds the convex hull of the points. Coplanar points give an empty hull. */
static bool make_convex(sbr_shape *s, const sbr_shape_definition *d) {
  if (d->triangle_count)
    return make_hull_of_triangles(s, d->points, d->point_count, d->triangles, d->triangle_count);
  sbri_point_hull hull;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &s->allocator, 0);
  bool good = sbri_hull_of_points(&hull, d->points, d->point_count, &scratch) &&
              (!hull.triangle_count || make_hull_of_triangles(s, hull.vertices, hull.vertex_count,
                                           hull.corners, hull.triangle_count));
  sbfi_arena_free(&scratch);
  return good;
}

/* Builds the tree of triangles that the shape already owns. */
static bool make_tree(sbr_shape *s) {
  sbri_triangles *t = &s->triangles;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &s->allocator, 0);
  sbri_box *boxes = sbfi_arena_allocate(&scratch, t->count, sizeof *boxes);
  t->tree.nodes = sbfi_arena_allocate(&s->arena, sbri_bounds_tree_nodes(t->count), sizeof *t->tree.nodes);
  t->tree.items = sbfi_arena_allocate(&s->arena, t->count, sizeof *t->tree.items);
  bool good = boxes && t->tree.nodes && t->tree.items;
  for (uint32_t i = 0; good && i < t->count; i++) {
    const uint32_t *c = t->corners + 3 * (size_t)i;
    boxes[i] =
        sbri_box_with(sbri_box_with(sbri_box_of_point(t->points[c[0]]), t->points[c[1]]), t->points[c[2]]);
  }
  if (good) sbri_bounds_tree_make(&t->tree, boxes, t->count);
  if (good) s->bounds = t->tree.nodes[0].box;
  sbfi_arena_free(&scratch);
  return good;
}

static bool make_mesh(sbr_shape *s, const sbr_shape_definition *d) {
  sbf_vec3 *points = sbfi_arena_allocate(&s->arena, d->point_count, sizeof *points);
  uint32_t *corners = sbfi_arena_allocate(&s->arena, d->triangle_count, 3 * sizeof *corners);
  if (!points || !corners) return false;
  memcpy(points, d->points, d->point_count * sizeof *points);
  memcpy(corners, d->triangles, 3 * (size_t)d->triangle_count * sizeof *corners);
  s->triangles = (sbri_triangles){.points = points, .corners = corners, .count = d->triangle_count};
  return make_tree(s);
}

static bool make_height_field(sbr_shape *s, const sbr_height_field *f) {
  size_t count = (size_t)f->columns * f->rows, cells = (size_t)(f->columns - 1) * (f->rows - 1);
  sbf_vec3 *points = sbfi_arena_allocate(&s->arena, count, sizeof *points);
  uint32_t *corners = sbfi_arena_allocate(&s->arena, cells, 6 * sizeof *corners), *to = corners;
  if (!points || !corners) return false;
  for (uint32_t row = 0; row < f->rows; row++)
    for (uint32_t column = 0; column < f->columns; column++)
      points[(size_t)row * f->columns + column] = sbri_vec3((float)(f->x + column * f->cell_m),
          f->heights_m[(size_t)row * f->columns + column], (float)(f->z + row * f->cell_m));
  for (uint32_t row = 0; row + 1 < f->rows; row++)
    for (uint32_t column = 0; column + 1 < f->columns; column++, to += 6) {
      uint32_t a = row * f->columns + column, b = a + 1, c = a + f->columns, e = c + 1;
      const uint32_t cell[6] = {a, c, b, b, c, e};
      memcpy(to, cell, sizeof cell);
    }
  s->triangles = (sbri_triangles){.points = points, .corners = corners, .count = 2 * (uint32_t)cells};
  return make_tree(s);
}

static const char *fault_of(const sbr_shape_definition *d) {
  bool sized = d->kind != SBR_SHAPE_SPHERE && d->kind != SBR_SHAPE_CAPSULE;
  const sbf_vec3 *h = &d->half_sizes;
  if (!sized && !(d->radius > 0 && d->radius < FAR_M)) return "a radius must be above 0";
  if (d->kind == SBR_SHAPE_CAPSULE && !(h->y >= 0 && h->y < FAR_M)) return "half_sizes.y must not be below 0";
  if (d->kind == SBR_SHAPE_BOX && !(h->x > 0 && h->y > 0 && h->z > 0 && h->x + h->y + h->z < FAR_M))
    return "half_sizes must be above 0";
  if (d->kind == SBR_SHAPE_HEIGHT_FIELD) {
    const sbr_height_field *f = d->heights;
    return !f || !f->heights_m || f->columns < 2 || f->rows < 2 || !(f->cell_m > 0) ||
                   (uint64_t)f->columns * f->rows > UINT32_MAX / 2
               ? "a height field needs at least two columns and rows, and a cell size above 0"
               : NULL;
  }
  if (d->kind == SBR_SHAPE_HOST)
    return d->host.distance ? NULL : "a shape of the host needs a distance function";
  if (d->kind != SBR_SHAPE_HULL && d->kind != SBR_SHAPE_MESH) return NULL;
  bool of_points = d->kind == SBR_SHAPE_HULL && !d->triangle_count;
  if (!d->points || !d->point_count) return "there are no points";
  if (!of_points && (!d->triangles || !d->triangle_count)) return "there are no triangles";
  for (uint32_t i = 0; of_points && i < d->point_count; i++) {
    sbf_vec3 p = d->points[i];
    if (!(fabsf(p.x) < FAR_M && fabsf(p.y) < FAR_M && fabsf(p.z) < FAR_M))
      return "a point is not finite or exceeds 10^9";
  }
  for (size_t i = 0; i < 3 * (size_t)d->triangle_count; i++)
    if (d->triangles[i] >= d->point_count) return "a triangle names a point that does not exist";
  return NULL;
}

static bool make(sbr_shape *s, const sbr_shape_definition *d) {
  float r = s->radius;
  switch (s->kind) {
  case SBR_SHAPE_PLANE:
    s->bounds = (sbri_box){{-FAR_M, -FAR_M, -FAR_M}, {FAR_M, 0, FAR_M}};
    return true;
  case SBR_SHAPE_SPHERE:
    s->bounds = (sbri_box){{-r, -r, -r}, {r, r, r}};
    return true;
  case SBR_SHAPE_CAPSULE:
    s->bounds = (sbri_box){{-r, -r - s->half_sizes.y, -r}, {r, r + s->half_sizes.y, r}};
    return true;
  case SBR_SHAPE_BOX:
    return make_box(s);
  case SBR_SHAPE_HULL:
    return make_convex(s, d);
  case SBR_SHAPE_MESH:
    return make_mesh(s, d);
  case SBR_SHAPE_HEIGHT_FIELD:
    return make_height_field(s, d->heights);
  case SBR_SHAPE_HOST:
    s->bounds = (sbri_box){s->host.low, s->host.high};
    return true;
  }
  return false;
}

sbf_status sbr_shape_create(const sbf_allocator *allocator, const sbr_shape_definition *definition,
    sbr_shape **shape, sbf_diagnostic *error) {
  if (!definition || !shape || definition->cookie != SHAPE_COOKIE ||
      (unsigned)definition->kind > SBR_SHAPE_HOST)
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "sbr_shape_create: begin the definition with sbr_default_shape_definition");
  *shape = NULL;
  const char *fault = fault_of(definition);
  if (fault) return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_shape_create: %s", fault);
  sbf_allocator use = sbfi_allocator_or_default(allocator);
  sbr_shape *s = sbfi_allocate(&use, sizeof *s);
  if (!s) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for a shape");
  *s = (sbr_shape){.allocator = use,
      .kind = definition->kind,
      .host = definition->host,
      .radius = definition->radius,
      .half_sizes = definition->half_sizes};
  sbfi_arena_init(&s->arena, &s->allocator, 0);
  bool made = make(s, definition) && sbri_shape_ridges_make(s);
  if (made && (s->kind != SBR_SHAPE_HULL || s->hull.face_count >= 4)) {
    *shape = s;
    return SBF_OK;
  }
  sbr_shape_destroy(s);
  return made ? sbfi_diagnose(error, SBF_CODE_BAD_CALL,
                    "sbr_shape_create: the points of the hull are in one plane: add points outside it")
              : sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for a shape");
}

void sbr_shape_destroy(sbr_shape *shape) {
  if (!shape) return;
  sbf_allocator allocator = shape->allocator;
  sbfi_arena_free(&shape->arena);
  sbfi_free(&allocator, shape, sizeof *shape);
}
