/* Parts of two bodies inside of each other, as clusters: connected parts and the parts near them. */
#include "coupling/body_contact/overlap_clusters.h"

#include "base/union_find.h"

enum { CROSSINGS = 8 };
/* Edges longer than this fraction of the other body's thickness can pass through it without a vertex inside.
 */
static const float COARSE_FRACTION = 0.5f;
/* A limb is longer than its thickness by this factor. */
static const float LIMB_ASPECT = 3.5f;
/* Margin around edge spans within which parts join the cluster, as a fraction of the thickness. */
static const float CLUSTER_MARGIN_FRACTION = 0.5f;

static bool is_limb(const sbri_pair_body *p) {
  return sbri_pair_body_size(p) > LIMB_ASPECT * sbri_pair_body_thickness(p);
}

bool sbri_are_coarse_limbs(const sbri_pair_body *a, const sbri_pair_body *b) {
  const sbri_contact_surface *s = a->surface, *t = b->surface;
  return is_limb(a) && is_limb(b) &&
         s->mean_edge_m * a->owner->scale > COARSE_FRACTION * sbri_pair_body_thickness(b) &&
         t->mean_edge_m * b->owner->scale > COARSE_FRACTION * sbri_pair_body_thickness(a);
}

/* ---- Edges ---- */

/* First span of the edge inside of `in`, as fractions of the edge. False: none. */
static bool find_inside_span(const sbri_contact_surface *overlap, sbf_vec3 from, sbf_vec3 to,
    const bool ends_inside[2], float fractions[2]) {
  sbf_vec3 edge = sbri_sub(to, from);
  float crossings[CROSSINGS];
  bool outwards[CROSSINGS];
  uint32_t count = 0, triangle;
  sbri_bounds_walk walk;
  sbri_bounds_walk_begin(&walk, &overlap->tree, sbri_box_with(sbri_box_of_point(from), to));
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    const uint32_t *c = overlap->triangles + 3 * (size_t)triangle;
    const sbf_vec3 p[3] = {overlap->positions[c[0]], overlap->positions[c[1]], overlap->positions[c[2]]};
    float fraction = sbri_triangle_cross(from, edge, p[0], p[1], p[2]);
    if (fraction < 0 || count == CROSSINGS) continue;
    outwards[count] = sbri_dot(edge, sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]))) > 0;
    crossings[count++] = fraction;
  }
  fractions[0] = ends_inside[0] ? 0 : 2, fractions[1] = ends_inside[1] ? 1 : 2;
  for (uint32_t i = 0; i < count; i++)
    if (!outwards[i] && crossings[i] < fractions[0]) fractions[0] = crossings[i];
  for (uint32_t i = 0; i < count; i++)
    if (outwards[i] && crossings[i] > fractions[0] && crossings[i] < fractions[1])
      fractions[1] = crossings[i];
  return fractions[0] < fractions[1] && fractions[1] <= 1;
}

/* Iterates over the edges with a span inside of the other surface. */
typedef struct edge_walk {
  const sbri_contact_surface *surface, *other;
  bool vertices_classified; /* `inside_parents` of the surface is filled in */
  uint32_t next_side;       /* edge index */
  uint32_t ends[2];
  bool ends_inside[2];
  float fractions[2];
} edge_walk;

static bool next_edge(edge_walk *w) {
  const sbri_contact_surface *s = w->surface;
  const sbri_box *all = &w->other->tree.nodes[0].box;
  while (w->next_side < 3 * s->triangle_count) {
    uint32_t i = w->next_side++, from = s->triangles[i], to = s->triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (from > to) continue; /* handled by the other triangle */
    sbri_box box = sbri_box_with(sbri_box_of_point(s->positions[from]), s->positions[to]);
    if (!(s->samples[from].mass_kg > 0) || !(s->samples[to].mass_kg > 0) || !sbri_boxes_overlap(&box, all))
      continue;
    w->ends_inside[0] = w->vertices_classified && s->inside_parents[from] != SBRI_VERTEX_OUTSIDE;
    w->ends_inside[1] = w->vertices_classified && s->inside_parents[to] != SBRI_VERTEX_OUTSIDE;
    if (!find_inside_span(w->other, s->positions[from], s->positions[to], w->ends_inside, w->fractions))
      continue;
    w->ends[0] = from, w->ends[1] = to;
    return true;
  }
  return false;
}

bool sbri_edges_intersect(const sbri_contact_surface *a, const sbri_contact_surface *b) {
  edge_walk one = {.surface = a, .other = b}, other = {.surface = b, .other = a};
  const sbri_box *p = &a->tree.nodes[0].box, *q = &b->tree.nodes[0].box;
  return sbri_boxes_overlap(p, q) && (next_edge(&one) || next_edge(&other));
}

