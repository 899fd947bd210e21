/* The common way out of soft bodies that lie crosswise through each other.
 *
 * The nearest face is the way out of what has come in a little. Of two bars that cross each other it is not:
 * what lies on the two sides of a bar's middle goes to both sides, and they stay. There the vertices inside
 * of the other body, and those of the other inside of this one that lie about them, go the same way, and
 * back: the one along which all are out the soonest, by rays out of both bodies. It is remembered, so that it
 * does not change about. */
#include "meet/inside.h"

enum { WAYS = 26, LOOKED_AT = 40, PRODUCTS = 8 };
/* The nearest ways out of some lead against the common one by more than this (a cosine); and against each
 * other: along some axis by more than this share to both sides. */
static const float AGAINST = -0.3f, APART_SHARE = 0.5f;
/* A way that is so much shorter than the one that it goes takes its place. */
static const float SHORTER_SHARE = 0.6f;
/* One that is so many times as long as the nearest way out of the deepest of them is none: what has come in
 * all around, as an arm around a body, goes back as it came. */
static const float LONGER = 3;
/* Of thin limbs' thicknesses together, if that is more: the middles of their edges are never deep. */
static const float THROUGH_SHARE = 0.75f;
/* An edge whose nearest way out is longer than this share of how thick the other one is goes through it. */
static const float EDGE_DEEP_SHARE = 0.25f;
/* Less of that than this is what ridges that touch may come to. */
static const float EDGE_IN_SHARE = 0.1f;
/* A way along an edge (a cosine). */
static const float ALONG = 0.7f;
/* Of the thinner one's thickness. */
static const float ABOUT_SHARE = 0.25f;
/* Limbs that lie along each other by less than this (a sine) do not cross. */
static const float CROSS_SINE = 0.2f;
static const sbf_vec3 no_way = {0, 0, 0};

typedef struct looking {
  const sbri_finding *f;
  sbri_inside in;
  sbf_vec3 ways[SBRI_INNER_SETS]; /* of each knot, for a's; b's go back; 0: each by the nearest face */
  uint32_t first;                 /* of the group's touches, that are theirs */
  float most;                     /* m, that a way out is looked for at most */
  float about;                    /* m: what is so near to a knot is not to be in its way */
} looking;

static float sign_of(uint32_t side) {
  return side ? -1.0f : 1.0f;
}

static bool is_way(sbf_vec3 way) {
  return sbri_dot(way, way) > 0;
}

/* Of an edge of the knot: its side, or 2. */
static uint32_t side_in_knot(const looking *l, const sbri_inner_edge *e, uint32_t knot) {
  return sbri_knot_of_edge(&l->in, e) == knot ? sbri_side_of_edge(&l->in, e) : 2;
}

/* Whether the way leads a long edge along itself: so it does not leave. */
static bool leads_along(const looking *l, const sbri_inner_edge *e, sbf_vec3 way) {
  const sbri_party *in = l->in.parties[1 - sbri_side_of_edge(&l->in, e)];
  return e->length > sbri_party_thickness(in) && fabsf(sbri_dot(way, e->along)) > ALONG;
}

/* Of an edge: m to the nearest face of the other, and the way there; 0: there is none. */
static float nearest_out(const looking *l, const sbri_inner_edge *e, sbf_vec3 *out) {
  const sbri_party *in = l->in.parties[1 - sbri_side_of_edge(&l->in, e)];
  sbri_surface_finding found;
  if (!sbri_meet_way_out(in, e->at, &found)) return 0;
  *out = found.normal;
  return sbri_party_distance(in, &found, e->at);
}

/* ---- Ways ---- */

/* m that the place has to go; or `longest`, if that is more. */
static float longer_of(
    const sbri_meet_surface *in, const sbri_meet_way *way, sbf_vec3 x, float most, float longest) {
  sbri_surface_finding found;
  float out = sbri_meet_way_along_out(in, way, x, most, &found);
  return out > longest ? out : longest;
}

