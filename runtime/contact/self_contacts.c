/* Self-contact of points and triangles. Once per tick each point is tested against the triangles of its own
 * surface. A triangle that the point approaches or crosses becomes a contact: a sample with weight 1 for the
 * point and negative weights for the corners. Its position is that of the point relative to the triangle, so
 * an impulse on it acts on both sides and conserves momentum.
 *
 * Triangles with a corner that is connected to the point by an edge are skipped. In a fold sharp enough for
 * such a contact, the next row of points keeps the two sides apart, and a contact between neighbours would
 * oscillate.
 *
 * Parts that are closer at rest than the thickness keep their rest distance as thickness, so that they do not
 * push each other apart. */
#include "contact/self_contacts.h"

#include "contact/self_query.h"

/* Hysteresis, as a fraction of the body's size: without it a contact at the thickness would end every other
 * tick.
 */
static const float NEAR_FRACTION = 0.01f;

/* Fraction of the thickness that a point keeps from triangles with a corner that is connected to it by an
 * edge. */
static const float CONNECTED_FRACTION = 0.2f;

static sbri_moving_ball ball_of(const sbri_self_search *l, const uint32_t *c) {
  sbri_moving_ball ball;
  sbf_vec3 p[3];
  float square = 0, directions = 0;
  for (int k = 0; k < 3; k++) {
    sbf_vec3 displacement = sbri_self_displacement(l->tick, c[k]);
    p[k] = sbri_self_position(l->tick->positions, c[k]);
    directions = sbri_max(directions, sbri_dot(displacement, displacement));
  }
  ball.middle = sbri_scale(sbri_add(sbri_add(p[0], p[1]), p[2]), 1.0f / 3);
  for (int k = 0; k < 3; k++) {
    sbf_vec3 offset = sbri_sub(p[k], ball.middle);
    square = sbri_max(square, sbri_dot(offset, offset));
  }
  ball.radius = sqrtf(square), ball.distance = sqrtf(directions);
  return ball;
}

static void make_bounds(const sbri_self_search *l, sbri_box *boxes, sbri_moving_ball *balls) {
  for (uint32_t f = 0; f < l->body->self.face_count; f++) {
    const uint32_t *c = l->body->self.faces + 3 * (size_t)f;
    boxes[f] = sbri_self_swept(l->tick, c[0], l->rule.outer);
    for (int k = 1; k < 3; k++)
      boxes[f] = sbri_box_join(boxes[f], sbri_self_swept(l->tick, c[k], l->rule.outer));
    balls[f] = ball_of(l, c);
  }
}

/* A point and the bounds of its possible contacts. */
typedef struct contact_point {
  uint32_t slot;
  sbf_vec3 x, displacement;
  float reach; /* m, without the displacement of a triangle */
  sbri_box box;
} contact_point;

static contact_point contact_point_of(const sbri_self_search *l, uint32_t slot) {
  contact_point p = {.slot = slot,
      .x = sbri_self_position(l->tick->positions, slot),
      .displacement = sbri_self_displacement(l->tick, slot),
      .box = sbri_self_swept(l->tick, slot, l->rule.outer)};
  float distance = l->rule.outer + 2 * sbri_length(p.displacement);
  p.reach = l->rule.two_sided ? distance : sbri_max(distance, l->rule.inner);
  return p;
}

/* Whether the point may approach the triangle or be behind it. */
static bool may_intersect(const sbri_self_search *l, const contact_point *p, uint32_t number) {
  const uint32_t *c = l->body->self.faces + 3 * (size_t)number;
  const sbri_moving_ball *ball = &l->balls[number];
  sbf_vec3 offset = sbri_sub(p->x, ball->middle);
  float max = ball->radius + 2 * ball->distance + p->reach;
  return sbri_dot(offset, offset) <= 1.0001f * max * max && sbri_boxes_overlap(&p->box, &l->boxes[number]) &&
         c[0] != p->slot && c[1] != p->slot && c[2] != p->slot;
}

static sbri_surface_hit check(const sbri_self_search *l, const contact_point *at, uint32_t number) {
  const sbri_island_tick *t = l->tick;
  const uint32_t *c = l->body->self.faces + 3 * (size_t)number;
  sbri_surface_face face;
  for (int k = 0; k < 3; k++)
    face.at[k] = sbri_self_position(t->positions, c[k]), face.directions[k] = sbri_self_displacement(t, c[k]);
  sbri_surface_hit found = sbri_surface_nothing();
  sbri_surface_query(&l->rule, at->x, at->displacement, &face, number, &found);
  return found;
}

/* Distance of the point from the triangle at rest; negative behind a surface that encloses a volume. */
static float rest_gap(const sbri_self_search *l, uint32_t slot, const uint32_t *corners) {
  const sbri_point *rest = l->tick->island->rest;
  sbf_vec3 p[3];
  for (int k = 0; k < 3; k++) p[k] = sbri_self_position(rest, corners[k]);
  return sbri_surface_gap(&l->rule, sbri_self_position(rest, slot), p);
}

