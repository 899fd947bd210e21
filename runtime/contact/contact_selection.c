#include "contact/contact_selection.h"

#include "contact/sample_motion.h"

/* Cosine: contacts that face another way than the deepest of their point, as over an edge, all stay. */
static const float SAME_NORMAL = 0.9f;

static bool is_like(const sbri_soft_contact *a, const sbri_soft_contact *b) {
  return sbri_dot(a->normal, b->normal) > SAME_NORMAL;
}

static sbri_contact_choice choice_of(
    const sbri_island_tick *t, const sbri_body *body, const sbri_soft_contact *contacts, uint32_t i) {
  const sbri_sample *s = &contacts[i].sample;
  return sbri_contact_choice_of(body, i, sbri_contact_predicted_gap(t, &contacts[i]),
      s->vertex == UINT32_MAX ? s->slots[0] : s->vertex);
}

static bool is_chosen(const sbri_contact_choice *best, uint32_t count, uint32_t contact) {
  for (uint32_t i = 0; i < count; i++)
    if (best[i].item == contact) return true;
  return false;
}

void sbri_contacts_select(
    const sbri_island_tick *t, const sbri_body *body, uint32_t first, const sbri_contact_tables *tables) {
  uint32_t *count = &tables->contact_counts[body - t->model->bodies], kept = first;
  sbri_soft_contact *contacts = tables->contacts + body->first_soft_contact;
#define SBRI_BEST(i) (tables->choices + (size_t)SBRI_POINT_CONTACTS * sbri_main_slot(&contacts[i].sample))
#define SBRI_COUNT(i) tables->slot_contacts[sbri_main_slot(&contacts[i].sample)]
  for (uint32_t i = first; i < *count; i++) SBRI_COUNT(i) = 0;
  for (uint32_t i = first; i < *count; i++) {
    sbri_contact_choice choice = choice_of(t, body, contacts, i);
    if (SBRI_COUNT(i) == 0 || sbri_comes_before(choice, *SBRI_BEST(i))) *SBRI_BEST(i) = choice;
    SBRI_COUNT(i) = 1;
  }
  for (uint32_t i = first; i < *count; i++)
    if (SBRI_BEST(i)->item != i && is_like(&contacts[i], &contacts[SBRI_BEST(i)->item]))
      sbri_contact_choose(SBRI_BEST(i), &SBRI_COUNT(i), choice_of(t, body, contacts, i));
  /* Marked before any moves, which change their numbers. */
  for (uint32_t i = first; i < *count; i++)
    contacts[i].alone =
        is_chosen(SBRI_BEST(i), SBRI_COUNT(i), i) || !is_like(&contacts[i], &contacts[SBRI_BEST(i)->item]);
#undef SBRI_COUNT
#undef SBRI_BEST
  for (uint32_t i = first; i < *count; i++)
    if (contacts[i].alone) {
      contacts[kept] = contacts[i];
      contacts[kept++].alone = false;
    }
  *count = kept;
}
