/* The common way out of soft bodies that lie crosswise through each other.
 *
 * The nearest face is the way out of what has come in a little. Of two bars that cross each other it is not:
 * what lies on the two sides of a bar's middle goes to both sides, and they stay. There the vertices inside
 * of the other body, and those of the other inside of this one that lie about them, go the same way, and
 * back: the one along which all are out the soonest, by rays out of both bodies. It is remembered, so that it
 * does not change about. */
#include "base/union_find.h"
#include "meet/finding.h"

enum { SETS = 32, WAYS = 26, LOOKED_AT = 40 };
#define OUTSIDE UINT32_MAX
#define NONE UINT32_MAX
/* The nearest ways out of some lead against the common one by more than this (a cosine). */
static const float AGAINST = -0.3f;
/* A way that is so much shorter than the one that it goes takes its place. */
static const float SHORTER_SHARE = 0.6f;
/* One that is so many times as long as the nearest way out of the deepest of them is none: what has come in
 * all around, as an arm around a body, goes back as it came. */
static const float LONGER = 3;
static const sbf_vec3 no_way = {0, 0, 0};

/* Vertices of a surface that hang together and lie inside of the other one. */
typedef struct inner_set {
  uint32_t root, side; /* lowest vertex; 0: of a, in b, or 1 */
  uint32_t knot;       /* the first set of those that lie about each other */
  sbri_box box;
  uint32_t count;
} inner_set;

typedef struct looking {
  const sbri_finding *f;
  const sbri_party *parties[2];
  inner_set sets[SETS];
  uint32_t set_count;
  sbf_vec3 ways[SETS]; /* of each knot, for a's vertices; b's go back; 0: each by the nearest face */
  uint32_t first;      /* of the group's touches, that are theirs */
  float most;          /* m, that a way out is looked for at most */
} looking;

static float sign_of(uint32_t side) {
  return side ? -1.0f : 1.0f;
}

static bool is_way(sbf_vec3 way) {
  return sbri_dot(way, way) > 0;
}

/* ---- What is inside ---- */

static void note_inside(const sbri_party *a, const sbri_party *b) {
  const sbri_meet_surface *s = a->surface;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    bool inside = s->samples[v].mass_kg > 0 && sbri_meet_is_inside(b->surface, s->places[v]);
    s->inside[v] = inside ? v : OUTSIDE;
  }
  for (uint32_t i = 0; i < 3 * s->triangle_count; i++) {
    uint32_t from = s->triangles[i], to = s->triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (s->inside[from] == OUTSIDE || s->inside[to] == OUTSIDE) continue;
    sbfi_sets_join(s->inside, from, to);
  }
}

static uint32_t set_of(const looking *l, uint32_t side, uint32_t vertex) {
  uint32_t *inside = l->parties[side]->surface->inside;
  if (inside[vertex] == OUTSIDE) return NONE;
  uint32_t root = sbfi_set_root(inside, vertex);
  for (uint32_t i = 0; i < l->set_count; i++)
    if (l->sets[i].side == side && l->sets[i].root == root) return i;
  return NONE;
}

static void list_sets(looking *l, uint32_t side) {
  const sbri_meet_surface *s = l->parties[side]->surface;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    if (s->inside[v] == OUTSIDE) continue;
    sbri_box box = sbri_box_of_point(s->places[v]);
    uint32_t i = set_of(l, side, v);
    if (i == NONE) {
      if (l->set_count == SETS) continue;
      i = l->set_count++;
      l->sets[i] = (inner_set){sbfi_set_root(s->inside, v), side, i, box, 0};
    }
    l->sets[i].box = sbri_box_join(l->sets[i].box, box), l->sets[i].count++;
  }
}

/* Sets of the two that lie about each other are one knot. */
static void tie(looking *l) {
  for (uint32_t i = 0; i < l->set_count; i++)
    for (uint32_t k = 0; k < i; k++) {
      const inner_set *p = &l->sets[i], *q = &l->sets[k];
      if (p->side == q->side || !sbri_box_meets(&p->box, &q->box)) continue;
      uint32_t one = p->knot, other = q->knot, low = one < other ? one : other;
      for (uint32_t j = 0; j < l->set_count; j++)
        if (l->sets[j].knot == one || l->sets[j].knot == other) l->sets[j].knot = low;
    }
}

static uint32_t knot_of(const looking *l, uint32_t side, uint32_t vertex) {
  uint32_t set = set_of(l, side, vertex);
  return set == NONE ? NONE : l->sets[set].knot;
}

/* ---- Ways ---- */

