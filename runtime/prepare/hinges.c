#include "prepare/hinges.h"

#include "mechanics/level_points.h"
#include "soft/solvers/surface_forces.h"

typedef struct edge {
  uint32_t low, high; /* source points */
  uint32_t opposite;  /* third corner of its triangle */
  uint32_t order;     /* index in the mesh; and whether it runs from low to high */
  bool forward;
} edge;

/* Order by ends, then by index. */
static bool is_before(const edge *a, const edge *b) {
  if (a->low != b->low) return a->low < b->low;
  if (a->high != b->high) return a->high < b->high;
  return a->order < b->order;
}

static void sift(edge *edges, size_t root, size_t count) {
  for (size_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && is_before(&edges[child], &edges[child + 1])) child++;
    if (!is_before(&edges[root], &edges[child])) return;
    edge swapped = edges[root];
    edges[root] = edges[child], edges[child] = swapped;
  }
}

static void sort_edges(edge *edges, size_t count) {
  for (size_t i = count / 2; i-- > 0;) sift(edges, i, count);
  for (size_t end = count; end-- > 1;) {
    edge swapped = edges[0];
    edges[0] = edges[end], edges[end] = swapped;
    sift(edges, 0, end);
  }
}

static bool add_edge(sbfi_array *edges, uint32_t from, uint32_t to, uint32_t opposite) {
  edge s = {from < to ? from : to, from < to ? to : from, opposite, (uint32_t)edges->count, from < to};
  return sbfi_array_append(edges, &s, 1);
}

/* Edges of the triangles that the polygons are divided into from their first corner. */
static bool list_edges(const sbf_polygon_mesh *mesh, sbfi_array *edges) {
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      uint32_t a = corners[0], b = corners[k - 1], c = corners[k];
      if (!add_edge(edges, a, b, c) || !add_edge(edges, b, c, a) || !add_edge(edges, c, a, b)) return false;
    }
  return true;
}

static float rigidity_of(const sbf_attributes *is) {
  if (is->bending_stiffness > 0) return is->bending_stiffness;
  float t = is->thickness;
  return is->young_modulus * t * t * t / (12 * (1 - is->poisson_ratio * is->poisson_ratio));
}

/* The hinge of two triangles at an edge; false where a point is missing or it has no size. */
static bool make_hinge(const sbri_island *island, const sbri_body *body, const float *factors, const edge *s,
    const edge *other, sbri_hinge *hinge) {
  const uint32_t points[4] = {
      s->forward ? s->low : s->high, s->forward ? s->high : s->low, s->opposite, other->opposite};
  float factor = 0;
  sbf_vec3 x[4];
  for (int k = 0; k < 4; k++) {
    uint32_t point = sbfi_level_point(body->level, points[k]);
    if (point == UINT32_MAX) return false;
    hinge->slots[k] = body->slots.from_point[point];
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

/* `edges` is empty on entry. */
static bool list_hinges(const sbri_island *island, const sbri_body *body, sbfi_arena *keep, sbfi_array *edges,
    const float *factors, const sbri_hinge **found, uint32_t *found_count) {
  if (!list_edges(&body->source->surface, edges)) return false;
  edge *at = edges->at;
  sort_edges(at, edges->count);
  sbri_hinge *hinges = sbfi_arena_allocate(keep, edges->count / 2 + 1, sizeof *hinges);
  if (!hinges) return false;
  uint32_t count = 0;
  for (size_t i = 0; i + 1 < edges->count; i++) {
    bool pair = at[i].low == at[i + 1].low && at[i].high == at[i + 1].high;
    bool third = i + 2 < edges->count && at[i + 2].low == at[i].low && at[i + 2].high == at[i].high;
    if (!pair) continue;
    if (!third && make_hinge(island, body, factors, &at[i], &at[i + 1], &hinges[count])) count++;
    for (i++; i + 1 < edges->count && at[i + 1].low == at[i].low && at[i + 1].high == at[i].high;) i++;
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
  sbfi_array edges;
  sbfi_array_init(&edges, &keep->allocator, sizeof(edge));
  bool good = list_hinges(island, body, keep, &edges, factors, hinges, hinge_count);
  sbfi_array_free(&edges);
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