/* m that the knot has to go until all of it is out; INFINITY: not less than `most`. */
static float way_out_along(const looking *l, uint32_t knot, sbf_vec3 along, float most) {
  float longest = 0;
  for (uint32_t side = 0; side < 2; side++) {
    const sbri_meet_surface *s = l->in.parties[side]->surface, *other = l->in.parties[1 - side]->surface;
    sbri_meet_way way = sbri_meet_way_along(sbri_scale(along, sign_of(side)));
    uint32_t count = 0, seen = 0, stride;
    for (uint32_t i = 0; i < l->in.set_count; i++) {
      const sbri_inner_set *set = &l->in.sets[i];
      if (set->side == side && set->knot == knot && set->root != SBRI_NOWHERE) count += set->count;
    }
    stride = 1 + count / LOOKED_AT;
    for (uint32_t v = 0; v < s->vertex_count && count > 0; v++) {
      if (s->inside[v] == SBRI_NOT_INSIDE || sbri_knot_of(&l->in, side, v) != knot || seen++ % stride)
        continue;
      longest = longer_of(other, &way, s->places[v], most, longest);
      if (!(longest < most)) return INFINITY;
    }
    for (uint32_t i = 0; i < l->in.edge_count; i++) {
      const sbri_inner_edge *e = &l->in.edges[i];
      if (side_in_knot(l, e, knot) != side) continue;
      longest = longer_of(other, &way, e->at, most, longest);
      if (!(longest < most) || leads_along(l, e, way.along)) return INFINITY;
    }
  }
  return longest;
}

/* To the sides, sides' middles and corners of a cube. */
static sbf_vec3 way_number(uint32_t number) {
  uint32_t n = number < 13 ? number : number + 1; /* 13 is its middle */
  sbf_vec3 to = sbri_vec3((float)(n % 3) - 1, (float)(n / 3 % 3) - 1, (float)(n / 9) - 1);
  return sbri_normalize(to, to);
}

/* The shortest of all, shorter than `most`; or 0. */
static sbf_vec3 find_way(const looking *l, uint32_t knot) {
  sbf_vec3 best = no_way;
  float least = l->most;
  for (uint32_t i = 0; i < WAYS; i++) {
    float out = way_out_along(l, knot, way_number(i), least);
    if (out < least) least = out, best = way_number(i);
  }
  return best;
}

/* The direction that the knot's edges of one side have in common: what the sum of their squares turns least,
 * by repeated products; and the middle of their stretches. */
static sbf_vec3 axis_of(const looking *l, uint32_t knot, uint32_t side, sbf_vec3 *middle) {
  float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0, count = 0;
  *middle = no_way;
  for (uint32_t i = 0; i < l->in.edge_count; i++) {
    const sbri_inner_edge *e = &l->in.edges[i];
    sbf_vec3 d = e->along, to = sbri_scale(d, e->length);
    if (side_in_knot(l, e, knot) != side) continue;
    xx += d.x * to.x, yy += d.y * to.y, zz += d.z * to.z;
    xy += d.x * to.y, xz += d.x * to.z, yz += d.y * to.z;
    *middle = sbri_add(*middle, e->at), count++;
  }
  sbf_vec3 axis = xx >= yy && xx >= zz ? sbri_vec3(1, 0, 0)
                  : yy >= zz           ? sbri_vec3(0, 1, 0)
                                       : sbri_vec3(0, 0, 1);
  if (count == 0) return no_way;
  *middle = sbri_scale(*middle, 1 / count);
  for (int i = 0; i < PRODUCTS; i++)
    axis =
        sbri_normalize(sbri_vec3(xx * axis.x + xy * axis.y + xz * axis.z,
                           xy * axis.x + yy * axis.y + yz * axis.z, xz * axis.x + yz * axis.y + zz * axis.z),
            axis);
  return axis;
}

/* Where the limb is about that place: not where its edges' stretches are, which of limbs that are in each
 * other a little are on the other's side. */
static sbf_vec3 middle_about(const sbri_party *p, sbf_vec3 x) {
  const sbri_meet_surface *s = p->surface;
  float near = (s->edge_m + s->thick_m) * p->of->scale, count = 0;
  sbf_vec3 sum = no_way;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    sbf_vec3 off = sbri_sub(s->places[v], x);
    if (sbri_dot(off, off) < near * near) sum = sbri_add(sum, s->places[v]), count++;
  }
  return count > 0 ? sbri_scale(sum, 1 / count) : x;
}

