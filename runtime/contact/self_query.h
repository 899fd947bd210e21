/* Input of the self-contact queries of points and edges within a tick. */
#ifndef SBRI_SELF_QUERY_H
#define SBRI_SELF_QUERY_H

#include "contact/contact.h"
#include "shapes/bounds_tree.h"
#include "shapes/surface_query.h"

/* Fraction of the rest distance that parts keep if it is less than the thickness. */
#define SBRI_SELF_REST_FRACTION 0.9f
/* m; parts that are closer at rest count as connected */
#define SBRI_SELF_TOGETHER_M 1e-5f

typedef struct sbri_self_search {
  const sbri_island_tick *tick;
  const sbri_body *body;
  const sbri_contact_tables *tables;
  const sbri_bounds_tree *tree; /* over the swept boxes of the triangles */
  const sbri_box *boxes;
  const sbri_moving_ball *balls; /* of the triangles at the beginning of the tick */
  sbri_surface_rule rule;
} sbri_self_search;

static inline sbf_vec3 sbri_self_position(const sbri_point *points, uint32_t slot) {
  return sbri_vec3(points[slot].x, points[slot].y, points[slot].z);
}

/* Displacement of a point in the tick. */
static inline sbf_vec3 sbri_self_displacement(const sbri_island_tick *t, uint32_t slot) {
  if (slot < t->island->free_count) return sbri_scale(sbri_slot_velocity(t, t->velocities, slot), t->tick_s);
  return sbri_sub(sbri_self_position(t->targets, slot), sbri_self_position(t->positions, slot));
}

static inline sbri_box sbri_self_swept(const sbri_island_tick *t, uint32_t slot, float margin) {
  sbf_vec3 x = sbri_self_position(t->positions, slot);
  return sbri_box_grown(
      sbri_box_with(sbri_box_of_point(x), sbri_add(x, sbri_self_displacement(t, slot))), margin);
}

/* Whether an edge of the surface connects the points. */
static inline bool sbri_self_are_joined(const sbri_body *body, uint32_t a, uint32_t b) {
  for (uint32_t i = body->self.ring_begins[a]; i < body->self.ring_begins[a + 1]; i++)
    if (body->self.ring[i] == b) return true;
  return false;
}

/* Four points with weights, and their effective mass for an impulse; 0: no point is free. */
static inline sbri_sample sbri_self_sample(
    const sbri_island *island, const uint32_t slots[4], const float weights[4]) {
  sbri_sample s = {.vertex = UINT32_MAX};
  float sum = 0;
  for (int k = 0; k < 4; k++) {
    s.slots[k] = slots[k], s.weights[k] = weights[k];
    if (slots[k] < island->free_count) sum += weights[k] * weights[k] * island->inverse_masses[slots[k]];
  }
  s.mass_kg = sum > 0 ? 1 / sum : 0;
  return s;
}

/* Adds a contact, up to the capacity. `rest_m` is the distance at rest; `max_m` is the maximum distance to
 * keep. */
static inline void sbri_self_add(
    const sbri_self_search *l, const sbri_sample *s, sbf_vec3 normal, float rest_m, float max_m, bool edges) {
  const sbri_body *body = l->body;
  uint32_t *count = &l->tables->contact_counts[body - l->tick->model->bodies];
  float thickness = max_m;
  if (*count >= body->contact.max_count || rest_m < SBRI_SELF_TOGETHER_M || !(s->mass_kg > 0)) return;
  if (SBRI_SELF_REST_FRACTION * rest_m < thickness) thickness = SBRI_SELF_REST_FRACTION * rest_m;
  l->tables->contacts[body->contact.first + (*count)++] = (sbri_soft_contact){.sample = *s,
      .normal = normal,
      .offset = thickness,
      .friction_scale = 1,
      .restitution = body->contact.restitution,
      .collider = SBRI_ITSELF,
      .edges = edges};
}

/* ---- self_edges.c ---- */

/* Contacts of crossing edges: rims of a sheet, and edges along which it is bent at present. */
void sbri_self_edges_add(const sbri_self_search *query);

/* ---- self_cross.c ---- */

/* Contacts that move edges out of the triangles that they cross. */
void sbri_self_crossings_add(const sbri_self_search *query);

#endif
