/* Springs that may tear and that hold a skin's polygons together: after such a spring has torn, the polygon
 * spans the tear. */
#include <math.h>
#include <string.h>

#include "prepare/prepare.h"

/* The points with at least a twentieth of the vertex's weight, as slots of the character, by decreasing
 * weight. None for a vertex that follows something else, or one side of a tear (soft/tear/torn_network.c). */
typedef struct embedding {
  uint32_t slots[4], count;
} embedding;

static embedding embedding_of(const sbri_skin *skin, uint32_t vertex) {
  const float min = 0.05f;
  embedding found = {{0}, 0};
  uint32_t lane = vertex % SBRI_BLOCK;
  float max = 0;
  bool bound = skin->binding_count && skin->binding_of[vertex] != UINT32_MAX;
  if (!skin->cell_begins || bound) return found;
  for (uint32_t c = skin->cell_begins[vertex / SBRI_BLOCK]; c < skin->cell_begins[vertex / SBRI_BLOCK + 1];
       c++) {
    float weight = skin->cells[c].weights[lane];
    if (weight < min || found.count == 4) continue;
    uint32_t at = found.count++;
    found.slots[at] = skin->cells[c].slots[lane];
    if (weight <= max) continue;
    max = weight;
    found.slots[at] = found.slots[0], found.slots[0] = skin->cells[c].slots[lane];
  }
  return found;
}

/* The link of the spring between two slots of the island, if it may tear; UINT32_MAX: none. */
static uint32_t link_between(const sbri_island *island, uint32_t a, uint32_t b) {
  if (a >= island->free_count) {
    uint32_t other = a;
    a = b, b = other;
  }
  if (a >= island->free_count) return UINT32_MAX;
  uint32_t block = a / SBRI_BLOCK, lane = a % SBRI_BLOCK;
  for (uint32_t c = island->cells.begins[block]; c < island->cells.begins[block + 1]; c++) {
    if (island->cells.at[c].others[lane] != b || b == a) continue;
    uint32_t link = island->cells.links[c * SBRI_BLOCK + lane];
    if (island->links.flows[link / SBRI_BLOCK].tear[link % SBRI_BLOCK] > 0) return link;
  }
  return UINT32_MAX;
}

/* The same as an index in a character's strengths. */
static uint32_t strength_between(const sbr_model *model, uint32_t a, uint32_t b) {
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    if (a - island->first_slot >= island->slot_count || b - island->first_slot >= island->slot_count)
      continue;
    if (!island->links.flows || !island->cells.links) return UINT32_MAX;
    uint32_t link = link_between(island, a - island->first_slot, b - island->first_slot);
    return link == UINT32_MAX ? link : island->links.first_flow + link;
  }
  return UINT32_MAX;
}

static uint32_t add(const sbr_model *model, uint32_t *strengths, uint32_t count, uint32_t a, uint32_t b) {
  uint32_t at = a == b ? UINT32_MAX : strength_between(model, a, b);
  if (at != UINT32_MAX) strengths[count++] = at;
  return count;
}

/* Springs between the heaviest points of the two ends of an edge, and between all points of the first end. If
 * vertices are points, these are the springs along the edges; in an embedding network, those that a torn
 * polygon spans. */
bool sbri_torn_sides_make(sbr_model *model, sbri_skin *skin, const sbri_skin *full, const sbf_u32_list *sizes,
    const sbf_u32_list *points) {
  if (model->counts.flows == 0 || sizes->count == 0) return true;
  uint32_t *begins = sbfi_arena_allocate(&model->arena, (size_t)sizes->count + 1, sizeof *begins);
  uint32_t *strengths = sbfi_arena_allocate(&model->arena, 7 * (size_t)points->count + 1, sizeof *strengths);
  if (!begins || !strengths) return false;
  uint32_t count = 0;
  for (uint32_t p = 0, first = 0; p < sizes->count; first += sizes->at[p++]) {
    for (uint32_t i = 0; i < sizes->at[p]; i++) {
      embedding a = embedding_of(full, points->at[first + i]);
      embedding b = embedding_of(full, points->at[first + (i + 1) % sizes->at[p]]);
      if (a.count && b.count) count = add(model, strengths, count, a.slots[0], b.slots[0]);
      for (uint32_t k = 1; k < a.count; k++)
        for (uint32_t l = 0; l < k; l++) count = add(model, strengths, count, a.slots[l], a.slots[k]);
    }
    begins[p + 1] = count;
  }
  if (count) skin->side_begins = begins, skin->side_strengths = strengths;
  return true;
}
