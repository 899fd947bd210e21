/* Hulls of rigid bodies as closed surfaces: what lies through one another looks for its way out by them. */
#include "math/vec3.h"
#include "meet/finding.h"

static bool make(const sbri_rigid_body *body, sbri_meet_surface *s, sbfi_arena *arena) {
  const sbri_hull *hull = &body->hull;
  uint32_t vertices = hull->vertex_count, triangles = 0;
  for (uint32_t i = 0; i < hull->face_count; i++) triangles += hull->faces[i].count - 2;
  s->samples = sbfi_arena_allocate(arena, (size_t)vertices + 1, sizeof *s->samples);
  s->triangles = sbfi_arena_allocate(arena, 3 * (size_t)triangles + 1, sizeof *s->triangles);
  if (!s->samples || !s->triangles || !sbri_meet_surface_room(s, vertices, triangles, arena)) return false;
  for (uint32_t v = 0; v < vertices; v++) {
    s->samples[v] = (sbri_sample){.mass_kg = 1};
    s->places[v] = hull->vertices[v];
    s->ways[v] = sbri_vec3(0, 0, 0);
  }
  s->vertex_count = vertices;
  for (uint32_t i = 0; i < hull->face_count; i++) {
    const uint32_t *c = hull->corners + hull->faces[i].first;
    for (uint32_t k = 2; k < hull->faces[i].count; k++) {
      uint32_t *to = s->triangles + 3 * (size_t)s->triangle_count++;
      to[0] = c[0], to[1] = c[k - 1], to[2] = c[k];
    }
  }
  s->closed = sbri_meet_is_closed(s);
  sbri_meet_surface_measure(s);
  return sbri_meet_rims_make(s, arena);
}

bool sbri_meet_hulls_make(const sbr_model *model, sbri_meet_surface *hulls, sbfi_arena *arena) {
  for (uint32_t b = 0; b < model->rigid.body_count; b++)
    if (model->rigid.bodies[b].hull.face_count && !make(&model->rigid.bodies[b], &hulls[b], arena))
      return false;
  return true;
}

void sbri_meet_hull_place(const sbri_rigid_body *body, const sbr_transform *at, const sbr_transform *end,
    float scale, sbri_meet_surface *s) {
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    sbf_vec3 own = body->hull.vertices[v];
    s->places[v] = sbri_add_scaled(at->position, sbri_rotate(at->rotation, own), scale);
    sbf_vec3 to = sbri_add_scaled(end->position, sbri_rotate(end->rotation, own), scale);
    s->ways[v] = sbri_sub(to, s->places[v]);
  }
  sbri_meet_tree_make(s, 0);
}