/* Of thin limbs that cross: across both, to the side that each is on; or 0. */
static sbf_vec3 way_across(const looking *l, uint32_t knot) {
  sbf_vec3 middles[2], a = axis_of(l, knot, 0, &middles[0]), b = axis_of(l, knot, 1, &middles[1]);
  sbf_vec3 n = sbri_cross(a, b);
  if (sbri_length(n) < CROSS_SINE) return no_way;
  n = sbri_normalize(n, n);
  for (int k = 0; k < 2; k++) middles[k] = middle_about(l->in.parties[k], middles[k]);
  if (sbri_dot(n, sbri_sub(middles[0], middles[1])) < 0) n = sbri_scale(n, -1);
  return way_out_along(l, knot, n, l->most) < l->most ? n : no_way;
}

/* m that the deepest has to the nearest face. */
static float deepest_of(const looking *l, uint32_t knot) {
  float deepest = 0;
  for (uint32_t side = 0; side < 2; side++) {
    const sbri_meet_surface *s = l->in.parties[side]->surface;
    const sbri_party *in = l->in.parties[1 - side];
    for (uint32_t v = 0; v < s->vertex_count; v++) {
      sbri_surface_finding found;
      if (s->inside[v] == SBRI_NOT_INSIDE || sbri_knot_of(&l->in, side, v) != knot) continue;
      if (!sbri_meet_way_out(in, s->places[v], &found)) continue;
      deepest = fmaxf(deepest, sbri_party_distance(in, &found, s->places[v]));
    }
  }
  for (uint32_t i = 0; i < l->in.edge_count; i++) {
    sbf_vec3 out;
    if (side_in_knot(l, &l->in.edges[i], knot) < 2)
      deepest = fmaxf(deepest, nearest_out(l, &l->in.edges[i], &out));
  }
  return deepest;
}

/* The first of what is remembered of one side, and the next; NULL: no more. */
static const sbri_meet_memory *first_memory(const looking *l, uint32_t side) {
  const uint64_t names[2] = {
      sbri_meet_name(l->in.parties[side]->is), sbri_meet_name(l->in.parties[1 - side]->is)};
  return sbri_meet_first_memory(l->f->world->meetings, names);
}

static const sbri_meet_memory *next_memory(const looking *l, const sbri_meet_memory *m) {
  return sbri_meet_next_memory(l->f->world->meetings, m);
}

/* The one that it went in the tick before, but for the turns of both; or 0. */
static sbf_vec3 recall_way(const looking *l, uint32_t knot) {
  sbf_vec3 sum = no_way;
  for (uint32_t side = 0; side < 2; side++)
    for (const sbri_meet_memory *m = first_memory(l, side); m; m = next_memory(l, m))
      if (is_way(m->through) && sbri_knot_of(&l->in, side, m->feature) == knot)
        sum = sbri_add_scaled(sum, m->through, sign_of(side));
  return is_way(sum) ? sbri_normalize(sum, sum) : sum;
}

/* One other way a tick is looked at beside it. */
static sbf_vec3 keep_way(const looking *l, uint32_t knot, sbf_vec3 way) {
  float out = way_out_along(l, knot, way, l->most);
  if (!(out < l->most)) return find_way(l, knot);
  sbf_vec3 other = way_number((uint32_t)(l->f->world->ticks % WAYS));
  return way_out_along(l, knot, other, SHORTER_SHARE * out) < SHORTER_SHARE * out ? other : way;
}

/* ---- Touches ---- */

static sbri_meet_touch *touches_of(const looking *l) {
  return l->f->world->meetings->touches + l->f->group->first_touch;
}

static uint32_t side_of(const looking *l, const sbri_meet_touch *t) {
  return t->names[0] == sbri_meet_name(l->in.parties[0]->is) ? 0 : 1;
}

/* Whether the nearest way out of some of the knot leads against the common one. */
static bool is_against(const looking *l, uint32_t knot, sbf_vec3 way) {
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++) {
    const sbri_meet_touch *t = &touches_of(l)[i];
    uint32_t side = side_of(l, t);
    if (sbri_dot(t->normal, way) * sign_of(side) < AGAINST && sbri_knot_of(&l->in, side, t->feature) == knot)
      return true;
  }
  return false;
}

