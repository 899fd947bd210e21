/* What of two bodies lies inside of the other, in knots: what hangs together, and what lies about it. */
#include "meet/inside.h"

#include "base/union_find.h"

enum { CROSSINGS = 8 };
/* Edges longer than this share of how thick the other is may lie in it without their ends. */
static const float COARSE_SHARE = 0.5f;
/* A body so many times as long as it is thick is a limb. */
static const float LIMB = 3.5f;
/* Of that too: what lies so near to such a stretch goes along with it. */
static const float ABOUT_SHARE = 0.5f;

static bool is_limb(const sbri_party *p) {
  return sbri_party_size(p) > LIMB * sbri_party_thickness(p);
}

bool sbri_are_coarse(const sbri_party *a, const sbri_party *b) {
  const sbri_meet_surface *s = a->surface, *t = b->surface;
  return is_limb(a) && is_limb(b) && s->edge_m * a->of->scale > COARSE_SHARE * sbri_party_thickness(b) &&
         t->edge_m * b->of->scale > COARSE_SHARE * sbri_party_thickness(a);
}

/* ---- Edges ---- */

/* The first stretch of the edge that is inside, some of whose ends may be; whether there is one. */
static bool find_stretch(
    const sbri_meet_surface *in, sbf_vec3 from, sbf_vec3 to, const bool ends_in[2], float shares[2]) {
  sbf_vec3 way = sbri_sub(to, from);
  float at[CROSSINGS];
  bool outwards[CROSSINGS];
  uint32_t count = 0, triangle;
  sbri_bounds_walk walk;
  sbri_bounds_walk_begin(&walk, &in->tree, sbri_box_with(sbri_box_of_point(from), to));
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    const uint32_t *c = in->triangles + 3 * (size_t)triangle;
    const sbf_vec3 p[3] = {in->places[c[0]], in->places[c[1]], in->places[c[2]]};
    float share = sbri_triangle_cross(from, way, p[0], p[1], p[2]);
    if (share < 0 || count == CROSSINGS) continue;
    outwards[count] = sbri_dot(way, sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]))) > 0;
    at[count++] = share;
  }
  shares[0] = ends_in[0] ? 0 : 2, shares[1] = ends_in[1] ? 1 : 2;
  for (uint32_t i = 0; i < count; i++)
    if (!outwards[i] && at[i] < shares[0]) shares[0] = at[i];
  for (uint32_t i = 0; i < count; i++)
    if (outwards[i] && at[i] > shares[0] && at[i] < shares[1]) shares[1] = at[i];
  return shares[0] < shares[1] && shares[1] <= 1;
}

/* One edge after the other of those that have a stretch in the other surface. */
typedef struct edge_walk {
  const sbri_meet_surface *s, *in;
  bool noted;    /* which vertices are inside */
  uint32_t next; /* side of a triangle */
  uint32_t ends[2];
  bool ends_in[2];
  float shares[2];
} edge_walk;

static bool next_edge(edge_walk *w) {
  const sbri_meet_surface *s = w->s;
  const sbri_box *all = &w->in->tree.nodes[0].box;
  while (w->next < 3 * s->triangle_count) {
    uint32_t i = w->next++, from = s->triangles[i], to = s->triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (from > to) continue; /* the other triangle's that has it */
    sbri_box box = sbri_box_with(sbri_box_of_point(s->places[from]), s->places[to]);
    if (!(s->samples[from].mass_kg > 0) || !(s->samples[to].mass_kg > 0) || !sbri_box_meets(&box, all))
      continue;
    w->ends_in[0] = w->noted && s->inside[from] != SBRI_NOT_INSIDE;
    w->ends_in[1] = w->noted && s->inside[to] != SBRI_NOT_INSIDE;
    if (!find_stretch(w->in, s->places[from], s->places[to], w->ends_in, w->shares)) continue;
    w->ends[0] = from, w->ends[1] = to;
    return true;
  }
  return false;
}

bool sbri_edges_go_through(const sbri_meet_surface *a, const sbri_meet_surface *b) {
  edge_walk one = {.s = a, .in = b}, other = {.s = b, .in = a};
  const sbri_box *p = &a->tree.nodes[0].box, *q = &b->tree.nodes[0].box;
  return sbri_box_meets(p, q) && (next_edge(&one) || next_edge(&other));
}

