/* Leaves out contacts that others of the same points make needless.
 *
 * A surface has many more samples than the points that carry it, and a few contacts hold all that a point can
 * do. Each contact counts with the point of its greatest weight. Of those with the same point, on the same
 * collider and facing the same way, the SBRI_POINT_CONTACTS deepest stay, by their gaps at the end of the
 * tick. Where samples lie as deep, as on a flat base, those of the lowest rank stay: the same in every tick,
 * and scattered over the surface. */
#ifndef SBRI_CONTACT_SELECTION_H
#define SBRI_CONTACT_SELECTION_H

#include "contact/contact.h"

/* Of a body's size: gaps that differ by less are the same. */
#define SBRI_SAME_GAP_FRACTION 1e-3f

static inline uint32_t sbri_main_slot(const sbri_sample *s) {
  uint32_t k = 0;
  for (uint32_t i = 1; i < 4; i++)
    if (s->weights[i] > s->weights[k]) k = i;
  return s->slots[k];
}

/* A contact to choose, or a sample of which one would be made. `gap` in m; `number` scatters neighbours when
 * hashed (D. Knuth, The Art of Computer Programming 3, 6.4, multiplicative hashing). */
static inline sbri_contact_choice sbri_contact_choice_of(
    const sbri_body *body, uint32_t item, float gap, uint32_t number) {
  const float whole = 12582912; /* 1.5 * 2^23: sums with it have no fraction */
  float same = SBRI_SAME_GAP_FRACTION * body->rest_size_m;
  return (sbri_contact_choice){item, number * 2654435761u, same > 0 ? gap / same + whole - whole : gap};
}

static inline bool sbri_comes_before(sbri_contact_choice a, sbri_contact_choice b) {
  return a.depth != b.depth ? a.depth < b.depth : a.rank < b.rank;
}

/* Puts a choice among the `*count` best ones of its point, deepest first, if it belongs there. */
static inline void sbri_contact_choose(
    sbri_contact_choice *best, uint8_t *count, sbri_contact_choice choice) {
  uint32_t at = *count;
  if (at < SBRI_POINT_CONTACTS)
    ++*count;
  else if (sbri_comes_before(choice, best[at - 1]))
    at--;
  else
    return;
  for (; at > 0 && sbri_comes_before(choice, best[at - 1]); at--) best[at] = best[at - 1];
  best[at] = choice;
}

/* Selects among the contacts of a body with samples from `first` on, all with the same collider or all with
 * the ground; those that stay keep their order. */
void sbri_contacts_select(
    const sbri_island_tick *tick, const sbri_body *body, uint32_t first, const sbri_contact_tables *tables);

#endif
