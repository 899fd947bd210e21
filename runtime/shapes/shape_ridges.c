/* Convex edges of polyhedral shapes, for contacts with edges of soft bodies. */
#include "shapes/shape_ridges.h"

#include "math/vec3.h"
#include "shapes/sides.h"

/* Maximum penetration that still leaves over a ridge, as a fraction of the hull's thickness. */
static const float PAST_FRACTION = 0.5f;

static bool is_flat(sbf_vec3 a, sbf_vec3 b) {
  float both = sbri_dot(a, b);
  return both > 0 && both * both >= SBRI_BENT * sbri_dot(a, a) * sbri_dot(b, b);
}

/* Orders the normals about the edge. */
static sbri_shape_ridge ridge_of(sbf_vec3 a, sbf_vec3 b, sbf_vec3 normal, sbf_vec3 other) {
  bool turned = sbri_dot(sbri_cross(normal, other), sbri_sub(b, a)) < 0;
  return (sbri_shape_ridge){{a, b}, {turned ? other : normal, turned ? normal : other}};
}

static uint32_t ridges_of_hull(const sbri_hull *hull, sbri_shape_ridge *to) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < hull->edge_count; i++) {
    const sbri_hull_edge *e = &hull->edges[i];
    if (!is_flat(e->normals[0], e->normals[1]))
      to[count++] =
          ridge_of(hull->vertices[e->ends[0]], hull->vertices[e->ends[1]], e->normals[0], e->normals[1]);
  }
  return count;
}

static float thickness_of(const sbri_hull *hull) {
  float min = INFINITY;
  for (uint32_t f = 0; f < hull->face_count; f++) {
    const sbri_hull_face *face = &hull->faces[f];
    sbf_vec3 far = hull->vertices[sbri_hull_support(hull, sbri_scale(face->normal, -1))];
    min = fminf(min, face->offset - sbri_dot(face->normal, far));
  }
  return min;
}

static uint32_t ridges_of_mesh(const sbri_triangles *t, const uint32_t *sides, sbri_shape_ridge *to) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < 3 * t->count; i++) {
    if (sides[i] == SBRI_RIM || sides[i] == SBRI_SAME_SIDE) continue;
    const uint32_t *c = t->corners + i / 3 * 3;
    sbf_vec3 a = t->points[c[i % 3]], b = t->points[c[(i + 1) % 3]], own = t->points[c[(i + 2) % 3]],
             other = t->points[sides[i]];
    sbf_vec3 n = sbri_triangle_normal(a, b, own), m = sbri_triangle_normal(b, a, other);
    bool any = sbri_dot(n, n) > 0 && sbri_dot(m, m) > 0;
    if (any && !is_flat(n, m) && sbri_dot(n, sbri_sub(other, a)) < 0) to[count++] = ridge_of(a, b, n, m);
  }
  return count;
}

static bool make_tree(sbr_shape *s, sbfi_arena *scratch) {
  sbri_shape_ridges *r = &s->ridges;
  sbri_box *boxes = sbfi_arena_allocate(scratch, r->count, sizeof *boxes);
  r->tree.nodes = sbfi_arena_allocate(&s->arena, sbri_bounds_tree_nodes(r->count), sizeof *r->tree.nodes);
  r->tree.items = sbfi_arena_allocate(&s->arena, r->count, sizeof *r->tree.items);
  if (!boxes || !r->tree.nodes || !r->tree.items) return false;
  for (uint32_t i = 0; i < r->count; i++)
    boxes[i] = sbri_box_with(sbri_box_of_point(r->at[i].at[0]), r->at[i].at[1]);
  sbri_bounds_tree_make(&r->tree, boxes, r->count);
  return true;
}

static bool make(sbr_shape *s, sbfi_arena *scratch) {
  const sbri_triangles *t = &s->triangles;
  bool is_mesh = s->kind == SBR_SHAPE_MESH;
  size_t max = is_mesh ? 3 * (size_t)t->count : s->hull.edge_count;
  sbri_shape_ridge *all = sbfi_arena_allocate(scratch, max + 1, sizeof *all);
  if (!all) return false;
  if (is_mesh) {
    uint32_t *sides = sbfi_arena_allocate(scratch, max + 1, sizeof *sides);
    uint32_t *table = sbfi_arena_allocate(scratch, sbri_sides_table(t->count), sizeof *table);
    if (!sides || !table) return false;
    sbri_sides_find(t->corners, t->count, sides, table);
    s->ridges.count = ridges_of_mesh(t, sides, all);
  } else {
    s->ridges.count = ridges_of_hull(&s->hull, all);
    s->ridges.past_m = PAST_FRACTION * thickness_of(&s->hull);
  }
  if (!s->ridges.count) return true;
  sbri_shape_ridge *kept = sbfi_arena_allocate(&s->arena, s->ridges.count, sizeof *kept);
  if (!kept) return false;
  for (uint32_t i = 0; i < s->ridges.count; i++) kept[i] = all[i];
  s->ridges.at = kept;
  return make_tree(s, scratch);
}

bool sbri_shape_ridges_make(sbr_shape *s) {
  sbfi_arena scratch;
  if (s->kind != SBR_SHAPE_BOX && s->kind != SBR_SHAPE_HULL && s->kind != SBR_SHAPE_MESH) return true;
  sbfi_arena_init(&scratch, &s->allocator, 0);
  bool good = make(s, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
