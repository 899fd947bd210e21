/* Triangles for self-contact: those of the surface, if its vertices are points of the level; and its
 * connected components. */
#include <string.h>

#include "prepare/prepare.h"
#include "shapes/sides.h"

/* Slot of each vertex; false where some vertex is no point of the level. */
static bool find_slots(const sbri_island *island, const sbri_body *body, uint32_t *slots) {
  if (body->contact.samples || body->surface.skin.frame_vertex_count || !body->surface.skin.vertex_count)
    return false;
  for (uint32_t v = 0; v < body->surface.skin.vertex_count; v++) {
    sbri_sample s = sbri_sample_of(island, &body->surface.skin, v);
    if (s.weights[0] != 1) return false;
    slots[v] = s.slots[0];
  }
  return true;
}

/* Neighbours of each slot by edges: first counts, then positions of the next one. */
static bool make_rings(sbr_model *model, sbri_body *body, const uint32_t *sides) {
  uint32_t slots = model->islands[body->island].slot_count, count = 3 * body->self.face_count;
  uint32_t *begins = sbfi_arena_allocate(&model->arena, (size_t)slots + 2, sizeof *begins);
  uint32_t *ring = sbfi_arena_allocate(&model->arena, 2 * (size_t)count + 1, sizeof *ring);
  if (!begins || !ring) return false;
  const uint32_t *corners = body->self.faces;
  memset(begins, 0, (slots + 2) * sizeof *begins);
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t i = 0; i < count; i++) {
      if (sides[i] == SBRI_SAME_SIDE) continue;
      uint32_t ends[2] = {corners[i], corners[i / 3 * 3 + (i + 1) % 3]};
      for (int k = 0; k < 2; k++) {
        if (pass)
          ring[begins[ends[k] + 1]++] = ends[1 - k];
        else
          begins[ends[k] + 2]++;
      }
    }
    for (uint32_t i = 2; i < slots + 2 && !pass; i++) begins[i] += begins[i - 1];
  }
  body->self.ring_begins = begins, body->self.ring = ring;
  return true;
}

static bool make_sides(sbr_model *model, sbri_body *body) {
  uint32_t count = body->self.face_count;
  uint32_t *sides = sbfi_arena_allocate(&model->arena, 3 * (size_t)count + 1, sizeof *sides);
  uint32_t *table = sbfi_arena_allocate(&model->arena, sbri_sides_table(count), sizeof *table);
  if (!sides || !table) return false;
  sbri_sides_find(body->self.faces, count, sides, table);
  body->self.sides = sides;
  return make_rings(model, body, sides);
}

bool sbri_self_faces_make(sbr_model *model, sbri_body *body) {
  if (!body->level || !body->source->collision.self) return true;
  const sbf_polygon_mesh *mesh = &body->source->surface;
  size_t max = mesh->polygon_points.count;
  uint32_t *slots =
      sbfi_arena_allocate(&model->arena, (size_t)body->surface.skin.vertex_count + 1, sizeof *slots);
  uint32_t *faces = sbfi_arena_allocate(&model->arena, 3 * max + 1, sizeof *faces);
  if (!slots || !faces) return false;
  if (!find_slots(&model->islands[body->island], body, slots)) return true;
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++, body->self.face_count++) {
      uint32_t *to = faces + 3 * (size_t)body->self.face_count;
      to[0] = slots[corners[0]], to[1] = slots[corners[k - 1]], to[2] = slots[corners[k]];
    }
  body->self.faces = faces;
  sbf_body_measures measures;
  sbf_body_measure(body->source, &measures);
  body->self.is_sheet = measures.sheet;
  return make_sides(model, body) && sbri_self_tangles_find(model, body);
}