/* Whether no face is near to some of the knot. */
static bool is_deep(const looking *l, uint32_t knot) {
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++) {
    const sbri_meet_touch *t = &touches_of(l)[i];
    if (t->goes_out && sbri_knot_of(&l->in, side_of(l, t), t->feature) == knot) return true;
  }
  return false;
}

static bool lead_apart(const sbri_box *ways) {
  const sbf_vec3 *a = &ways->low, *b = &ways->high;
  return (a->x < -APART_SHARE && b->x > APART_SHARE) || (a->y < -APART_SHARE && b->y > APART_SHARE) ||
         (a->z < -APART_SHARE && b->z > APART_SHARE);
}

/* Whether nearest ways out lead against each other, of vertices in the knot that are in so far that it is no
 * matter of how surfaces lie on each other; or, SBRI_NOWHERE, of any. */
static bool lies_across(const looking *l, uint32_t knot) {
  sbri_box ways = sbri_box_of_point(no_way);
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++) {
    const sbri_meet_touch *t = &touches_of(l)[i];
    uint32_t side = side_of(l, t);
    if (t->is_in && (knot == SBRI_NOWHERE || sbri_knot_of(&l->in, side, t->feature) == knot))
      ways = sbri_box_with(ways, sbri_scale(t->normal, sign_of(side)));
  }
  return lead_apart(&ways);
}

/* Likewise of its edges; or one is as deep as vertices would be that have gone through. */
static bool edges_lie_across(const looking *l, uint32_t knot) {
  sbri_box ways = sbri_box_of_point(no_way);
  for (uint32_t i = 0; i < l->in.edge_count; i++) {
    sbf_vec3 out = no_way;
    uint32_t side = side_in_knot(l, &l->in.edges[i], knot);
    if (side > 1) continue;
    const sbri_party *in = l->in.parties[1 - side];
    float depth = nearest_out(l, &l->in.edges[i], &out);
    if (depth > EDGE_DEEP_SHARE * sbri_party_thickness(in)) return true;
    if (depth > EDGE_IN_SHARE * sbri_party_thickness(in))
      ways = sbri_box_with(ways, sbri_scale(out, sign_of(side)));
  }
  return lead_apart(&ways);
}

/* What went a common way goes it until that is the nearest one. */
static sbf_vec3 choose_way(const looking *l, uint32_t knot) {
  sbf_vec3 way = recall_way(l, knot);
  bool edges = edges_lie_across(l, knot);
  if (is_way(way)) {
    if (!edges || !(way_out_along(l, knot, way, l->most) < l->most)) way = keep_way(l, knot, way);
    return edges || is_deep(l, knot) || is_against(l, knot, way) ? way : no_way;
  }
  if (!edges && !is_deep(l, knot) && !lies_across(l, knot)) return no_way;
  if (edges) way = way_across(l, knot);
  if (!is_way(way)) way = find_way(l, knot);
  bool rigid = l->in.parties[1]->rigid != NULL; /* which goes all one way anyhow */
  if (!is_way(way) || !(edges || rigid || is_against(l, knot, way))) return no_way;
  float longest = LONGER * deepest_of(l, knot);
  if (edges)
    longest = fmaxf(longest,
        THROUGH_SHARE * (sbri_party_thickness(l->in.parties[0]) + sbri_party_thickness(l->in.parties[1])));
  return way_out_along(l, knot, way, l->most) > longest ? no_way : way;
}

/* Where x leaves the other one: as a touch of it. */
static bool leave(const looking *l, uint32_t side, sbf_vec3 along, sbf_vec3 x, sbri_meet_touch *t) {
  const sbri_party *in = l->in.parties[1 - side];
  sbri_meet_way way = sbri_meet_way_along(along);
  sbri_surface_finding found;
  if (!(sbri_meet_way_along_out(in->surface, &way, x, l->most, &found) < l->most)) return false;
  t->b = sbri_party_side(in, in->surface->triangles + 3 * (size_t)found.face, found.weights, 3);
  t->normal = way.along;
  t->goes_out = t->goes_through = true;
  t->friction = 0;
  return true;
}

static void lead_out(const looking *l, sbri_meet_touch *t) {
  uint32_t side = side_of(l, t), knot = sbri_knot_of(&l->in, side, t->feature);
  if (knot == SBRI_NOWHERE || !is_way(l->ways[knot])) return;
  (void)leave(
      l, side, sbri_scale(l->ways[knot], sign_of(side)), l->in.parties[side]->surface->places[t->feature], t);
}

