/* Which soft bodies of a character touch or overlap at rest. Sections of one skin do: at a joint they overlap
 * as the bones turn, and pushing them apart would tear the skin. Other touching bodies are not given common
 * exits, which would bend them. */
#include "coupling/body_contact/overlap_clusters.h"
#include "math/vec3.h"

/* Fractions of the smaller body's size: distance that counts as touching; search depth inside. */
static const float TOUCHING_FRACTION = 0.01f, INSIDE_FRACTION = 0.1f;

/* Sets a surface and its tree to the rest shape. */
static void set_rest_positions(const sbr_model *model, uint32_t body, sbri_contact_surface *s, float reach) {
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    s->positions[v] = sbri_sample_rest_position(model, body, &s->samples[v]);
    s->displacements[v] = sbri_vec3(0, 0, 0);
  }
  sbri_contact_surface_refit_tree(s, reach);
}

/* Whether a vertex of the one touches, or is inside of, the other at rest. */
static bool overlap(const sbr_model *model, uint32_t one, const sbri_contact_surface *surfaces,
    uint32_t other, const sbri_surface_rule *rule) {
  const sbri_contact_surface *a = &surfaces[one], *b = &surfaces[other];
  for (uint32_t v = 0; v < a->vertex_count; v++) {
    sbf_vec3 x = sbri_sample_rest_position(model, one, &a->samples[v]), no_displacement = {0, 0, 0};
    sbri_surface_hit best = sbri_surface_nothing();
    sbri_bounds_walk walk;
    uint32_t triangle;
    sbri_box box = sbri_box_of_point(x);
    if (a->samples[v].weights[0] == 0) continue; /* follows frames, not points */
    sbri_bounds_walk_begin(&walk, &b->tree, box);
    while (sbri_bounds_walk_next(&walk, &triangle)) {
      const uint32_t *c = b->triangles + 3 * (size_t)triangle;
      sbri_surface_face face = {{b->positions[c[0]], b->positions[c[1]], b->positions[c[2]]},
          {no_displacement, no_displacement, no_displacement}};
      if (sbri_boxes_overlap(&box, &b->boxes[triangle]))
        sbri_surface_query(rule, x, no_displacement, &face, triangle, &best);
    }
    if (sbri_surface_found(&best) || (b->closed && sbri_surface_contains(b, x))) return true;
  }
  return a->closed && b->closed && sbri_edges_intersect(a, b);
}

static bool is_section(const sbr_model *model, uint32_t body) {
  return model->bodies[body].source->bone >= 0;
}

static void find_soft_relations(
    const sbr_model *model, const sbri_contact_surface *surfaces, uint8_t *relations) {
  uint32_t count = model->asset->soft_bodies.count;
  for (uint32_t b = 0; b < count; b++) {
    float size = model->bodies[b].rest_size_m;
    if (!surfaces[b].triangle_count) continue;
    for (uint32_t a = 0; a < count; a++) {
      if (a == b || !model->bodies[a].level || relations[(size_t)a * count + b]) continue;
      float min_size = size < model->bodies[a].rest_size_m ? size : model->bodies[a].rest_size_m;
      sbri_surface_rule rule = {
          TOUCHING_FRACTION * min_size, INSIDE_FRACTION * min_size, surfaces[b].two_sided};
      uint8_t relation =
          is_section(model, a) && is_section(model, b) ? SBRI_REST_ADJACENT : SBRI_REST_TOUCHING;
      if (overlap(model, a, surfaces, b, &rule))
        relations[(size_t)a * count + b] = relations[(size_t)b * count + a] = relation;
    }
  }
}

/* Whether the hull at its rest frame and the soft body touch. */
static bool hull_overlaps(const sbri_rigid_body *body, const sbri_contact_surface *hull,
    const sbri_contact_surface *soft, float distance) {
  sbr_transform frame = {body->center, body->axes};
  sbri_box grown = sbri_box_grown(hull->tree.nodes[0].box, distance);
  uint32_t face;
  if (!sbri_boxes_overlap(&grown, &soft->tree.nodes[0].box)) return false;
  for (uint32_t v = 0; v < hull->vertex_count; v++)
    if (sbri_surface_contains(soft, hull->positions[v])) return true;
  for (uint32_t v = 0; v < soft->vertex_count; v++)
    if (sbri_hull_depth(&body->hull, sbri_to_local(&frame, soft->positions[v], 1), &face) <= distance)
      return true;
  return sbri_edges_intersect(soft, hull);
}

static void find_hull_relations(const sbr_model *model, const sbri_contact_surface *surfaces,
    sbri_contact_surface *hulls, uint8_t *with_hulls) {
  for (uint32_t r = 0; r < model->rigid.body_count; r++) {
    const sbri_rigid_body *body = &model->rigid.bodies[r];
    if (!hulls[r].triangle_count) continue;
    const sbr_transform frame = {body->center, body->axes};
    sbri_contact_hull_update(body, &frame, &frame, 1, &hulls[r]);
    for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++)
      if (surfaces[b].closed &&
          hull_overlaps(body, &hulls[r], &surfaces[b], TOUCHING_FRACTION * model->bodies[b].rest_size_m))
        with_hulls[(size_t)b * model->rigid.body_count + r] = SBRI_REST_TOUCHING;
  }
}

void sbri_rest_overlaps_find(
    const sbr_model *model, sbri_contact_surface *surfaces, sbri_contact_surface *hulls, uint8_t *relations) {
  size_t count = model->asset->soft_bodies.count;
  for (uint32_t b = 0; b < count; b++)
    if (model->bodies[b].level)
      set_rest_positions(model, b, &surfaces[b], INSIDE_FRACTION * model->bodies[b].rest_size_m);
  find_soft_relations(model, surfaces, relations);
  find_hull_relations(model, surfaces, hulls, relations + count * count);
}
