/* Sides of a skin's polygons along springs that may tear: where such a spring has torn, the polygon spans the
 * tear. */
#include <math.h>
#include <string.h>

#include "model/runtime_model.h"

/* The one point that carries the vertex, as a slot of the character; UINT32_MAX: several do, or none. */
static uint32_t carrier_of(const sbri_skin *skin, uint32_t vertex) {
  uint32_t found = UINT32_MAX, lane = vertex % SBRI_BLOCK;
  if (!skin->cell_begins) return found;
  for (uint32_t c = skin->cell_begins[vertex / SBRI_BLOCK]; c < skin->cell_begins[vertex / SBRI_BLOCK + 1];
       c++) {
    if (skin->cells[c].weights[lane] == 0) continue;
    if (found != UINT32_MAX) return UINT32_MAX;
    found = skin->cells[c].slots[lane];
  }
  return found;
}

/* The link of the island's spring between two of its slots, if that may tear; UINT32_MAX: none. */
static uint32_t link_between(const sbri_island *island, uint32_t a, uint32_t b) {
  if (a >= island->free_count) {
    uint32_t other = a;
    a = b, b = other;
  }
  if (a >= island->free_count) return UINT32_MAX;
  uint32_t block = a / SBRI_BLOCK, lane = a % SBRI_BLOCK;
  for (uint32_t c = island->cell_begins[block]; c < island->cell_begins[block + 1]; c++) {
    if (island->cells[c].others[lane] != b || b == a) continue;
    uint32_t link = island->cell_links[c * SBRI_BLOCK + lane];
    if (island->link_flows[link / SBRI_BLOCK].tear[link % SBRI_BLOCK] > 0) return link;
  }
  return UINT32_MAX;
}

/* The same in a character's strengths. */
static uint32_t strength_between(const sbr_model *model, uint32_t a, uint32_t b) {
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    if (a - island->first_slot >= island->slot_count || b - island->first_slot >= island->slot_count)
      continue;
    if (!island->link_flows || !island->cell_links) return UINT32_MAX;
    uint32_t link = link_between(island, a - island->first_slot, b - island->first_slot);
    return link == UINT32_MAX ? link : island->first_flow + link;
  }
  return UINT32_MAX;
}

bool sbri_torn_sides_make(sbr_model *model, sbri_skin *skin, const sbri_skin *full, const sbf_u32_list *sizes,
    const sbf_u32_list *points) {
  if (model->flow_count == 0 || sizes->count == 0) return true;
  uint32_t *begins = sbfi_arena_allocate(&model->arena, (size_t)sizes->count + 1, sizeof *begins);
  uint32_t *strengths = sbfi_arena_allocate(&model->arena, (size_t)points->count + 1, sizeof *strengths);
  if (!begins || !strengths) return false;
  uint32_t count = 0;
  for (uint32_t p = 0, first = 0; p < sizes->count; first += sizes->at[p++]) {
    for (uint32_t i = 0; i < sizes->at[p]; i++) {
      uint32_t a = carrier_of(full, points->at[first + i]);
      uint32_t b = carrier_of(full, points->at[first + (i + 1) % sizes->at[p]]);
      uint32_t at = a == UINT32_MAX || b == UINT32_MAX ? UINT32_MAX : strength_between(model, a, b);
      if (at != UINT32_MAX) strengths[count++] = at;
    }
    begins[p + 1] = count;
  }
  if (count) skin->side_begins = begins, skin->side_strengths = strengths;
  return true;
}
