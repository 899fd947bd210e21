/* Where rims of two sheets, and the ridges that they are folded to, cross: strips, and corners of cloth,
 * whose points nowhere come near the other's triangles. */
#include "collide/edge_look.h"
#include "collide/sides.h"
#include "math/vec3.h"
#include "meet/finding.h"

typedef struct rim {
  uint32_t ends[2];
  sbri_soft_edge edge;
} rim;

static rim rim_of(const sbri_meet_surface *s, uint32_t triangle, uint32_t side) {
  const uint32_t *c = s->triangles + 3 * (size_t)triangle;
  rim r = {.ends = {c[side], c[(side + 1) % 3]}};
  for (int k = 0; k < 2; k++) r.edge.at[k] = s->places[r.ends[k]], r.edge.ways[k] = s->ways[r.ends[k]];
  return r;
}

/* How far apart they are at rest, where they cross each other there. */
static float rest_distance(const sbri_party *a, const rim *p, const sbri_party *b, const rim *q) {
  sbri_soft_edge edges[2] = {0};
  sbri_edge_finding found;
  for (int k = 0; k < 2; k++)
    edges[0].at[k] = sbri_party_rest(a, p->ends[k]), edges[1].at[k] = sbri_party_rest(b, q->ends[k]);
  return sbri_edges_look(&edges[0], &edges[1], INFINITY, &found) ? found.distance : INFINITY;
}

static void meet(const sbri_finding *f, const sbri_party *a, const rim *p, const sbri_party *b, const rim *q,
    float margin, float beyond) {
  sbri_edge_finding found;
  if (!sbri_edges_look(&p->edge, &q->edge, beyond, &found)) return;
  if (sbri_are_of_one(a, b)) {
    float rest = rest_distance(a, p, b, q);
    if (rest <= SBRI_TOGETHER_SHARE * a->soft->rest_size_m * a->of->scale) return;
    margin = SBRI_REST_SHARE * rest < margin ? SBRI_REST_SHARE * rest : margin;
  }
  const float shares[2][2] = {{1 - found.shares[0], found.shares[0]}, {1 - found.shares[1], found.shares[1]}};
  uint32_t mixed = p->ends[0] * 0x9e3779b1u ^ p->ends[1] * 0x85ebca6bu ^ q->ends[0] * 0xc2b2ae35u ^
                   q->ends[1] * 0x27d4eb2fu;
  sbri_meet_touch t = {.feature = mixed | 0x80000000u, /* vertices have less */
      .a = sbri_soft_side(a, p->ends, shares[0], 2),
      .b = sbri_soft_side(b, q->ends, shares[1], 2),
      .normal = found.normal,
      .margin = margin};
  sbri_finding_add(f, a, b, &t);
}

void sbri_meet_rims(const sbri_finding *f, const sbri_party *a, const sbri_party *b) {
  float margin = sbri_party_margin(a, b), beyond = sbri_party_beyond(margin, b);
  for (uint32_t i = 0; i < 3 * a->surface->triangle_count; i++) {
    if (!(a->surface->rims[i / 3] >> i % 3 & 1)) continue;
    rim p = rim_of(a->surface, i / 3, i % 3);
    sbri_box box = sbri_box_with(sbri_box_of_point(p.edge.at[0]), p.edge.at[1]);
    for (int k = 0; k < 2; k++) box = sbri_box_with(box, sbri_add(p.edge.at[k], p.edge.ways[k]));
    box = sbri_box_grown(box, beyond);
    sbri_bounds_walk walk;
    uint32_t triangle;
    sbri_bounds_walk_begin(&walk, &b->surface->tree, box);
    while (sbri_bounds_walk_next(&walk, &triangle)) {
      if (!b->surface->rims[triangle] || !sbri_box_meets(&box, &b->surface->boxes[triangle])) continue;
      for (uint32_t side = 0; side < 3; side++) {
        if (!(b->surface->rims[triangle] >> side & 1)) continue;
        rim q = rim_of(b->surface, triangle, side);
        meet(f, a, &p, b, &q, margin, beyond);
      }
    }
  }
}

/* ---- Of a tick ---- */

void sbri_meet_rims_look(sbri_meet_surface *s) {
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    const uint32_t *c = s->triangles + 3 * (size_t)t, *beside = s->sides + 3 * (size_t)t;
    s->rims[t] = 0;
    for (uint32_t k = 0; k < 3; k++) {
      if (beside[k] == SBRI_SAME_SIDE) continue;
      if (beside[k] == SBRI_RIM || sbri_side_is_bent(s->places[c[k]], s->places[c[(k + 1) % 3]],
                                       s->places[c[(k + 2) % 3]], s->places[beside[k]]))
        s->rims[t] |= (uint8_t)(1u << k);
    }
  }
}
