/* What splitting the points of tetrahedra and those of springs share, and networks of springs as graphs. */
#ifndef SBRI_SPLIT_H
#define SBRI_SPLIT_H

#include "world/state.h"

/* A slot that is not used yet, of the body that has `slot`; SBRI_UNUSED: there is none. */
uint32_t sbri_split_room(const sbri_character *c, const sbri_island *island, uint32_t slot);
/* Place, velocity, origin and weight's scale of one slot of the island to another. */
void sbri_split_copy(sbri_character *c, const sbri_island *island, uint32_t from, uint32_t to);
void sbri_split_weigh(sbri_character *c, const sbri_island *island, uint32_t slot, float mass_kg);

/* tear/split_springs.c: splits the points of an island that frays; returns how many it had no room for. */
uint32_t sbri_island_split_springs(sbri_character *c, uint32_t island);
/* An island's springs from point to point: as made, or as they are now. */
typedef struct sbri_network {
  const sbri_island *island; /* as sbri_island_now has it, or the model's */
  const float *strengths;    /* of its links; NULL: all springs are whole */
} sbri_network;
typedef struct sbri_network_end {
  uint32_t row, other, link; /* cell, slot of the other end, link of the island */
} sbri_network_end;

/* Goes to the next whole spring of the slot, from `end->row` on, which begins with 0; false: there is none.
 * Held slots list none. */
static inline bool sbri_network_next(const sbri_network *n, uint32_t slot, sbri_network_end *end) {
  const sbri_island *island = n->island;
  if (slot >= island->free_count) return false;
  uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
  for (uint32_t row = end->row; row < island->cell_ends[block] - island->cell_begins[block]; row++) {
    uint32_t cell = island->cell_begins[block] + row;
    *end = (sbri_network_end){
        row + 1, island->cells[cell].others[lane], island->cell_links[cell * SBRI_BLOCK + lane]};
    if (end->other != slot && (!n->strengths || n->strengths[end->link] > 0)) return true;
  }
  return false;
}

/* ---- tear/torn_network.c ---- */

/* An island that frays, after its points have split. */
typedef struct sbri_torn_network {
  sbri_character *c;
  sbri_island island; /* as it is now */
  sbri_network whole, rest;
  const uint32_t *origins;
  uint32_t *seen, *queue; /* (slots) */
} sbri_torn_network;
void sbri_torn_network_begin(sbri_torn_network *network, sbri_character *c, uint32_t island);
/* Puts a vertex on one side of what has torn; whether its carriers have changed, or lie near a torn spring.
 */
bool sbri_network_vertex_follow(const sbri_torn_network *network, const sbri_skin *skin, uint32_t binding);
/* Whether a tear has parted what two vertices ride on. */
bool sbri_network_vertices_part(
    const sbri_torn_network *network, const sbri_skin *skin, uint32_t binding_a, uint32_t binding_b);

#endif