/* Whether an edge connects the point to a corner of the triangle. */
static bool is_connected(const sbri_body *body, uint32_t slot, const uint32_t *c) {
  for (int k = 0; k < 3; k++)
    if (sbri_self_are_joined(body, slot, c[k])) return true;
  return false;
}

/* Results of a point: the best triangle that is not connected to it, the best connected one, and candidates
 * of the former kind for a contact on the other side of the point. */
enum { OTHERS = 128 };
typedef struct point_hits {
  sbri_surface_hit best, connected, others[OTHERS];
  uint32_t other_count; /* if above OTHERS, the candidates are searched again */
} point_hits;

/* Merges a result as if both triangles had been in one query. */
static void merge_hit(sbri_surface_hit *best, const sbri_surface_hit *one) {
  float before = one->before < best->before ? one->before : best->before;
  if (one->urgency < best->urgency) *best = *one;
  best->before = before;
}

static void query_point(const sbri_self_search *l, const contact_point *p, point_hits *a) {
  sbri_bounds_walk walk;
  uint32_t item;
  a->best = a->connected = sbri_surface_nothing();
  a->other_count = 0;
  sbri_bounds_walk_begin(&walk, l->tree, p->box);
  while (sbri_bounds_walk_next(&walk, &item)) {
    if (!may_intersect(l, p, item)) continue;
    sbri_surface_hit one = check(l, p, item);
    if (one.urgency == INFINITY && (l->rule.two_sided || one.before == INFINITY)) continue;
    if (is_connected(l->body, p->slot, l->body->self.faces + 3 * (size_t)item)) {
      merge_hit(&a->connected, &one);
      continue;
    }
    merge_hit(&a->best, &one);
    if (one.urgency == INFINITY || one.behind) continue;
    if (a->other_count < OTHERS) a->others[a->other_count] = one;
    a->other_count++;
  }
}

static void add_opposite(const sbri_surface_hit *one, const sbri_surface_hit *found, sbri_surface_hit *best) {
  if (one->urgency < best->urgency && sbri_dot(one->normal, found->normal) < 0) *best = *one;
}

/* The most urgent triangle on the opposite side of the most urgent one of all. */
static bool find_opposite(
    const sbri_self_search *l, const contact_point *p, const point_hits *a, sbri_surface_hit *best) {
  *best = sbri_surface_nothing();
  if (a->other_count <= OTHERS) {
    for (uint32_t i = 0; i < a->other_count; i++) add_opposite(&a->others[i], &a->best, best);
    return sbri_surface_found(best);
  }
  sbri_bounds_walk walk;
  uint32_t item;
  sbri_bounds_walk_begin(&walk, l->tree, p->box);
  while (sbri_bounds_walk_next(&walk, &item)) {
    if (!may_intersect(l, p, item)) continue;
    sbri_surface_hit one = check(l, p, item);
    if (!one.behind && !is_connected(l->body, p->slot, l->body->self.faces + 3 * (size_t)item))
      add_opposite(&one, &a->best, best);
  }
  return sbri_surface_found(best);
}

static void add(const sbri_self_search *l, uint32_t slot, const sbri_surface_hit *found, float thickness) {
  const uint32_t *c = l->body->self.faces + 3 * (size_t)found->face, slots[4] = {slot, c[0], c[1], c[2]};
  const float weights[4] = {1, -found->weights[0], -found->weights[1], -found->weights[2]};
  sbri_sample s = sbri_self_sample(l->tick->island, slots, weights);
  sbri_self_add(l, &s, found->normal, rest_gap(l, slot, c), thickness, false);
}

static void add_point(const sbri_self_search *l, uint32_t slot) {
  point_hits a;
  sbri_surface_hit opposite;
  float thickness = l->body->source->collision.outer_thickness;
  contact_point p = contact_point_of(l, slot);
  query_point(l, &p, &a);
  if (sbri_surface_found(&a.best)) {
    add(l, slot, &a.best, thickness);
    if (!a.best.behind && find_opposite(l, &p, &a, &opposite)) add(l, slot, &opposite, thickness);
  }
  if (sbri_surface_found(&a.connected)) add(l, slot, &a.connected, CONNECTED_FRACTION * thickness);
}

void sbri_self_contacts_add(const sbri_island_tick *t, const sbri_body *body,
    const sbri_contact_tables *tables, sbri_bounds_tree *tree) {
  const sbf_collision *rule = &body->source->collision;
  sbri_self_search l = {t, body, tables, tree, tables->self_boxes, tables->self_balls,
      {rule->outer_thickness + NEAR_FRACTION * body->rest_size_m, rule->inner_thickness,
          body->self.is_sheet || body->surface.rest_volume_m3 == 0}};
  uint32_t *count = &tables->contact_counts[body - t->model->bodies], before = *count;
  make_bounds(&l, tables->self_boxes, tables->self_balls);
  sbri_bounds_tree_make(tree, tables->self_boxes, body->self.face_count);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) add_point(&l, slot);
  if (l.rule.two_sided) sbri_self_edges_add(&l);
  /* A sheet that intersects itself has some contact; a deep point of a closed surface may have none. */
  if ((*count > before || !l.rule.two_sided) && !body->self.is_tangled) sbri_self_crossings_add(&l);
}
