/* Spring networks as graphs. */
#ifndef SBRI_SPRING_NETWORK_H
#define SBRI_SPRING_NETWORK_H

#include "model/runtime_model.h"

/* Springs of an island from point to point: in the original or the present state. */
typedef struct sbri_network {
  const sbri_island *island; /* from sbri_island_now, or the model's */
  const float *strengths;    /* of its links; NULL: all springs are intact */
} sbri_network;
typedef struct sbri_network_end {
  uint32_t row, other, link; /* cell, slot of the other end, link of the island */
} sbri_network_end;

/* Advances to the next intact spring of the slot, from `end->row` on, which begins at 0; false: none. Pinned
 * slots list none. */
static inline bool sbri_network_next(const sbri_network *n, uint32_t slot, sbri_network_end *end) {
  const sbri_island *island = n->island;
  if (slot >= island->free_count) return false;
  uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
  for (uint32_t row = end->row; row < island->cells.ends[block] - island->cells.begins[block]; row++) {
    uint32_t cell = island->cells.begins[block] + row;
    *end = (sbri_network_end){
        row + 1, island->cells.at[cell].others[lane], island->cells.links[cell * SBRI_BLOCK + lane]};
    if (end->other != slot && (!n->strengths || n->strengths[end->link] > 0)) return true;
  }
  return false;
}

#endif
