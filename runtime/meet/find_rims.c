/* Where edges of two surfaces cross, and no corner comes near a face.
 *
 * Of sheets: rims, and the ridges that they are folded to. Of closed surfaces: ridges that stand out at rest
 * and are so long that nothing else would keep the two off each other. At a ridge with an angle of a between
 * the normals beside it, an edge of 1 m may lie tan(a/2) / 2 deep without a corner in the other: bodies whose
 * edges do not get far into each other by that leave it to their corners. */
#include "collide/ridge_look.h"
#include "math/vec3.h"
#include "meet/finding.h"

/* Of the thinner one's thickness: what may be in it unnoticed; and what is past a ridge by more goes out as
 * what is deep does. */
static const float UNNOTICED_SHARE = 0.25f, PAST_SHARE = 0.5f;

typedef struct rim {
  uint32_t ends[2], wings[2]; /* those of ridges */
  sbri_soft_ridge is;
} rim;

static rim rim_of(const sbri_meet_surface *s, uint32_t triangle, uint32_t side) {
  const uint32_t *c = s->triangles + 3 * (size_t)triangle;
  rim r = {.ends = {c[side], c[(side + 1) % 3]}};
  for (int k = 0; k < 2; k++) r.is.edge.at[k] = s->places[r.ends[k]], r.is.edge.ways[k] = s->ways[r.ends[k]];
  if (s->two_sided) return r;
  r.wings[0] = c[(side + 2) % 3], r.wings[1] = s->sides[3 * (size_t)triangle + side];
  for (int k = 0; k < 2; k++) r.is.wings[k] = s->places[r.wings[k]];
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

/* Two surfaces, and how near what of them meets. */
typedef struct meeting {
  const sbri_finding *f;
  const sbri_party *a, *b;
  bool closed;
  float margin, beyond, past;
  float unnoticed; /* m */
} meeting;

static bool look(const meeting *m, const rim *p, const rim *q, sbri_edge_finding *found) {
  if (m->closed) return sbri_ridges_look(&p->is, &q->is, m->beyond, m->past, found);
  return sbri_edges_look(&p->is.edge, &q->is.edge, m->beyond, found);
}

/* Whether something of the two goes out from so deep in the other that ridges are no matter. */
static bool goes_out(const sbri_finding *f, uint32_t first) {
  const sbri_meet_touch *touches = f->world->meetings->touches + f->group->first_touch;
  for (uint32_t i = first; i < f->group->touch_count; i++)
    if (touches[i].goes_out) return true;
  return false;
}

static void meet(const meeting *m, const rim *p, const rim *q) {
  sbri_edge_finding found;
  float margin = m->margin;
  if (!look(m, p, q, &found)) return;
  if (sbri_are_of_one(m->a, m->b) && m->b->soft) {
    float rest = rest_distance(m->a, p, m->b, q);
    if (rest <= SBRI_TOGETHER_SHARE * m->a->soft->rest_size_m * m->a->of->scale) return;
    margin = SBRI_REST_SHARE * rest < margin ? SBRI_REST_SHARE * rest : margin;
  }
  const float shares[2][2] = {{1 - found.shares[0], found.shares[0]}, {1 - found.shares[1], found.shares[1]}};
  uint32_t mixed = p->ends[0] * 0x9e3779b1u ^ p->ends[1] * 0x85ebca6bu ^ q->ends[0] * 0xc2b2ae35u ^
                   q->ends[1] * 0x27d4eb2fu;
  sbri_meet_touch t = {.feature = mixed | 0x80000000u, /* vertices have less */
      .a = sbri_soft_side(m->a, p->ends, shares[0], 2),
      .b = sbri_party_side(m->b, q->ends, shares[1], 2),
      .normal = found.normal,
      .margin = margin};
  sbri_finding_add(m->f, m->a, m->b, &t);
}

/* Whether so much of an edge may be in the other beside its sharpest ridge that it is to be looked for. */
static bool is_long(const meeting *m, const rim *p, const sbri_party *other) {
  return !m->closed ||
         sbri_length(sbri_sub(p->is.edge.at[1], p->is.edge.at[0])) * other->surface->sharpness > m->unnoticed;
}

static void meet_others(const meeting *m, const rim *p) {
  const sbri_meet_surface *other = m->b->surface;
  const sbri_soft_edge *edge = &p->is.edge;
  sbri_box box = sbri_box_with(sbri_box_of_point(edge->at[0]), edge->at[1]);
  for (int k = 0; k < 2; k++) box = sbri_box_with(box, sbri_add(edge->at[k], edge->ways[k]));
  box = sbri_box_grown(box, m->beyond);
  sbri_bounds_walk walk;
  uint32_t triangle;
  sbri_bounds_walk_begin(&walk, &other->tree, box);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    if (!other->rims[triangle] || !sbri_box_meets(&box, &other->boxes[triangle])) continue;
    for (uint32_t side = 0; side < 3; side++) {
      if (!(other->rims[triangle] >> side & 1)) continue;
      rim q = rim_of(other, triangle, side);
      if (is_long(m, &q, m->a)) meet(m, p, &q);
    }
  }
}

static void meet_all(const meeting *m) {
  const sbri_meet_surface *s = m->a->surface;
  if (!m->b->surface->tree.node_count) return;
  sbri_box about = sbri_box_grown(m->b->surface->tree.nodes[0].box, m->beyond);
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    if (!s->rims[t] || !sbri_box_meets(&s->boxes[t], &about)) continue;
    for (uint32_t side = 0; side < 3; side++) {
      if (!(s->rims[t] >> side & 1)) continue;
      rim p = rim_of(s, t, side);
      if (is_long(m, &p, m->b)) meet_others(m, &p);
    }
  }
}

void sbri_meet_rims(const sbri_finding *f, const sbri_party *a, const sbri_party *b) {
  float margin = sbri_party_margin(a, b);
  meeting m = {.f = f, .a = a, .b = b, .margin = margin, .beyond = sbri_party_beyond(margin, b)};
  meet_all(&m);
}

/* ---- Closed surfaces ---- */

void sbri_meet_ridges(const sbri_finding *f, const sbri_party *a, const sbri_party *b, uint32_t first) {
  float margin = fmaxf(sbri_party_margin(a, b), sbri_party_margin(b, a));
  float thin = fminf(sbri_party_thickness(a), sbri_party_thickness(b));
  meeting m = {.f = f,
      .a = a,
      .b = b,
      .closed = true,
      .margin = margin,
      .past = PAST_SHARE * thin,
      .unnoticed = UNNOTICED_SHARE * thin};
  if (!(a->surface->ridge_m * a->of->scale * b->surface->sharpness > m.unnoticed) ||
      !(b->surface->ridge_m * b->of->scale * a->surface->sharpness > m.unnoticed))
    return;
  if (goes_out(f, first)) return;
  m.beyond = sbri_party_beyond(margin, b->soft ? b : a);
  if (b->rigid) {
    sbr_transform from = sbri_party_frame(b, false), to = sbri_party_frame(b, true);
    sbri_meet_hull_place(b->rigid, &from, &to, b->of->scale, b->surface);
  }
  meet_all(&m);
}
