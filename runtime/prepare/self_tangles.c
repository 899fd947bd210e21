/* Whether a surface intersects itself at rest. Its intersections are then not resolved. */
#include "prepare/prepare.h"
#include "shapes/bounds_tree.h"
#include "shapes/sides.h"
#include "shapes/triangle.h"

/* Fractions of an edge and of a triangle: smaller intersections at rest count as contact. */
static const float WITHIN = 1e-3f;

typedef struct surface {
  const sbri_body *body;
  const sbri_point *rest;
  sbri_bounds_tree tree;
  sbri_box *boxes;
} surface;

static sbf_vec3 position(const surface *s, uint32_t slot) {
  return sbri_vec3(s->rest[slot].x, s->rest[slot].y, s->rest[slot].z);
}

static bool has_crossing(const surface *s, const uint32_t ends[2], const uint32_t *c) {
  sbf_vec3 p[3], from = position(s, ends[0]), displacement = sbri_sub(position(s, ends[1]), from);
  float weights[3];
  for (int k = 0; k < 3; k++) {
    if (c[k] == ends[0] || c[k] == ends[1]) return false;
    p[k] = position(s, c[k]);
  }
  float fraction = sbri_triangle_cross(from, displacement, p[0], p[1], p[2]);
  if (!(fraction > WITHIN && fraction < 1 - WITHIN)) return false;
  sbri_triangle_find_nearest(sbri_add_scaled(from, displacement, fraction), p[0], p[1], p[2], weights);
  return weights[0] > WITHIN && weights[1] > WITHIN && weights[2] > WITHIN;
}

static bool edge_crosses(const surface *s, uint32_t number) {
  const uint32_t *c = s->body->self.faces + number / 3 * 3, ends[2] = {c[number % 3], c[(number + 1) % 3]};
  sbri_bounds_walk walk;
  uint32_t triangle;
  sbri_bounds_walk_begin(
      &walk, &s->tree, sbri_box_with(sbri_box_of_point(position(s, ends[0])), position(s, ends[1])));
  while (sbri_bounds_walk_next(&walk, &triangle))
    if (has_crossing(s, ends, s->body->self.faces + 3 * (size_t)triangle)) return true;
  return false;
}

static bool find(surface *s, sbri_body *body, sbfi_arena *scratch) {
  uint32_t count = body->self.face_count;
  s->boxes = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *s->boxes);
  s->tree.nodes = sbfi_arena_allocate(scratch, sbri_bounds_tree_nodes(count), sizeof *s->tree.nodes);
  s->tree.items = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *s->tree.items);
  if (!s->boxes || !s->tree.nodes || !s->tree.items) return false;
  for (uint32_t f = 0; f < count; f++) {
    const uint32_t *c = body->self.faces + 3 * (size_t)f;
    s->boxes[f] = sbri_box_of_point(position(s, c[0]));
    for (int k = 1; k < 3; k++) s->boxes[f] = sbri_box_with(s->boxes[f], position(s, c[k]));
  }
  sbri_bounds_tree_make(&s->tree, s->boxes, count);
  for (uint32_t i = 0; i < 3 * count && !body->self.is_tangled; i++)
    body->self.is_tangled = body->self.sides[i] != SBRI_SAME_SIDE && edge_crosses(s, i);
  return true;
}

bool sbri_self_tangles_find(sbr_model *model, sbri_body *body) {
  surface s = {.body = body, .rest = model->islands[body->island].rest};
  sbfi_arena scratch;
  if (!body->self.face_count) return true;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = find(&s, body, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