static void list_edges(sbri_inside *in, uint32_t side) {
  const sbri_meet_surface *s = in->parties[side]->surface;
  const sbri_party *other = in->parties[1 - side];
  edge_walk w = {.s = s, .in = other->surface, .noted = true};
  float about = ABOUT_SHARE * sbri_party_thickness(other);
  while (in->edge_count < SBRI_INNER_EDGES && in->set_count < SBRI_INNER_SETS && next_edge(&w)) {
    uint32_t a = w.ends[0], b = w.ends[1];
    sbf_vec3 from = sbri_lerp(s->places[a], s->places[b], w.shares[0]),
             to = sbri_lerp(s->places[a], s->places[b], w.shares[1]);
    if (!sbri_meet_is_inside(other->surface, sbri_lerp(from, to, 0.5f))) continue; /* it only touches */
    uint32_t mixed = (a * 0x9e3779b1u ^ b * 0x85ebca6bu) & (SBRI_EDGE_FEATURE - 1);
    sbri_box box = sbri_box_grown(sbri_box_with(sbri_box_of_point(from), to), about);
    in->edges[in->edge_count++] = (sbri_inner_edge){.set = in->set_count,
        .ends = {a, b},
        .feature = mixed | SBRI_EDGE_FEATURE,
        .share = 0.5f * (w.shares[0] + w.shares[1]),
        .alone = !w.ends_in[0] && !w.ends_in[1],
        .at = sbri_lerp(from, to, 0.5f),
        .along = sbri_normalize(sbri_sub(s->places[b], s->places[a]), sbri_vec3(0, 1, 0)),
        .length = sbri_length(sbri_sub(s->places[b], s->places[a]))};
    in->sets[in->set_count] = (sbri_inner_set){SBRI_NOWHERE, side, in->set_count, box, 1};
    in->set_count++;
  }
}

/* ---- Vertices ---- */

static void note_inside(const sbri_party *a, const sbri_party *b) {
  const sbri_meet_surface *s = a->surface;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    bool inside = s->samples[v].mass_kg > 0 && sbri_meet_is_inside(b->surface, s->places[v]);
    s->inside[v] = inside ? v : SBRI_NOT_INSIDE;
  }
  for (uint32_t i = 0; i < 3 * s->triangle_count; i++) {
    uint32_t from = s->triangles[i], to = s->triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (s->inside[from] == SBRI_NOT_INSIDE || s->inside[to] == SBRI_NOT_INSIDE) continue;
    sbfi_sets_join(s->inside, from, to);
  }
}

static uint32_t set_of(const sbri_inside *in, uint32_t side, uint32_t vertex) {
  uint32_t *inside = in->parties[side]->surface->inside;
  if (inside[vertex] == SBRI_NOT_INSIDE) return SBRI_NOWHERE;
  uint32_t root = sbfi_set_root(inside, vertex);
  for (uint32_t i = 0; i < in->set_count; i++)
    if (in->sets[i].side == side && in->sets[i].root == root) return i;
  return SBRI_NOWHERE;
}

static void list_sets(sbri_inside *in, uint32_t side) {
  const sbri_meet_surface *s = in->parties[side]->surface;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    if (s->inside[v] == SBRI_NOT_INSIDE) continue;
    sbri_box box = sbri_box_of_point(s->places[v]);
    uint32_t i = set_of(in, side, v);
    if (i == SBRI_NOWHERE) {
      if (in->set_count == SBRI_INNER_SETS - SBRI_INNER_EDGES) continue;
      i = in->set_count++;
      in->sets[i] = (sbri_inner_set){sbfi_set_root(s->inside, v), side, i, box, 0};
    }
    in->sets[i].box = sbri_box_join(in->sets[i].box, box), in->sets[i].count++;
  }
}

/* ---- Knots ---- */

static bool is_edge(const sbri_inner_set *s) {
  return s->root == SBRI_NOWHERE;
}

/* Sets of the two that lie about each other are one knot; and edges of one that do. */
static void tie(sbri_inside *in) {
  for (uint32_t i = 0; i < in->set_count; i++)
    for (uint32_t k = 0; k < i; k++) {
      const sbri_inner_set *p = &in->sets[i], *q = &in->sets[k];
      if (p->side == q->side && !is_edge(p) && !is_edge(q)) continue;
      if (p->knot == q->knot || !sbri_box_meets(&p->box, &q->box)) continue;
      uint32_t one = p->knot, other = q->knot, low = one < other ? one : other;
      for (uint32_t j = 0; j < in->set_count; j++)
        if (in->sets[j].knot == one || in->sets[j].knot == other) in->sets[j].knot = low;
    }
}

uint32_t sbri_knot_of(const sbri_inside *in, uint32_t side, uint32_t feature) {
  if (feature < SBRI_EDGE_FEATURE) {
    uint32_t set = set_of(in, side, feature);
    return set == SBRI_NOWHERE ? SBRI_NOWHERE : in->sets[set].knot;
  }
  for (uint32_t i = 0; i < in->edge_count; i++)
    if (in->edges[i].feature == feature && sbri_side_of_edge(in, &in->edges[i]) == side)
      return sbri_knot_of_edge(in, &in->edges[i]);
  return SBRI_NOWHERE;
}

void sbri_inside_look(sbri_inside *in) {
  in->set_count = in->edge_count = 0;
  for (uint32_t side = 0; side < 2; side++) note_inside(in->parties[side], in->parties[1 - side]);
  for (uint32_t side = 0; side < 2; side++) list_sets(in, side);
  for (uint32_t side = 0; side < 2 && sbri_are_coarse(in->parties[0], in->parties[1]); side++)
    list_edges(in, side);
  tie(in);
}
