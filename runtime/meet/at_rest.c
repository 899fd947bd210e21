/* Which soft bodies of a character touch, or lie in each other, at rest. Sections that do hang together: at a
 * joint flesh goes into flesh as far as the bones turn, and what would push that apart would tear the joint's
 * skin. Others that do are not let out of each other as a whole, which would bend them out of their shape. */
#include "math/vec3.h"
#include "meet/inside.h"

/* Of the smaller one's size: nearer than the one it touches, and what is inside is looked for so deep. */
static const float TOUCHES_SHARE = 0.01f, INSIDE_SHARE = 0.1f;

/* Its vertices and the tree over its triangles, at rest. */
static void place(const sbr_model *model, uint32_t body, sbri_meet_surface *s, float reach) {
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    s->places[v] = sbri_meet_rest(model, body, &s->samples[v]);
    s->ways[v] = sbri_vec3(0, 0, 0);
  }
  sbri_meet_tree_make(s, reach);
}

/* Whether a vertex of the one touches the other, which is placed, or lies in it. */
static bool touches(const sbr_model *model, uint32_t one, const sbri_meet_surface *surfaces, uint32_t other,
    const sbri_surface_rule *rule) {
  const sbri_meet_surface *a = &surfaces[one], *b = &surfaces[other];
  for (uint32_t v = 0; v < a->vertex_count; v++) {
    sbf_vec3 x = sbri_meet_rest(model, one, &a->samples[v]), still = {0, 0, 0};
    sbri_surface_finding best = sbri_surface_nothing();
    sbri_bounds_walk walk;
    uint32_t triangle;
    sbri_box box = sbri_box_of_point(x);
    if (a->samples[v].weights[0] == 0) continue; /* it follows frames, not points */
    sbri_bounds_walk_begin(&walk, &b->tree, box);
    while (sbri_bounds_walk_next(&walk, &triangle)) {
      const uint32_t *c = b->triangles + 3 * (size_t)triangle;
      sbri_surface_face face = {{b->places[c[0]], b->places[c[1]], b->places[c[2]]}, {still, still, still}};
      if (sbri_box_meets(&box, &b->boxes[triangle]))
        sbri_surface_look(rule, x, still, &face, triangle, &best);
    }
    if (sbri_surface_found(&best) || (b->closed && sbri_meet_is_inside(b, x))) return true;
  }
  return a->closed && b->closed && sbri_edges_go_through(a, b);
}

static bool is_section(const sbr_model *model, uint32_t body) {
  return model->bodies[body].source->bone >= 0;
}

static void note_softs(const sbr_model *model, const sbri_meet_surface *surfaces, uint8_t *together) {
  uint32_t count = model->asset->soft_bodies.count;
  for (uint32_t b = 0; b < count; b++) {
    float size = model->bodies[b].rest_size_m;
    if (!surfaces[b].triangle_count) continue;
    for (uint32_t a = 0; a < count; a++) {
      if (a == b || !model->bodies[a].level || together[(size_t)a * count + b]) continue;
      float least = size < model->bodies[a].rest_size_m ? size : model->bodies[a].rest_size_m;
      sbri_surface_rule rule = {TOUCHES_SHARE * least, INSIDE_SHARE * least, surfaces[b].two_sided};
      uint8_t as = is_section(model, a) && is_section(model, b) ? SBRI_HANG_TOGETHER : SBRI_TOUCH_AT_REST;
      if (touches(model, a, surfaces, b, &rule))
        together[(size_t)a * count + b] = together[(size_t)b * count + a] = as;
    }
  }
}

/* Whether the hull, which is placed, and the soft body touch. */
static bool hull_touches(
    const sbri_rigid_body *body, const sbri_meet_surface *hull, const sbri_meet_surface *soft, float near) {
  sbr_transform at = {body->center, body->axes};
  sbri_box grown = sbri_box_grown(hull->tree.nodes[0].box, near);
  uint32_t face;
  if (!sbri_box_meets(&grown, &soft->tree.nodes[0].box)) return false;
  for (uint32_t v = 0; v < hull->vertex_count; v++)
    if (sbri_meet_is_inside(soft, hull->places[v])) return true;
  for (uint32_t v = 0; v < soft->vertex_count; v++)
    if (sbri_hull_depth(&body->hull, sbri_into_frame(&at, soft->places[v], 1), &face) <= near) return true;
  return sbri_edges_go_through(soft, hull);
}

static void note_hulls(const sbr_model *model, const sbri_meet_surface *surfaces, sbri_meet_surface *hulls,
    uint8_t *with_hulls) {
  for (uint32_t r = 0; r < model->rigid.body_count; r++) {
    const sbri_rigid_body *body = &model->rigid.bodies[r];
    if (!hulls[r].triangle_count) continue;
    const sbr_transform at = {body->center, body->axes};
    sbri_meet_hull_place(body, &at, &at, 1, &hulls[r]);
    for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++)
      if (surfaces[b].closed &&
          hull_touches(body, &hulls[r], &surfaces[b], TOUCHES_SHARE * model->bodies[b].rest_size_m))
        with_hulls[(size_t)b * model->rigid.body_count + r] = SBRI_TOUCH_AT_REST;
  }
}

void sbri_meet_rest_look(
    const sbr_model *model, sbri_meet_surface *surfaces, sbri_meet_surface *hulls, uint8_t *together) {
  size_t count = model->asset->soft_bodies.count;
  for (uint32_t b = 0; b < count; b++)
    if (model->bodies[b].level) place(model, b, &surfaces[b], INSIDE_SHARE * model->bodies[b].rest_size_m);
  note_softs(model, surfaces, together);
  note_hulls(model, surfaces, hulls, together + count * count);
}
