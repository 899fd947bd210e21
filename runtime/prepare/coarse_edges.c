/* Surface edges that are long enough to penetrate a host shape between their ends: across a right-angled edge
 * the depth is half of the length. */
#include "math/vec3.h"
#include "prepare/prepare.h"

/* Minimum length as a multiple of a sheet's margin: the diagonal of its square on both sides. And as a
 * fraction of a body's thickness, of which a quarter may penetrate unnoticed. */
static const float OF_MARGIN = 2.8f, OF_THICKNESS = 0.5f;
#define NOT_THERE UINT32_MAX

/* That of a square bar with the same surface and volume. */
static float thickness_of(const sbri_body *body) {
  sbf_body_measures measures;
  sbf_body_measure(body->source, &measures);
  return measures.sheet || !(measures.area > 0) ? 0 : (float)(4 * measures.volume / measures.area);
}

/* Sample or slot of each vertex; false if it has neither. */
static bool find_ends(const sbri_island *island, const sbri_body *body, uint32_t *ends) {
  for (uint32_t v = 0; v < body->surface.skin.vertex_count; v++) ends[v] = NOT_THERE;
  for (uint32_t i = 0; i < body->contact.sample_count; i++)
    if (body->contact.samples[i].vertex != UINT32_MAX) ends[body->contact.samples[i].vertex] = i;
  for (uint32_t v = 0; !body->contact.samples && v < body->surface.skin.vertex_count; v++) {
    sbri_sample s = sbri_sample_of(island, &body->surface.skin, v);
    if (s.weights[0] != 1) return false;
    ends[v] = s.slots[0];
  }
  return true;
}

/* Lists the other end of each edge at its lower one: first counts, then positions of the next one. */
static uint32_t list_edges(const sbf_polygon_mesh *mesh, float min, uint32_t *begins, uint32_t *other_ends) {
  uint32_t vertices = mesh->positions.count, count = 0;
  for (int pass = 0; pass < 2; pass++) {
    const uint32_t *c = mesh->polygon_points.at;
    for (uint32_t p = 0; p < mesh->polygon_sizes.count; c += mesh->polygon_sizes.at[p++])
      for (uint32_t k = 0; k < mesh->polygon_sizes.at[p]; k++) {
        uint32_t a = c[k], b = c[(k + 1) % mesh->polygon_sizes.at[p]], low = a < b ? a : b;
        if (!(sbri_length(sbri_sub(mesh->positions.at[b], mesh->positions.at[a])) > min)) continue;
        if (pass)
          other_ends[begins[low + 1]++] = a + b - low;
        else
          begins[low + 2]++, count++;
      }
    for (uint32_t i = 2; i < vertices + 2 && !pass; i++) begins[i] += begins[i - 1];
  }
  return count;
}

static bool make(sbr_model *model, sbri_body *body, sbfi_arena *scratch) {
  const sbf_polygon_mesh *mesh = &body->source->surface;
  uint32_t vertices = mesh->positions.count;
  float min = fmaxf(OF_MARGIN * body->contact.margin_m, OF_THICKNESS * thickness_of(body));
  uint32_t *ends = sbfi_arena_allocate(scratch, (size_t)body->surface.skin.vertex_count + 1, sizeof *ends);
  uint32_t *begins = sbfi_arena_allocate(scratch, (size_t)vertices + 3, sizeof *begins);
  uint32_t *other_ends =
      sbfi_arena_allocate(scratch, (size_t)mesh->polygon_points.count + 1, sizeof *other_ends);
  if (!ends || !begins || !other_ends) return false;
  if (!find_ends(&model->islands[body->island], body, ends)) return true;
  for (uint32_t i = 0; i < vertices + 3; i++) begins[i] = 0;
  uint32_t max = list_edges(mesh, min, begins, other_ends), count = 0;
  if (!max) return true;
  uint32_t *edges = sbfi_arena_allocate(&model->arena, 2 * (size_t)max, sizeof *edges);
  if (!edges) return false;
  for (uint32_t v = 0; v < vertices; v++)
    for (uint32_t i = begins[v]; i < begins[v + 1]; i++) {
      uint32_t k = begins[v];
      while (other_ends[k] != other_ends[i]) k++;
      if (k < i || ends[v] == NOT_THERE || ends[other_ends[i]] == NOT_THERE) continue;
      edges[2 * count] = ends[v], edges[2 * count + 1] = ends[other_ends[i]], count++;
    }
  body->contact.coarse_edges = edges, body->contact.coarse_edge_count = count;
  return true;
}

bool sbri_coarse_edges_make(sbr_model *model, sbri_body *body) {
  if (!body->level || body->surface.skin.frame_vertex_count || !body->surface.skin.vertex_count ||
      body->surface.skin.vertex_count != body->source->surface.positions.count)
    return true;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = make(model, body, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
