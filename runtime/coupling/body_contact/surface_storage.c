/* Contact surfaces of soft bodies and hulls: memory, rest positions, bounds tree and measures. */
#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"

sbf_vec3 sbri_sample_rest_position(const sbr_model *model, uint32_t body, const sbri_sample *s) {
  const sbri_point *rest = model->islands[model->bodies[body].island].rest;
  sbf_vec3 x = {0, 0, 0};
  for (int k = 0; k < 4; k++)
    x = sbri_add_scaled(
        x, sbri_vec3(rest[s->slots[k]].x, rest[s->slots[k]].y, rest[s->slots[k]].z), s->weights[k]);
  return x;
}

bool sbri_contact_surface_allocate_tree(sbri_contact_surface *s, uint32_t triangles, sbfi_arena *arena) {
  s->tree.items = sbfi_arena_allocate(arena, (size_t)triangles + 1, sizeof *s->tree.items);
  s->tree.nodes = sbfi_arena_allocate(arena, sbri_bounds_tree_nodes(triangles), sizeof *s->tree.nodes);
  return s->tree.items && s->tree.nodes;
}

bool sbri_contact_surface_allocate(
    sbri_contact_surface *s, uint32_t vertices, uint32_t triangles, sbfi_arena *arena) {
  s->positions = sbfi_arena_allocate(arena, (size_t)vertices + 1, sizeof *s->positions);
  s->displacements = sbfi_arena_allocate(arena, (size_t)vertices + 1, sizeof *s->displacements);
  s->inside_parents = sbfi_arena_allocate(arena, (size_t)vertices + 1, sizeof *s->inside_parents);
  s->boxes = sbfi_arena_allocate(arena, (size_t)triangles + 1, sizeof *s->boxes);
  return s->positions && s->displacements && s->inside_parents && s->boxes &&
         sbri_contact_surface_allocate_tree(s, triangles, arena);
}

static void update_boxes(sbri_contact_surface *s, float reach) {
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    const uint32_t *corners = s->triangles + 3 * (size_t)t;
    sbri_box box = sbri_box_of_point(s->positions[corners[0]]);
    for (int k = 0; k < 3; k++) {
      box = sbri_box_with(box, s->positions[corners[k]]);
      box = sbri_box_with(box, sbri_add(s->positions[corners[k]], s->displacements[corners[k]]));
    }
    s->boxes[t] = sbri_box_grown(box, reach);
  }
}

void sbri_contact_surface_build_tree(sbri_contact_surface *s) {
  update_boxes(s, 0);
  sbri_bounds_tree_make(&s->tree, s->boxes, s->triangle_count);
}

void sbri_contact_surface_refit_tree(sbri_contact_surface *s, float reach) {
  update_boxes(s, reach);
  sbri_bounds_tree_refit(&s->tree, s->boxes);
}

void sbri_contact_surface_measure(sbri_contact_surface *s) {
  double length = 0, area = 0, volume = 0;
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    const uint32_t *c = s->triangles + 3 * (size_t)t;
    sbf_vec3 p[3] = {s->positions[c[0]], s->positions[c[1]], s->positions[c[2]]};
    sbf_vec3 normal = sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]));
    for (int k = 0; k < 3; k++) length += (double)sbri_length(sbri_sub(p[(k + 1) % 3], p[k]));
    area += 0.5 * (double)sbri_length(normal);
    volume += (double)sbri_dot(sbri_sub(p[0], s->positions[0]), normal) / 6;
  }
  s->mean_edge_m = s->triangle_count ? (float)(length / (3.0 * s->triangle_count)) : 0;
  s->thickness_m = area > 0 ? (float)(4 * volume / area) : 0;
}
