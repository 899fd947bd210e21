/* Splits points of lattices where tetrahedra have torn.
 *
 * The intact tetrahedra around a point of a torn one are grouped by shared faces. If there are several
 * groups, the largest keeps the point. Each other group gets a spare point of the body at the same position
 * and velocity, with mass in proportion to the volume of its tetrahedra: momentum and energy are conserved.
 * Torn tetrahedra keep their mass. Pinned points do not split because they would not separate. */
#include <string.h>

#include "soft/tear/spare_slot.h"
#include "soft/tear/split_springs.h"
#include "soft/tear/tear.h"

/* Maximum number of tetrahedra around a point that are considered. */
enum { MAX_AROUND = 192 };

static void unsplit_springs(sbri_character *c, const sbri_island *island) {
  uint32_t blocks = island->free_count / SBRI_BLOCK, cells = island->cells.begins[blocks];
  size_t first = island->cells.first_state_cell, lanes = (size_t)cells * SBRI_BLOCK;
  memcpy(
      sbri_thread_ends(c) + island->cells.first_state_block, island->cells.ends, blocks * sizeof(uint32_t));
  memcpy(sbri_thread_cells(c) + first, island->cells.at, cells * sizeof *island->cells.at);
  memcpy(sbri_thread_links(c) + first * SBRI_BLOCK, island->cells.links, lanes * sizeof(uint32_t));
  if (island->cells.damping)
    memcpy(sbri_thread_damping(c) + first * SBRI_BLOCK, island->cells.damping, lanes * sizeof(float));
  if (island->cells.slack)
    memcpy(sbri_thread_slack(c) + first * SBRI_BLOCK, island->cells.slack, lanes * sizeof(float));
  memcpy(sbri_thread_blocks(c) + island->links.first_state_block, island->links.blocks,
      island->links.block_count * sizeof *island->links.blocks);
}

void sbri_reset_splits(sbri_character *c) {
  const sbr_model *model = c->model;
  for (uint32_t i = 0; model->splits && i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    sbri_island_states(c)[i].unsplit = 0;
    if (island->springs.tear) unsplit_springs(c, island);
    for (uint32_t slot = 0; slot < island->slot_count; slot++) {
      uint32_t at = island->first_slot + slot;
      bool free = slot < island->free_count;
      sbri_origins(c)[at] = slot;
      sbri_masses(c)[at] = free ? island->masses[slot] : 0;
      sbri_inverse_masses(c)[at] = free ? island->inverse_masses[slot] : 0;
      sbri_gravity_scales(c)[at] = free ? island->gravity_scales[slot] : 0;
    }
    for (uint32_t b = 0; b < island->body_count; b++) {
      const sbri_body *body = &model->bodies[island->bodies[b]];
      for (uint32_t slot = body->slots.first_spare; slot < body->slots.real_end; slot++)
        sbri_origins(c)[island->first_slot + slot] = SBRI_UNUSED;
    }
  }
}

/* ---- Around a point ---- */

typedef struct splitting {
  sbri_character *c;
  const sbri_island *island;
  const uint32_t *torn;
  sbri_tetrahedron_block *blocks;
  uint32_t elements[MAX_AROUND], corners[MAX_AROUND], parts[MAX_AROUND], count, part_count;
} splitting;

static uint32_t *corner(const splitting *s, uint32_t element, uint32_t k, int copy) {
  uint32_t at = s->island->tetrahedra.lanes[2 * element + (uint32_t)copy];
  return &s->blocks[at / SBRI_BLOCK].corners[k][at % SBRI_BLOCK];
}

/* Lists the intact tetrahedra with the slot as a corner. */
static void find_tetrahedra_around(splitting *s, uint32_t slot) {
  const sbri_tear_table *table = s->island->tetrahedra.tears;
  uint32_t origin = sbri_origins(s->c)[s->island->first_slot + slot];
  s->count = 0;
  for (uint32_t i = table->around_begins[origin]; i < table->around_begins[origin + 1]; i++)
    for (uint32_t k = 0; k < 4 && s->count < MAX_AROUND; k++) {
      uint32_t element = table->around[i];
      if (s->torn[element] || *corner(s, element, k, 0) != slot) continue;
      s->elements[s->count] = element, s->corners[s->count] = k, s->parts[s->count++] = SBRI_UNUSED;
    }
}

static void flood(splitting *s, uint32_t from) {
  uint32_t queue[MAX_AROUND], end = 1;
  queue[0] = from, s->parts[from] = s->part_count;
  for (uint32_t next = 0; next < end; next++)
    for (uint32_t k = 0; k < 4; k++) { /* faces with the point */
      if (k == s->corners[queue[next]]) continue;
      uint32_t other = s->island->tetrahedra.tears->neighbours[s->elements[queue[next]]][k], i = 0;
      while (i < s->count && s->elements[i] != other) i++;
      if (i == s->count || s->parts[i] != SBRI_UNUSED) continue;
      s->parts[i] = s->part_count;
      queue[end++] = i;
    }
  s->part_count++;
}

/* ---- Splitting ---- */

static float volume_of(const splitting *s, uint32_t part) {
  float sum = 0;
  for (uint32_t i = 0; i < s->count; i++)
    if (s->parts[i] == part) sum += s->island->tetrahedra.tears->volumes_m3[s->elements[i]];
  return sum;
}

/* Returns the number of groups that could not be split off. */
static uint32_t split(splitting *s, uint32_t slot) {
  find_tetrahedra_around(s, slot);
  s->part_count = 0;
  for (uint32_t i = 0; i < s->count; i++)
    if (s->parts[i] == SBRI_UNUSED) flood(s, i);
  if (s->part_count < 2) return 0;
  uint32_t largest = 0;
  float all = 0, mass = sbri_masses(s->c)[s->island->first_slot + slot], left = mass;
  for (uint32_t part = 0; part < s->part_count; part++) {
    float volume = volume_of(s, part);
    all += volume;
    if (volume > volume_of(s, largest)) largest = part;
  }
  for (uint32_t part = 0; part < s->part_count; part++) {
    if (part == largest) continue;
    uint32_t capacity = sbri_find_spare_slot(s->c, s->island, slot);
    if (capacity == SBRI_UNUSED) return s->part_count - 1 - part;
    float fraction = mass * (volume_of(s, part) / all);
    sbri_split_copy(s->c, s->island, slot, capacity);
    sbri_split_weigh(s->c, s->island, capacity, fraction);
    left -= fraction;
    for (uint32_t i = 0; i < s->count; i++)
      for (int copy = 0; s->parts[i] == part && copy < 2; copy++)
        *corner(s, s->elements[i], s->corners[i], copy) = capacity;
  }
  sbri_split_weigh(s->c, s->island, slot, left);
  return 0;
}

uint32_t sbri_island_split(sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  const uint32_t *torn = sbri_torn(c) + island->tetrahedra.first_state;
  splitting s = {.c = c,
      .island = island,
      .torn = torn,
      .blocks = sbri_solids(c) + island->tetrahedra.first_state_block};
  uint32_t unsplit = island->springs.tear ? sbri_island_split_springs(c, index) : 0;
  for (uint32_t t = 0; island->tetrahedra.tears && t < island->tetrahedra.count; t++)
    for (uint32_t k = 0; k < 4 && torn[t] == SBRI_TORN_NOW; k++) {
      uint32_t slot = *corner(&s, t, k, 0);
      if (slot < island->free_count) unsplit += split(&s, slot);
    }
  sbri_island_states(c)[index].unsplit += unsplit;
  return unsplit;
}
