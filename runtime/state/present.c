/* Present tables of a character: the model's, with those that tears change replaced by the character's state.
 */
#include "state/state.h"

sbri_island sbri_island_now(const sbri_character *c, const sbri_island *island) {
  sbri_island now = *island;
  if (!island->splits) return now;
  now.masses = sbri_masses(c) + island->first_slot;
  now.inverse_masses = sbri_inverse_masses(c) + island->first_slot;
  now.gravity_scales = sbri_gravity_scales(c) + island->first_slot;
  if (!island->springs.tear) return now;
  size_t first = island->cells.first_state_cell;
  now.cells.ends = sbri_thread_ends(c) + island->cells.first_state_block;
  now.cells.at = sbri_thread_cells(c) + first;
  now.cells.links = sbri_thread_links(c) + first * SBRI_BLOCK;
  if (island->cells.damping) now.cells.damping = sbri_thread_damping(c) + first * SBRI_BLOCK;
  if (island->cells.slack) now.cells.slack = sbri_thread_slack(c) + first * SBRI_BLOCK;
  now.links.blocks = sbri_thread_blocks(c) + island->links.first_state_block;
  for (uint32_t b = 0; b < island->body_count; b++) { /* torn parts may oscillate faster than the whole */
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    bool reserved = body->slots.first_spare < body->slots.real_end;
    if (reserved && sbri_origins(c)[island->first_slot + body->slots.first_spare] != SBRI_UNUSED)
      now.stability.fastest_rad_s = island->stability.bound_rad_s;
  }
  return now;
}

void sbri_follow_origins(const sbri_character *c, const sbri_body *body, sbri_point *positions) {
  if (body->slots.first_spare == body->slots.real_end) return;
  const uint32_t *origins = sbri_origins(c) + c->model->islands[body->island].first_slot;
  for (uint32_t slot = body->slots.first_spare; slot < body->slots.real_end; slot++) {
    uint32_t from = origins[slot] == SBRI_UNUSED ? body->slots.begin : origins[slot];
    positions[slot - body->slots.begin] = positions[from - body->slots.begin];
  }
}

sbri_skin sbri_skin_now(const sbri_character *c, const sbri_skin *skin) {
  sbri_skin now = *skin;
  if (skin->binding_count) now.cells = sbri_skin_cells(c) + skin->first_cell;
  return now;
}
