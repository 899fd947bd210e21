/* Spare slots for points that split. */
#ifndef SBRI_SPARE_SLOT_H
#define SBRI_SPARE_SLOT_H

#include "state/state.h"

/* An unused slot of the body of `slot`; SBRI_UNUSED: none. */
uint32_t sbri_find_spare_slot(const sbri_character *c, const sbri_island *island, uint32_t slot);
/* Copies position, velocity, origin and gravity scale of a slot of the island to another. */
void sbri_split_copy(sbri_character *c, const sbri_island *island, uint32_t from, uint32_t to);
void sbri_split_weigh(sbri_character *c, const sbri_island *island, uint32_t slot, float mass_kg);

#endif
