/* Once a tick each point looks for the triangle of its own surface that it comes near to or goes through, and
 * gets a touch with it: a sample whose weights are 1 for the point and below 0 for the corners, so that its
 * place is the point's against the triangle, and a push on it acts on both sides alike and keeps momentum.
 *
 * What is nearer at rest than the thickness is kept no further off than it was: parts that overlap at rest do
 * not fight. */
#include "contact/self_touch.h"

#include "collide/surface_look.h"
#include "math/vec3.h"

/* Of the distance at rest, where that is less than the thickness. */
static const float REST_SHARE = 0.9f;
/* Nearer than this at rest, two parts are one. */
static const float TOGETHER_M = 1e-5f;

/* What lies at the thickness would else be let go each other tick, and fall: of the body's size. */
static const float NEAR_SHARE = 0.01f;

typedef struct looking {
  const sbri_island_tick *tick;
  const sbri_body *body;
  sbri_surface_rule rule;
} looking;

static sbf_vec3 at(const sbri_point *points, uint32_t slot) {
  return sbri_vec3(points[slot].x, points[slot].y, points[slot].z);
}

static sbf_vec3 way_of(const sbri_island_tick *t, uint32_t slot) {
  if (slot < t->island->free_count) return sbri_scale(sbri_slot_velocity(t, t->velocities, slot), t->tick_s);
  return sbri_sub(at(t->targets, slot), at(t->positions, slot));
}

static sbri_box swept(const sbri_island_tick *t, uint32_t slot, float by) {
  sbf_vec3 x = at(t->positions, slot);
  return sbri_box_grown(sbri_box_with(sbri_box_of_point(x), sbri_add(x, way_of(t, slot))), by);
}

static void make_boxes(const looking *l, sbri_box *boxes) {
  for (uint32_t f = 0; f < l->body->self_face_count; f++) {
    const uint32_t *c = l->body->self_faces + 3 * (size_t)f;
    boxes[f] = swept(l->tick, c[0], l->rule.outer);
    for (int k = 1; k < 3; k++) boxes[f] = sbri_box_join(boxes[f], swept(l->tick, c[k], l->rule.outer));
  }
}

static void look(const looking *l, uint32_t slot, uint32_t number, sbri_surface_finding *best) {
  const uint32_t *c = l->body->self_faces + 3 * (size_t)number;
  sbri_surface_face face;
  for (int k = 0; k < 3; k++) face.at[k] = at(l->tick->positions, c[k]), face.ways[k] = way_of(l->tick, c[k]);
  sbri_surface_look(&l->rule, at(l->tick->positions, slot), way_of(l->tick, slot), &face, number, best);
}

/* How far off it is at rest from that place; negative behind a surface that encloses matter. */
static float rest_gap(const looking *l, uint32_t slot, const uint32_t *corners) {
  const sbri_point *rest = l->tick->island->rest;
  sbf_vec3 p[3];
  for (int k = 0; k < 3; k++) p[k] = at(rest, corners[k]);
  return sbri_surface_gap(&l->rule, at(rest, slot), p);
}

static float relative_mass(const sbri_island *island, const sbri_sample *s) {
  float sum = 0;
  for (int k = 0; k < 4; k++)
    if (s->slots[k] < island->free_count)
      sum += s->weights[k] * s->weights[k] * island->inverse_masses[s->slots[k]];
  return sum > 0 ? 1 / sum : 0;
}

void sbri_self_touches_add(const sbri_island_tick *t, const sbri_body *body,
    const sbri_contact_tables *tables, sbri_bounds_tree *tree, sbri_box *boxes) {
  const sbf_collision *rule = &body->source->collision;
  looking l = {t, body,
      {rule->outer_thickness + NEAR_SHARE * body->rest_size_m, rule->inner_thickness,
          body->is_sheet || body->rest_volume_m3 == 0}};
  uint32_t *count = &tables->touch_counts[body - t->model->bodies];
  make_boxes(&l, boxes);
  sbri_bounds_tree_make(tree, boxes, body->self_face_count);
  for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++) {
    sbri_bounds_walk walk;
    uint32_t item;
    sbri_surface_finding best = sbri_surface_nothing();
    sbri_box box = swept(t, slot, l.rule.outer);
    sbri_bounds_walk_begin(&walk, tree, box);
    while (sbri_bounds_walk_next(&walk, &item)) {
      const uint32_t *c = body->self_faces + 3 * (size_t)item;
      if (c[0] == slot || c[1] == slot || c[2] == slot || !sbri_box_meets(&box, &boxes[item])) continue;
      look(&l, slot, item, &best);
    }
    if (!sbri_surface_found(&best) || *count >= body->touch_capacity) continue;
    const uint32_t *c = body->self_faces + 3 * (size_t)best.face;
    float rest = rest_gap(&l, slot, c), thickness = rule->outer_thickness;
    if (rest < TOGETHER_M) continue;
    if (REST_SHARE * rest < thickness) thickness = REST_SHARE * rest;
    sbri_sample s = {
        {slot, c[0], c[1], c[2]}, {1, -best.weights[0], -best.weights[1], -best.weights[2]}, 0, UINT32_MAX};
    s.mass_kg = relative_mass(t->island, &s);
    if (!(s.mass_kg > 0)) continue;
    tables->touches[body->first_touch + (*count)++] = (sbri_touch){.sample = s,
        .normal = best.normal,
        .offset = thickness,
        .friction_share = 1,
        .restitution = body->restitution,
        .collider = SBRI_ITSELF};
  }
}
