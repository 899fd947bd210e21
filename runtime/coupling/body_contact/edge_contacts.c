/* Contacts between edges, where no vertex comes near a face.
 *
 * Sheets: boundary edges and folds. Closed surfaces: ridges long enough that vertices alone would not keep
 * the bodies apart. At a ridge with angle a between its normals, an edge of length L can penetrate by L
 * tan(a/2) / 2 without a vertex inside; pairs below a tolerance are left to their vertices. */
#include "coupling/body_contact/narrow_phase.h"
#include "math/vec3.h"
#include "shapes/ridge_query.h"

/* Fractions of the smaller thickness: tolerated penetration; depth past a ridge at which deep contacts take
 * over. */
static const float TOLERATED_FRACTION = 0.25f, PAST_RIDGE_FRACTION = 0.5f;

typedef struct surface_edge {
  uint32_t ends[2], wings[2]; /* wings: of ridges */
  sbri_soft_ridge geometry;
} surface_edge;

static surface_edge surface_edge_of(const sbri_contact_surface *s, uint32_t triangle, uint32_t side) {
  const uint32_t *c = s->triangles + 3 * (size_t)triangle;
  surface_edge r = {.ends = {c[side], c[(side + 1) % 3]}};
  for (int k = 0; k < 2; k++)
    r.geometry.edge.at[k] = s->positions[r.ends[k]],
    r.geometry.edge.directions[k] = s->displacements[r.ends[k]];
  if (s->two_sided) return r;
  r.wings[0] = c[(side + 2) % 3], r.wings[1] = s->opposite_vertices[3 * (size_t)triangle + side];
  for (int k = 0; k < 2; k++) r.geometry.wings[k] = s->positions[r.wings[k]];
  return r;
}

/* Rest distance of two edges that cross at rest. */
static float rest_distance(
    const sbri_pair_body *a, const surface_edge *p, const sbri_pair_body *b, const surface_edge *q) {
  sbri_soft_edge edges[2] = {0};
  sbri_edge_hit found;
  for (int k = 0; k < 2; k++)
    edges[0].at[k] = sbri_pair_body_rest_position(a, p->ends[k]),
    edges[1].at[k] = sbri_pair_body_rest_position(b, q->ends[k]);
  return sbri_edges_query(&edges[0], &edges[1], INFINITY, &found) ? found.distance : INFINITY;
}

/* A search for crossing edges of two surfaces. */
typedef struct edge_search {
  const sbri_narrow_phase *phase;
  const sbri_pair_body *a, *b;
  bool closed;
  float margin, search_distance, max_past_ridge;
  float tolerated_depth; /* m */
} edge_search;

static bool find_crossing(
    const edge_search *m, const surface_edge *p, const surface_edge *q, sbri_edge_hit *found) {
  if (m->closed)
    return sbri_ridges_query(&p->geometry, &q->geometry, m->search_distance, m->max_past_ridge, found);
  return sbri_edges_query(&p->geometry.edge, &q->geometry.edge, m->search_distance, found);
}

/* Whether the pair has a contact so deep that ridges do not matter. */
static bool has_deep_contact(const sbri_narrow_phase *f, uint32_t first) {
  const sbri_contact *contacts = f->world->body_contacts->contacts + f->group->first_contact;
  for (uint32_t i = first; i < f->group->contact_count; i++)
    if (contacts[i].exits_nearest) return true;
  return false;
}

static void add_edge_contact(const edge_search *m, const surface_edge *p, const surface_edge *q) {
  sbri_edge_hit found;
  float margin = m->margin;
  if (!find_crossing(m, p, q, &found)) return;
  if (sbri_are_same_character(m->a, m->b) && m->b->soft) {
    float rest = rest_distance(m->a, p, m->b, q);
    if (rest <= SBRI_REST_CONTACT_FRACTION * m->a->soft->rest_size_m * m->a->owner->scale) return;
    margin = SBRI_REST_DISTANCE_FACTOR * rest < margin ? SBRI_REST_DISTANCE_FACTOR * rest : margin;
  }
  const float weights[2][2] = {
      {1 - found.fractions[0], found.fractions[0]}, {1 - found.fractions[1], found.fractions[1]}};
  uint32_t hash = p->ends[0] * 0x9e3779b1u ^ p->ends[1] * 0x85ebca6bu ^ q->ends[0] * 0xc2b2ae35u ^
                  q->ends[1] * 0x27d4eb2fu;
  sbri_contact t = {.feature = hash | 0x80000000u, /* features of vertices are below this */
      .a = sbri_soft_contact_side(m->a, p->ends, weights[0], 2),
      .b = sbri_pair_body_side(m->b, q->ends, weights[1], 2),
      .normal = found.normal,
      .margin = margin};
  sbri_narrow_phase_add(m->phase, m->a, m->b, &t);
}