/* m that the knot has to go until all of it is out; `most` and more: not less than that. */
static float way_out_along(const looking *l, uint32_t knot, sbf_vec3 along, float most) {
  float longest = 0;
  for (uint32_t side = 0; side < 2; side++) {
    const sbri_meet_surface *s = l->parties[side]->surface, *other = l->parties[1 - side]->surface;
    sbri_meet_way way = sbri_meet_way_along(sbri_scale(along, sign_of(side)));
    uint32_t count = 0, seen = 0, stride;
    for (uint32_t i = 0; i < l->set_count; i++)
      if (l->sets[i].side == side && l->sets[i].knot == knot) count += l->sets[i].count;
    stride = 1 + count / LOOKED_AT;
    for (uint32_t v = 0; v < s->vertex_count && count > 0; v++) {
      sbri_surface_finding found;
      if (s->inside[v] == OUTSIDE || knot_of(l, side, v) != knot || seen++ % stride) continue;
      float out = sbri_meet_way_along_out(other, &way, s->places[v], most, &found);
      if (!(out < most)) return INFINITY;
      longest = out > longest ? out : longest;
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

/* m that the deepest has to the nearest face. */
static float deepest_of(const looking *l, uint32_t knot) {
  float deepest = 0;
  for (uint32_t side = 0; side < 2; side++) {
    const sbri_meet_surface *s = l->parties[side]->surface;
    const sbri_party *in = l->parties[1 - side];
    for (uint32_t v = 0; v < s->vertex_count; v++) {
      sbri_surface_finding found;
      if (s->inside[v] == OUTSIDE || knot_of(l, side, v) != knot) continue;
      if (!sbri_meet_way_out(in, s->places[v], &found)) continue;
      const uint32_t *c = in->surface->triangles + 3 * (size_t)found.face;
      const sbf_vec3 *at = in->surface->places;
      float deep = sbri_length(
          sbri_sub(sbri_triangle_place(found.weights, at[c[0]], at[c[1]], at[c[2]]), s->places[v]));
      deepest = deep > deepest ? deep : deepest;
    }
  }
  return deepest;
}

/* What is remembered of one side's vertices. */
static const sbri_meet_memory *memories_of(const looking *l, uint32_t side, uint32_t *count) {
  const uint64_t names[2] = {sbri_meet_name(l->parties[side]->is), sbri_meet_name(l->parties[1 - side]->is)};
  return sbri_meet_memories_of(l->f->world->meetings, names, count);
}

/* The one that it went in the tick before, but for the turns of both; or 0. */
static sbf_vec3 recall_way(const looking *l, uint32_t knot) {
  sbf_vec3 sum = no_way;
  for (uint32_t side = 0; side < 2; side++) {
    uint32_t count;
    const sbri_meet_memory *m = memories_of(l, side, &count);
    for (uint32_t i = 0; i < count; i++)
      if (is_way(m[i].through) && knot_of(l, side, m[i].feature) == knot)
        sum = sbri_add_scaled(sum, m[i].through, sign_of(side));
  }
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
  return t->names[0] == sbri_meet_name(l->parties[0]->is) ? 0 : 1;
}

/* Whether the nearest way out of some of the knot leads against the common one. */
static bool is_against(const looking *l, uint32_t knot, sbf_vec3 way) {
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++) {
    const sbri_meet_touch *t = &touches_of(l)[i];
    uint32_t side = side_of(l, t);
    if (sbri_dot(t->normal, way) * sign_of(side) < AGAINST && knot_of(l, side, t->feature) == knot)
      return true;
  }
  return false;
}

/* Whether no face is near to some of the knot. */
static bool is_deep(const looking *l, uint32_t knot) {
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++) {
    const sbri_meet_touch *t = &touches_of(l)[i];
    if (t->goes_out && knot_of(l, side_of(l, t), t->feature) == knot) return true;
  }
  return false;
}

/* What went a common way goes it until that is the nearest one. */
static sbf_vec3 choose_way(const looking *l, uint32_t knot) {
  sbf_vec3 way = recall_way(l, knot);
  if (is_way(way)) {
    way = keep_way(l, knot, way);
    return is_deep(l, knot) || is_against(l, knot, way) ? way : no_way;
  }
  if (!is_deep(l, knot)) return no_way;
  way = find_way(l, knot);
  if (!is_way(way) || !is_against(l, knot, way)) return no_way;
  return way_out_along(l, knot, way, l->most) > LONGER * deepest_of(l, knot) ? no_way : way;
}

static void lead_out(const looking *l, sbri_meet_touch *t) {
  uint32_t side = side_of(l, t), knot = knot_of(l, side, t->feature);
  if (knot == NONE || !is_way(l->ways[knot])) return;
  const sbri_party *in = l->parties[1 - side];
  sbri_meet_way way = sbri_meet_way_along(sbri_scale(l->ways[knot], sign_of(side)));
  sbri_surface_finding found;
  sbf_vec3 x = l->parties[side]->surface->places[t->feature];
  if (!(sbri_meet_way_along_out(in->surface, &way, x, l->most, &found) < l->most)) return;
  t->b = sbri_soft_side(in, in->surface->triangles + 3 * (size_t)found.face, found.weights, 3);
  t->normal = way.along;
  t->goes_out = t->goes_through = true;
  t->friction = 0;
}

/* ---- All ---- */

static bool goes_out(const looking *l) {
  for (uint32_t i = l->first; i < l->f->group->touch_count; i++)
    if (touches_of(l)[i].goes_out) return true;
  return false;
}

static bool went_through(const looking *l) {
  for (uint32_t side = 0; side < 2; side++) {
    uint32_t count;
    const sbri_meet_memory *m = memories_of(l, side, &count);
    for (uint32_t i = 0; i < count; i++)
      if (is_way(m[i].through)) return true;
  }
  return false;
}

void sbri_meet_through(const sbri_finding *f, const sbri_party *a, const sbri_party *b, uint32_t first) {
  float sizes[2] = {a->soft->rest_size_m * a->of->scale, b->soft->rest_size_m * b->of->scale};
  looking l = {.f = f, .parties = {a, b}, .first = first, .most = sizes[0] < sizes[1] ? sizes[0] : sizes[1]};
  if (!goes_out(&l) && !went_through(&l)) return;
  note_inside(a, b);
  note_inside(b, a);
  list_sets(&l, 0);
  list_sets(&l, 1);
  tie(&l);
  for (uint32_t k = 0; k < l.set_count; k++) l.ways[k] = l.sets[k].knot == k ? choose_way(&l, k) : no_way;
  for (uint32_t i = first; i < f->group->touch_count; i++) lead_out(&l, &touches_of(&l)[i]);
}
