#include "prepare/hinges.h"

#include "mechanics/level_points.h"
#include "solvers/surface_forces.h"

typedef struct side {
  uint32_t low, high; /* source points */
  uint32_t across;    /* third corner of its triangle */
  uint32_t order;     /* index in the mesh; and whether it runs from low to high */
  bool forward;
} side;

/* Order by ends, then by index. */
static bool comes_before(const side *a, const side *b) {
  if (a->low != b->low) return a->low < b->low;
  if (a->high != b->high) return a->high < b->high;
  return a->order < b->order;
}

static void sift(side *sides, size_t root, size_t count) {
  for (size_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && comes_before(&sides[child], &sides[child + 1])) child++;
    if (!comes_before(&sides[root], &sides[child])) return;
    side swapped = sides[root];
    sides[root] = sides[child], sides[child] = swapped;
  }
}

static void sort_sides(side *sides, size_t count) {
  for (size_t i = count / 2; i-- > 0;) sift(sides, i, count);
  for (size_t end = count; end-- > 1;) {
    side swapped = sides[0];
    sides[0] = sides[end], sides[end] = swapped;
    sift(sides, 0, end);
  }
}

static bool add_side(sbfi_array *sides, uint32_t from, uint32_t to, uint32_t across) {
  side s = {from < to ? from : to, from < to ? to : from, across, (uint32_t)sides->count, from < to};
  return sbfi_array_append(sides, &s, 1);
}

/* Edges of the triangles that the polygons are divided into from their first corner. */
static bool list_sides(const sbf_polygon_mesh *mesh, sbfi_array *sides) {
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      uint32_t a = corners[0], b = corners[k - 1], c = corners[k];
      if (!add_side(sides, a, b, c) || !add_side(sides, b, c, a) || !add_side(sides, c, a, b)) return false;
    }
  return true;
}

static float rigidity_of(const sbf_attributes *is) {
  if (is->bending_stiffness > 0) return is->bending_stiffness;
  float t = is->thickness;
  return is->young_modulus * t * t * t / (12 * (1 - is->poisson_ratio * is->poisson_ratio));
}

/* The hinge of two triangles at an edge; false where a point is missing or it has no size. */
static bool make_hinge(const sbri_island *island, const sbri_body *body, const float *factors, const side *s,
    const side *other, sbri_hinge *hinge) {
  const uint32_t points[4] = {
      s->forward ? s->low : s->high, s->forward ? s->high : s->low, s->across, other->across};
  float factor = 0;
  sbf_vec3 x[4];
  for (int k = 0; k < 4; k++) {
    uint32_t point = sbfi_level_point(body->level, points[k]);
    if (point == UINT32_MAX) return false;
    hinge->slots[k] = body->slot_from_point[point];
    const sbri_point *at = &island->rest[hinge->slots[k]];
    x[k] = sbri_vec3(at->x, at->y, at->z);
    factor += factors ? 0.25f * factors[point] : 0.25f;
  }
  sbri_hinge_shape shape = sbri_hinge_shape_of(x);
  float areas = 0.5f * (sbri_length(shape.normals[0]) + sbri_length(shape.normals[1]));
  if (!(areas > 0) || !(shape.length > 0)) return false;
  hinge->stiffness = factor * rigidity_of(&body->source->attributes) * shape.length * shape.length / areas;
  hinge->rest_angle = shape.angle;
  return true;
}

/* `sides` is empty on entry. */
static bool list_hinges(const sbri_island *island, const sbri_body *body, sbfi_arena *keep, sbfi_array *sides,
    const float *factors, const sbri_hinge **found, uint32_t *found_count) {
  if (!list_sides(&body->source->surface, sides)) return false;
  side *at = sides->at;
  sort_sides(at, sides->count);
  sbri_hinge *hinges = sbfi_arena_allocate(keep, sides->count / 2 + 1, sizeof *hinges);
  if (!hinges) return false;
  uint32_t count = 0;
  for (size_t i = 0; i + 1 < sides->count; i++) {
    bool pair = at[i].low == at[i + 1].low && at[i].high == at[i + 1].high;
    bool third = i + 2 < sides->count && at[i + 2].low == at[i].low && at[i + 2].high == at[i].high;
    if (!pair) continue;
    if (!third && make_hinge(island, body, factors, &at[i], &at[i + 1], &hinges[count])) count++;
    for (i++; i + 1 < sides->count && at[i + 1].low == at[i].low && at[i + 1].high == at[i].high;) i++;
  }
  *found = hinges, *found_count = count;
  return true;
}

bool sbri_hinges_find(const sbri_island *island, const sbri_body *body, sbfi_arena *keep, sbfi_arena *scratch,
    const sbri_hinge **hinges, uint32_t *hinge_count) {
  sbf_body_measures measures;
  *hinges = NULL, *hinge_count = 0;
  sbf_body_measure(body->source, &measures);
  if (!measures.sheet) return true;
  uint32_t count = body->level->positions.count;
  float *factors = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *factors);
  if (!factors) return false;
  for (uint32_t i = 0; i < count; i++) factors[i] = 1;
  sbfi_level_weigh(body->source, body->level, SBF_WEIGHT_PROPERTY_BENDING_STIFFNESS, factors);
  sbfi_array sides;
  sbfi_array_init(&sides, &keep->allocator, sizeof(side));
  bool good = list_hinges(island, body, keep, &sides, factors, hinges, hinge_count);
  sbfi_array_free(&sides);
  return good;
}

bool sbri_hinges_add(
    const sbri_island *island, const sbri_body *body, sbfi_arena *scratch, sbf_spring_network *network) {
  const sbri_hinge *hinges;
  uint32_t count;
  if (!sbri_hinges_find(island, body, scratch, scratch, &hinges, &count)) return false;
  sbf_uint4 *corners = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *corners);
  sbf_vec3 *gradients = sbfi_arena_allocate(scratch, 4 * (size_t)count + 1, sizeof *gradients);
  float *stiffness = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *stiffness);
  if (!corners || !gradients || !stiffness) return false;
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 x[4];
    for (int k = 0; k < 4; k++) {
      const sbri_point *at = &island->rest[corners[i].at[k] = hinges[i].slots[k]];
      x[k] = sbri_vec3(at->x, at->y, at->z);
    }
    sbri_hinge_shape shape = sbri_hinge_shape_of(x);
    sbri_compute_hinge_gradients(&shape, x, gradients + 4 * (size_t)i);
    stiffness[i] = hinges[i].stiffness;
  }
  network->hinge_count = count;
  network->hinges = corners, network->hinge_gradients = gradients, network->hinge_stiffness = stiffness;
  return true;
}
