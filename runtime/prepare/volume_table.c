/* The faces that contribute to each slot's entry in the gradient of a body's volume:
 * soft/solvers/volume_preservation.h.
 */
#include <string.h>

#include "prepare/prepare.h"

static bool add_contribution(sbfi_array *contributions, uint32_t slot, uint32_t face, float weight) {
  return sbfi_array_append(contributions, &(sbri_face_weight){slot, face, weight}, 1);
}

/* The points of a vertex get its part of each of its faces: of a quad an eighth of the cross product of its
 * diagonals, a quarter of the area; of a triangle a sixth, a third of the area. */
static bool list_fractions(const sbri_skin *skin, uint32_t first_slot, sbfi_array *contributions) {
  for (uint32_t face = 0; face < skin->face_block_count * SBRI_BLOCK; face++) {
    const sbri_face_block *block = &skin->faces[face / SBRI_BLOCK];
    uint32_t lane = face % SBRI_BLOCK, corners[4];
    for (int k = 0; k < 4; k++) corners[k] = block->corners[k][lane];
    if (corners[0] == corners[1] && corners[1] == corners[2]) continue; /* padding */
    int count = corners[3] == corners[0] ? 3 : 4;
    for (int k = 0; k < count; k++) {
      uint32_t in_block = corners[k] / SBRI_BLOCK, vertex_lane = corners[k] % SBRI_BLOCK;
      for (uint32_t c = skin->cell_begins[in_block]; c < skin->cell_begins[in_block + 1]; c++) {
        float weight = skin->cells[c].weights[vertex_lane] * (count == 3 ? 1.0f / 6 : 0.125f);
        uint32_t slot = skin->cells[c].slots[vertex_lane] - first_slot;
        if (weight != 0 && !add_contribution(contributions, slot, face, weight)) return false;
      }
    }
  }
  return true;
}

static bool fill_table(
    sbr_model *model, sbri_body *body, const sbri_face_weight *face_weights, size_t count, uint32_t *used) {
  uint32_t block_count = (body->slots.end - body->slots.begin) / SBRI_BLOCK, begin = body->slots.begin;
  uint32_t *begins = sbfi_arena_allocate(&model->arena, (size_t)block_count + 1, sizeof *begins);
  if (!begins) return false;
  for (size_t i = 0; i < count; i++)
    if (face_weights[i].slot >= begin && face_weights[i].slot < body->slots.end)
      used[face_weights[i].slot - begin]++;
  for (uint32_t block = 0; block < block_count; block++) {
    uint32_t max = 0;
    for (uint32_t i = block * SBRI_BLOCK; i < (block + 1) * SBRI_BLOCK; i++)
      max = used[i] > max ? used[i] : max;
    begins[block + 1] = begins[block] + max;
  }
  uint32_t cell_count = begins[block_count];
  sbri_volume_cell *cells = sbfi_arena_allocate(&model->arena, cell_count ? cell_count : 1, sizeof *cells);
  if (!cells) return false;
  memset(used, 0, (size_t)block_count * SBRI_BLOCK * sizeof *used);
  for (size_t i = 0; i < count; i++) {
    if (face_weights[i].slot < begin || face_weights[i].slot >= body->slots.end) continue;
    uint32_t slot = face_weights[i].slot - begin, lane = slot % SBRI_BLOCK;
    sbri_volume_cell *cell = &cells[begins[slot / SBRI_BLOCK] + used[slot]++];
    cell->slots[lane] = face_weights[i].face;
    cell->weights[lane] = face_weights[i].weight;
  }
  body->volume.begins = begins;
  body->volume.cells = cells;
  return true;
}

/* The rigid body of all pinned points, or of the whole surface; -1: several, or something else. */
static int32_t find_attachment(const sbri_island *island, const sbri_body *body) {
  int32_t attachment = island->pins.attachment_count == 1 ? (int32_t)island->pins.attachments[0] : -1;
  for (uint32_t i = 0; i < body->volume.pinned_weight_count; i++) {
    int32_t by = island->pins.rigid_bodies[body->volume.pinned_weights[i].slot - island->free_count];
    if (by < 0 || (i > 0 && by != attachment)) return -1;
    attachment = by;
  }
  return attachment;
}

/* Pinned points, which get the reactions. */
static bool list_pinned(
    sbr_model *model, sbri_body *body, const sbri_face_weight *face_weights, size_t count) {
  const sbri_island *island = &model->islands[body->island];
  uint32_t free_count = island->free_count, pinned = 0;
  for (size_t i = 0; i < count; i++) pinned += face_weights[i].slot >= free_count;
  sbri_face_weight *to = sbfi_arena_allocate(&model->arena, (size_t)pinned + 1, sizeof *to);
  if (!to) return false;
  for (size_t i = 0; i < count; i++)
    if (face_weights[i].slot >= free_count) to[body->volume.pinned_weight_count++] = face_weights[i];
  body->volume.pinned_weights = to;
  body->volume.attachment = find_attachment(island, body);
  return true;
}

/* If each vertex is one point, faces may index points: `volume_faces`. */
static bool name_points(sbri_body *body, uint32_t first_slot, sbfi_arena *arena) {
  const sbri_skin *skin = &body->surface.skin;
  for (uint32_t v = 0; v < skin->vertex_count; v++) {
    uint32_t block = v / SBRI_BLOCK, begin = skin->cell_begins[block], end = skin->cell_begins[block + 1];
    for (uint32_t c = begin; c < end; c++)
      if (skin->cells[c].weights[v % SBRI_BLOCK] != (c == begin ? 1.0f : 0.0f)) return true;
    if (begin == end) return true;
  }
  sbri_face_block *faces = sbfi_arena_allocate(arena, skin->face_block_count, sizeof *faces);
  if (!faces) return false;
  for (uint32_t block = 0; block < skin->face_block_count; block++)
    for (int k = 0; k < 4; k++)
      for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
        uint32_t v = skin->faces[block].corners[k][lane];
        faces[block].corners[k][lane] =
            skin->cells[skin->cell_begins[v / SBRI_BLOCK]].slots[v % SBRI_BLOCK] - first_slot;
      }
  body->volume.faces = faces;
  return true;
}

bool sbri_volume_table_make(sbr_model *model, sbri_body *body) {
  uint32_t count = body->slots.end - body->slots.begin;
  if (count == 0) return true;
  sbfi_array contributions;
  sbfi_array_init(&contributions, &model->arena.allocator, sizeof(sbri_face_weight));
  uint32_t *used = sbfi_allocate(&model->arena.allocator, count * sizeof *used);
  bool good =
      used && list_fractions(&body->surface.skin, model->islands[body->island].first_slot, &contributions);
  if (good) {
    memset(used, 0, count * sizeof *used);
    good = fill_table(model, body, contributions.at, contributions.count, used) &&
           list_pinned(model, body, contributions.at, contributions.count);
  }
  sbfi_free(&model->arena.allocator, used, count * sizeof *used);
  sbfi_array_free(&contributions);
  return good && name_points(body, model->islands[body->island].first_slot, &model->arena);
}