/* Whether the edge can penetrate by more than the tolerance. */
static bool is_long_enough(const edge_search *m, const surface_edge *p, const sbri_pair_body *other) {
  return !m->closed ||
         sbri_length(sbri_sub(p->geometry.edge.at[1], p->geometry.edge.at[0])) * other->surface->sharpness >
             m->tolerated_depth;
}

static void search_edge(const edge_search *m, const surface_edge *p) {
  const sbri_contact_surface *other = m->b->surface;
  const sbri_soft_edge *edge = &p->geometry.edge;
  sbri_box box = sbri_box_with(sbri_box_of_point(edge->at[0]), edge->at[1]);
  for (int k = 0; k < 2; k++) box = sbri_box_with(box, sbri_add(edge->at[k], edge->directions[k]));
  box = sbri_box_grown(box, m->search_distance);
  sbri_bounds_walk walk;
  uint32_t triangle;
  sbri_bounds_walk_begin(&walk, &other->tree, box);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    if (!other->edge_flags[triangle] || !sbri_boxes_overlap(&box, &other->boxes[triangle])) continue;
    for (uint32_t side = 0; side < 3; side++) {
      if (!(other->edge_flags[triangle] >> side & 1)) continue;
      surface_edge q = surface_edge_of(other, triangle, side);
      if (is_long_enough(m, &q, m->a)) add_edge_contact(m, p, &q);
    }
  }
}

static void search_surface(const edge_search *m) {
  const sbri_contact_surface *s = m->a->surface;
  if (!m->b->surface->tree.node_count) return;
  sbri_box region = sbri_box_grown(m->b->surface->tree.nodes[0].box, m->search_distance);
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    if (!s->edge_flags[t] || !sbri_boxes_overlap(&s->boxes[t], &region)) continue;
    for (uint32_t side = 0; side < 3; side++) {
      if (!(s->edge_flags[t] >> side & 1)) continue;
      surface_edge p = surface_edge_of(s, t, side);
      if (is_long_enough(m, &p, m->b)) search_edge(m, &p);
    }
  }
}

void sbri_find_edge_contacts(const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b) {
  float margin = sbri_pair_margin(a, b);
  edge_search m = {
      .phase = f, .a = a, .b = b, .margin = margin, .search_distance = sbri_pair_search_distance(margin, b)};
  search_surface(&m);
}

/* ---- Closed surfaces ---- */

void sbri_find_ridge_contacts(
    const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b, uint32_t first) {
  float margin = fmaxf(sbri_pair_margin(a, b), sbri_pair_margin(b, a));
  float min_thickness = fminf(sbri_pair_body_thickness(a), sbri_pair_body_thickness(b));
  edge_search m = {.phase = f,
      .a = a,
      .b = b,
      .closed = true,
      .margin = margin,
      .max_past_ridge = PAST_RIDGE_FRACTION * min_thickness,
      .tolerated_depth = TOLERATED_FRACTION * min_thickness};
  if (!(a->surface->longest_ridge_m * a->owner->scale * b->surface->sharpness > m.tolerated_depth) ||
      !(b->surface->longest_ridge_m * b->owner->scale * a->surface->sharpness > m.tolerated_depth))
    return;
  if (has_deep_contact(f, first)) return;
  m.search_distance = sbri_pair_search_distance(margin, b->soft ? b : a);
  if (b->rigid) {
    sbr_transform from = sbri_pair_body_frame(b, false), to = sbri_pair_body_frame(b, true);
    sbri_contact_hull_update(b->rigid, &from, &to, b->owner->scale, b->surface);
  }
  search_surface(&m);
}
