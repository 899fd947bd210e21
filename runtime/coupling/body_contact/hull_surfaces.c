/* Hulls of rigid bodies as closed surfaces, for the search of exits. */
#include "coupling/body_contact/narrow_phase.h"
#include "math/vec3.h"

static bool create(const sbri_rigid_body *body, sbri_contact_surface *s, sbfi_arena *arena) {
  const sbri_hull *hull = &body->hull;
  uint32_t vertices = hull->vertex_count, triangles = 0;
  for (uint32_t i = 0; i < hull->face_count; i++) triangles += hull->faces[i].count - 2;
  s->samples = sbfi_arena_allocate(arena, (size_t)vertices + 1, sizeof *s->samples);
  s->triangles = sbfi_arena_allocate(arena, 3 * (size_t)triangles + 1, sizeof *s->triangles);
  if (!s->samples || !s->triangles || !sbri_contact_surface_allocate(s, vertices, triangles, arena))
    return false;
  for (uint32_t v = 0; v < vertices; v++) {
    s->samples[v] = (sbri_sample){.mass_kg = 1};
    s->positions[v] = hull->vertices[v];
    s->displacements[v] = sbri_vec3(0, 0, 0);
  }
  s->vertex_count = vertices;
  for (uint32_t i = 0; i < hull->face_count; i++) {
    const uint32_t *c = hull->corners + hull->faces[i].first;
    for (uint32_t k = 2; k < hull->faces[i].count; k++) {
      uint32_t *to = s->triangles + 3 * (size_t)s->triangle_count++;
      to[0] = c[0], to[1] = c[k - 1], to[2] = c[k];
    }
  }
  s->closed = sbri_contact_surface_is_closed(s);
  sbri_contact_surface_measure(s);
  if (!sbri_surface_edges_create(s, arena)) return false;
  sbri_contact_surface_build_tree(s);
  return true;
}

bool sbri_contact_hulls_create(const sbr_model *model, sbri_contact_surface *hulls, sbfi_arena *arena) {
  for (uint32_t b = 0; b < model->rigid.body_count; b++)
    if (model->rigid.bodies[b].hull.face_count && !create(&model->rigid.bodies[b], &hulls[b], arena))
      return false;
  return true;
}

void sbri_contact_hull_update(const sbri_rigid_body *body, const sbr_transform *at, const sbr_transform *end,
    float scale, sbri_contact_surface *s) {
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    sbf_vec3 local = body->hull.vertices[v];
    s->positions[v] = sbri_add_scaled(at->position, sbri_rotate(at->rotation, local), scale);
    sbf_vec3 to = sbri_add_scaled(end->position, sbri_rotate(end->rotation, local), scale);
    s->displacements[v] = sbri_sub(to, s->positions[v]);
  }
  sbri_contact_surface_refit_tree(s, 0);
}