static void add_edges(sbri_overlap *overlap, uint32_t side) {
  const sbri_contact_surface *s = overlap->bodies[side]->surface;
  const sbri_pair_body *other = overlap->bodies[1 - side];
  edge_walk w = {.surface = s, .other = other->surface, .vertices_classified = true};
  float margin = CLUSTER_MARGIN_FRACTION * sbri_pair_body_thickness(other);
  while (
      overlap->edge_count < SBRI_OVERLAP_EDGES && overlap->set_count < SBRI_OVERLAP_SETS && next_edge(&w)) {
    uint32_t a = w.ends[0], b = w.ends[1];
    sbf_vec3 from = sbri_lerp(s->positions[a], s->positions[b], w.fractions[0]),
             to = sbri_lerp(s->positions[a], s->positions[b], w.fractions[1]);
    if (!sbri_surface_contains(other->surface, sbri_lerp(from, to, 0.5f)))
      continue; /* touches without entering */
    uint32_t hash = (a * 0x9e3779b1u ^ b * 0x85ebca6bu) & (SBRI_EDGE_FEATURE - 1);
    sbri_box box = sbri_box_grown(sbri_box_with(sbri_box_of_point(from), to), margin);
    overlap->edges[overlap->edge_count++] = (sbri_overlap_edge){.set = overlap->set_count,
        .ends = {a, b},
        .feature = hash | SBRI_EDGE_FEATURE,
        .fraction = 0.5f * (w.fractions[0] + w.fractions[1]),
        .both_ends_outside = !w.ends_inside[0] && !w.ends_inside[1],
        .position = sbri_lerp(from, to, 0.5f),
        .direction = sbri_normalize(sbri_sub(s->positions[b], s->positions[a]), sbri_vec3(0, 1, 0)),
        .length = sbri_length(sbri_sub(s->positions[b], s->positions[a]))};
    overlap->sets[overlap->set_count] = (sbri_overlap_set){SBRI_NO_CLUSTER, side, overlap->set_count, box, 1};
    overlap->set_count++;
  }
}

/* ---- Vertices ---- */

static void classify_vertices(const sbri_pair_body *a, const sbri_pair_body *b) {
  const sbri_contact_surface *s = a->surface;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    bool inside = s->samples[v].mass_kg > 0 && sbri_surface_contains(b->surface, s->positions[v]);
    s->inside_parents[v] = inside ? v : SBRI_VERTEX_OUTSIDE;
  }
  for (uint32_t i = 0; i < 3 * s->triangle_count; i++) {
    uint32_t from = s->triangles[i], to = s->triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (s->inside_parents[from] == SBRI_VERTEX_OUTSIDE || s->inside_parents[to] == SBRI_VERTEX_OUTSIDE)
      continue;
    sbfi_sets_join(s->inside_parents, from, to);
  }
}

static uint32_t set_of(const sbri_overlap *overlap, uint32_t side, uint32_t vertex) {
  uint32_t *inside = overlap->bodies[side]->surface->inside_parents;
  if (inside[vertex] == SBRI_VERTEX_OUTSIDE) return SBRI_NO_CLUSTER;
  uint32_t root = sbfi_set_root(inside, vertex);
  for (uint32_t i = 0; i < overlap->set_count; i++)
    if (overlap->sets[i].side == side && overlap->sets[i].root == root) return i;
  return SBRI_NO_CLUSTER;
}

static void add_vertex_sets(sbri_overlap *overlap, uint32_t side) {
  const sbri_contact_surface *s = overlap->bodies[side]->surface;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    if (s->inside_parents[v] == SBRI_VERTEX_OUTSIDE) continue;
    sbri_box box = sbri_box_of_point(s->positions[v]);
    uint32_t i = set_of(overlap, side, v);
    if (i == SBRI_NO_CLUSTER) {
      if (overlap->set_count == SBRI_OVERLAP_SETS - SBRI_OVERLAP_EDGES) continue;
      i = overlap->set_count++;
      overlap->sets[i] = (sbri_overlap_set){sbfi_set_root(s->inside_parents, v), side, i, box, 0};
    }
    overlap->sets[i].box = sbri_box_join(overlap->sets[i].box, box), overlap->sets[i].count++;
  }
}

/* ---- Clusters ---- */

static bool is_edge(const sbri_overlap_set *s) {
  return s->root == SBRI_NO_CLUSTER;
}

/* Merges clusters: overlapping sets of both bodies, and overlapping edge spans of one. */
static void merge_clusters(sbri_overlap *overlap) {
  for (uint32_t i = 0; i < overlap->set_count; i++)
    for (uint32_t k = 0; k < i; k++) {
      const sbri_overlap_set *p = &overlap->sets[i], *q = &overlap->sets[k];
      if (p->side == q->side && !is_edge(p) && !is_edge(q)) continue;
      if (p->cluster == q->cluster || !sbri_boxes_overlap(&p->box, &q->box)) continue;
      uint32_t one = p->cluster, other = q->cluster, low = one < other ? one : other;
      for (uint32_t j = 0; j < overlap->set_count; j++)
        if (overlap->sets[j].cluster == one || overlap->sets[j].cluster == other)
          overlap->sets[j].cluster = low;
    }
}

uint32_t sbri_cluster_of_feature(const sbri_overlap *overlap, uint32_t side, uint32_t feature) {
  if (feature < SBRI_EDGE_FEATURE) {
    uint32_t set = set_of(overlap, side, feature);
    return set == SBRI_NO_CLUSTER ? SBRI_NO_CLUSTER : overlap->sets[set].cluster;
  }
  for (uint32_t i = 0; i < overlap->edge_count; i++)
    if (overlap->edges[i].feature == feature && sbri_side_of_edge(overlap, &overlap->edges[i]) == side)
      return sbri_cluster_of_edge(overlap, &overlap->edges[i]);
  return SBRI_NO_CLUSTER;
}

void sbri_overlap_update(sbri_overlap *overlap) {
  overlap->set_count = overlap->edge_count = 0;
  for (uint32_t side = 0; side < 2; side++)
    classify_vertices(overlap->bodies[side], overlap->bodies[1 - side]);
  for (uint32_t side = 0; side < 2; side++) add_vertex_sets(overlap, side);
  for (uint32_t side = 0; side < 2 && sbri_are_coarse_limbs(overlap->bodies[0], overlap->bodies[1]); side++)
    add_edges(overlap, side);
  merge_clusters(overlap);
}
