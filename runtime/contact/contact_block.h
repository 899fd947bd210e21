/* Contacts of a soft body in blocks of eight, for soft/solvers/contact_lanes.h. */
#ifndef SBRI_CONTACT_BLOCK_H
#define SBRI_CONTACT_BLOCK_H

#include "model/island_tick.h"

/* Fills the blocks of the body from its contacts and their friction coefficients. A body with self-contacts
 * or contacts with external bodies gets no blocks. Marks the blocks of slots that contacts move or read in
 * tick->contact_slots. */
void sbri_contact_blocks_fill(const sbri_island_tick *tick, const sbri_body *body);

/* Copies the results in the blocks to the body's contacts. */
void sbri_contact_blocks_unpack(const sbri_island_tick *tick, const sbri_body *body);

/* Moves the planes with their colliders, at the end of a substep. */
void sbri_contact_blocks_advance(const sbri_island_tick *tick, const sbri_body *body, float step_s);

/* Friction coefficient of a contact. */
float sbri_contact_friction_at(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_soft_contact *contact);

/* Number of blocks of the body in this tick; 0: its contacts are solved in sequence
 * (soft/solvers/soft_contacts.h). */
static inline uint32_t sbri_contact_block_count(const sbri_island_tick *t, const sbri_body *body) {
  return t->contacts.block_counts ? t->contacts.block_counts[body - t->model->bodies] : 0;
}

static inline sbri_contact_block *sbri_contact_blocks_of(const sbri_island_tick *t, const sbri_body *body) {
  return t->contacts.blocks + body->contact.first_block;
}

#endif
