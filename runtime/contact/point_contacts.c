#include "contact/point_contacts.h"

#include <math.h>

/* Cosine of the angle between normals that count as one direction. */
static const float SIMILAR_COSINE = 0.9f;

/* The limit saves less than it costs on fewer contacts. */
enum { MIN_LIMITED = 256 };

/* Point with the greatest weight. */
static uint32_t owner_of(const sbri_sample *s) {
  int greatest = 0;
  for (int k = 1; k < 4; k++)
    if (fabsf(s->weights[k]) > fabsf(s->weights[greatest])) greatest = k;
  return s->slots[greatest];
}

/* Marks a contact for removal by an impossible effective mass. */
static void mark(sbri_soft_contact *contact) {
  contact->sample.mass_kg = 0;
}

static bool is_similar(const sbri_soft_contact *a, const sbri_soft_contact *b) {
  return a->collider == b->collider && sbri_dot(a->normal, b->normal) >= SIMILAR_COSINE;
}

/* Inserts the contact in the order of gaps, and marks the one that falls out. */
static void insert(sbri_point_contacts *p, sbri_soft_contact *contacts, uint32_t index) {
  float gap = contacts[index].gap;
  if (p->count == SBRI_CONTACTS_PER_POINT && gap >= p->gaps[p->count - 1]) {
    mark(&contacts[index]);
    return;
  }
  if (p->count == SBRI_CONTACTS_PER_POINT) mark(&contacts[p->contacts[--p->count]]);
  uint32_t i = p->count++;
  for (; i > 0 && p->gaps[i - 1] > gap; i--) p->gaps[i] = p->gaps[i - 1], p->contacts[i] = p->contacts[i - 1];
  p->gaps[i] = gap, p->contacts[i] = index;
}

static void clear(sbri_point_contacts *points, uint32_t begin, uint32_t end) {
  for (uint32_t slot = begin; slot < end; slot++) points[slot].count = 0;
}

void sbri_point_contacts_limit(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  sbri_soft_contact *contacts = tables->contacts + body->contact.first;
  uint32_t *count = &tables->contact_counts[body - t->model->bodies], kept = 0;
  if (*count <= MIN_LIMITED) return;
  sbri_point_contacts *points = tables->point_contacts;
  clear(points, body->slots.begin, body->slots.end);
  if (body->is_pinned) clear(points, t->island->free_count, t->island->slot_count);
  for (uint32_t i = 0; i < *count; i++) {
    sbri_point_contacts *p = &points[owner_of(&contacts[i].sample)];
    if (contacts[i].gap < -SBRI_STRIKE_M_S * t->tick_s) continue;
    if (p->count > 0 && !is_similar(&contacts[i], &contacts[p->contacts[0]])) continue;
    insert(p, contacts, i);
  }
  for (uint32_t i = 0; i < *count; i++)
    if (contacts[i].sample.mass_kg > 0) contacts[kept++] = contacts[i];
  *count = kept;
}