static void lead_edge_out(const looking *l, const sbri_inner_edge *e) {
  uint32_t side = sbri_side_of_edge(&l->in, e), knot = sbri_knot_of_edge(&l->in, e);
  const float weights[2] = {1 - e->share, e->share};
  sbri_meet_touch t = {.feature = e->feature};
  if (!e->alone || !is_way(l->ways[knot])) return;
  if (!leave(l, side, sbri_scale(l->ways[knot], sign_of(side)), e->at, &t)) return;
  t.a = sbri_party_side(l->in.parties[side], e->ends, weights, 2);
  sbri_finding_add(l->f, l->in.parties[side], l->in.parties[1 - side], &t);
}

/* Whether it keeps what is outside from going along with a knot that it lies about. */
static bool is_in_the_way(const looking *l, const sbri_meet_touch *t) {
  uint32_t side = side_of(l, t);
  sbf_vec3 x = l->in.parties[side]->surface->places[t->feature];
  if (t->goes_out || sbri_knot_of(&l->in, side, t->feature) != SBRI_NOWHERE) return false;
  for (uint32_t i = 0; i < l->in.set_count; i++) {
    sbf_vec3 way = l->ways[l->in.sets[i].knot];
    sbri_box at = sbri_box_of_point(x), about = sbri_box_grown(l->in.sets[i].box, l->about);
    if (sbri_dot(t->normal, way) * sign_of(side) < AGAINST && sbri_box_meets(&at, &about)) return true;
  }
  return false;
}

static void clear_the_way(const looking *l) {
  uint32_t kept = l->first;
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++)
    if (!is_in_the_way(l, &touches_of(l)[i])) touches_of(l)[kept++] = touches_of(l)[i];
  l->f->group->touch_count = kept;
}

/* ---- All ---- */

static bool goes_out(const looking *l) {
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++)
    if (touches_of(l)[i].goes_out) return true;
  return false;
}

static bool went_through(const looking *l) {
  for (uint32_t side = 0; side < 2; side++)
    for (const sbri_meet_memory *m = first_memory(l, side); m; m = next_memory(l, m))
      if (is_way(m->through)) return true;
  return false;
}

static bool are_near(const sbri_party *a, const sbri_party *b) {
  sbri_box box = b->surface->tree.nodes[0].box;
  if (b->rigid) {
    sbr_transform at = sbri_party_frame(b, false);
    box = sbri_box_grown(sbri_box_of_point(at.position), b->rigid->radius * b->of->scale);
  }
  return sbri_box_meets(&a->surface->tree.nodes[0].box, &box);
}

void sbri_meet_through(const sbri_finding *f, const sbri_party *a, const sbri_party *b, uint32_t first) {
  float sizes[2] = {sbri_party_size(a), sbri_party_size(b)};
  looking l = {.f = f, .first = first, .most = fminf(sizes[0], sizes[1])};
  l.in.parties[0] = a, l.in.parties[1] = b;
  l.about = ABOUT_SHARE * fminf(sbri_party_thickness(a), sbri_party_thickness(b));
  bool begins = goes_out(&l) || went_through(&l) || lies_across(&l, SBRI_NOWHERE);
  if (!begins && !(sbri_are_coarse(a, b) && are_near(a, b))) return;
  if (b->rigid) {
    sbr_transform at = sbri_party_frame(b, false);
    sbri_meet_hull_place(b->rigid, &at, &at, b->of->scale, b->surface);
  }
  if (!begins && !sbri_edges_go_through(a->surface, b->surface)) return;
  sbri_inside_look(&l.in);
  for (uint32_t k = 0; k < l.in.set_count; k++)
    l.ways[k] = l.in.sets[k].knot == k ? choose_way(&l, k) : no_way;
  clear_the_way(&l);
  uint32_t end = f->group->touch_count;
  for (uint32_t i = first; i < end; i++) lead_out(&l, &touches_of(&l)[i]);
  for (uint32_t i = 0; i < l.in.edge_count; i++) lead_edge_out(&l, &l.in.edges[i]);
}
