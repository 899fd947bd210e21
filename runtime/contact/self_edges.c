/* Self-contact of edges: the rims of a sheet and the ridges of its folds. Crossing edges have no vertex near
 * a face. A contact is a sample with positive weights for one edge and negative ones for the other. */
#include "contact/self_query.h"
#include "shapes/edge_query.h"
#include "shapes/sides.h"

/* Fraction of the missing distance that is restored per tick between edges closer than the thickness, such as
 * neighbouring rims. Edge contacts keep edges on their sides; point contacts keep the distance. */
static const float RESTORED_FRACTION = 0.05f;

typedef struct edge {
  uint32_t ends[2];
  sbri_soft_edge is;
} edge;

static edge edge_of(const sbri_self_search *l, uint32_t triangle, uint32_t side) {
  const uint32_t *c = l->body->self.faces + 3 * (size_t)triangle;
  edge e = {.ends = {c[side], c[(side + 1) % 3]}};
  for (int k = 0; k < 2; k++) {
    e.is.at[k] = sbri_self_position(l->tick->positions, e.ends[k]);
    e.is.directions[k] = sbri_self_displacement(l->tick, e.ends[k]);
  }
  return e;
}

/* Stores a bit for each edge of a triangle that is a rim or a ridge. */
static void find_edges(const sbri_self_search *l) {
  const sbri_point *at = l->tick->positions;
  for (uint32_t f = 0; f < l->body->self.face_count; f++) {
    const uint32_t *c = l->body->self.faces + 3 * (size_t)f, *beside = l->body->self.sides + 3 * (size_t)f;
    sbf_vec3 p[3];
    for (int k = 0; k < 3; k++) p[k] = sbri_self_position(at, c[k]);
    l->tables->self_edges[f] = 0;
    for (int k = 0; k < 3; k++) {
      if (beside[k] == SBRI_SAME_SIDE) continue;
      if (beside[k] == SBRI_RIM ||
          sbri_side_is_bent(p[k], p[(k + 1) % 3], p[(k + 2) % 3], sbri_self_position(at, beside[k])))
        l->tables->self_edges[f] |= (uint8_t)(1u << k);
    }
  }
}

static bool are_connected(const sbri_body *body, const edge *p, const edge *q) {
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 2; k++)
      if (p->ends[i] == q->ends[k] || sbri_self_are_joined(body, p->ends[i], q->ends[k])) return true;
  return false;
}

/* Their distance at rest, if they cross each other there. */
static float rest_distance(const sbri_self_search *l, const edge *p, const edge *q) {
  sbri_soft_edge edges[2] = {0};
  sbri_edge_hit found;
  for (int k = 0; k < 2; k++) {
    edges[0].at[k] = sbri_self_position(l->tick->island->rest, p->ends[k]);
    edges[1].at[k] = sbri_self_position(l->tick->island->rest, q->ends[k]);
  }
  return sbri_edges_query(&edges[0], &edges[1], INFINITY, &found) ? found.distance : INFINITY;
}

static void collide(const sbri_self_search *l, const edge *p, const edge *q) {
  sbri_edge_hit found;
  if (are_connected(l->body, p, q) || !sbri_edges_query(&p->is, &q->is, l->rule.outer, &found)) return;
  const uint32_t slots[4] = {p->ends[0], p->ends[1], q->ends[0], q->ends[1]};
  const float *to = found.fractions, weights[4] = {1 - to[0], to[0], to[1] - 1, -to[1]};
  sbri_sample s = sbri_self_sample(l->tick->island, slots, weights);
  float max = l->body->source->collision.outer_thickness, distance = found.distance;
  sbri_self_add(l, &s, found.normal, rest_distance(l, p, q),
      distance < max ? distance + RESTORED_FRACTION * (max - distance) : max, true);
}

/* Tests against edges with higher indices only. */
static void collide_with_later(const sbri_self_search *l, uint32_t number) {
  edge p = edge_of(l, number / 3, number % 3);
  sbri_box box = sbri_box_join(
      sbri_self_swept(l->tick, p.ends[0], l->rule.outer), sbri_self_swept(l->tick, p.ends[1], l->rule.outer));
  sbri_bounds_walk walk;
  uint32_t triangle;
  sbri_bounds_walk_begin(&walk, l->tree, box);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    if (!l->tables->self_edges[triangle] || !sbri_boxes_overlap(&box, &l->boxes[triangle])) continue;
    for (uint32_t side = 0; side < 3; side++) {
      if (!(l->tables->self_edges[triangle] >> side & 1) || 3 * triangle + side <= number) continue;
      edge q = edge_of(l, triangle, side);
      collide(l, &p, &q);
    }
  }
}

void sbri_self_edges_add(const sbri_self_search *l) {
  find_edges(l);
  for (uint32_t i = 0; i < 3 * l->body->self.face_count; i++)
    if (l->tables->self_edges[i / 3] >> i % 3 & 1) collide_with_later(l, i);
}
