/* Spare slots for points that split. */
#include "soft/tear/spare_slot.h"

uint32_t sbri_find_spare_slot(const sbri_character *c, const sbri_island *island, uint32_t slot) {
  const sbr_model *model = c->model;
  uint32_t b = 0;
  while (slot >= model->bodies[island->bodies[b]].slots.end) b++;
  const sbri_body *body = &model->bodies[island->bodies[b]];
  for (uint32_t spare = body->slots.first_spare; spare < body->slots.real_end; spare++)
    if (sbri_origins(c)[island->first_slot + spare] == SBRI_UNUSED) return spare;
  return SBRI_UNUSED;
}

void sbri_split_copy(sbri_character *c, const sbri_island *island, uint32_t from, uint32_t to) {
  size_t first = island->first_slot;
  sbri_point *now = sbri_positions(c) + first, *before = sbri_previous_positions(c) + first;
  float *v = sbri_velocities(c) + 3 * first;
  now[to] = now[from], before[to] = before[from];
  for (uint32_t k = 0; k < 3 * SBRI_BLOCK; k += SBRI_BLOCK)
    v[3 * (to / SBRI_BLOCK * SBRI_BLOCK) + to % SBRI_BLOCK + k] =
        v[3 * (from / SBRI_BLOCK * SBRI_BLOCK) + from % SBRI_BLOCK + k];
  sbri_origins(c)[first + to] = sbri_origins(c)[first + from];
  sbri_gravity_scales(c)[first + to] = sbri_gravity_scales(c)[first + from];
}

void sbri_split_weigh(sbri_character *c, const sbri_island *island, uint32_t slot, float mass_kg) {
  sbri_masses(c)[island->first_slot + slot] = mass_kg;
  sbri_inverse_masses(c)[island->first_slot + slot] = mass_kg > 0 ? 1 / mass_kg : 0;
}
