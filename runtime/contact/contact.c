#include "contact/contact.h"

#include <string.h>

#include "base/assert.h"
#include "contact/contact_block.h"
#include "contact/ground_contacts.h"
#include "contact/point_contacts.h"
#include "contact/sample_motion.h"
#include "contact/self_contacts.h"
#include "contact/soft_shape_contacts.h"
#include "shapes/external_body.h"

/* Bodies without samples have one ground plane per point. Turns these planes into contacts, so that they are
 * solved together with contacts with shapes. */
static void convert_planes_to_contacts(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  uint32_t *count = &tables->contact_counts[body - t->model->bodies];
  for (uint32_t block = body->slots.begin / SBRI_BLOCK; block < body->slots.end / SBRI_BLOCK; block++) {
    if (!tables->near_ground[block]) continue;
    tables->near_ground[block] = 0;
    const float *plane = tables->planes + (size_t)block * 4 * SBRI_BLOCK;
    for (uint32_t lane = 0; lane < SBRI_BLOCK && *count < body->contact.max_count; lane++) {
      sbri_sample s = sbri_point_sample(t, block * SBRI_BLOCK + lane);
      if (s.slots[0] >= body->slots.real_end || !(s.mass_kg > 0)) continue;
      sbri_soft_contact *contact = &tables->contacts[body->contact.first + (*count)++];
      *contact = (sbri_soft_contact){.sample = s,
          .normal = {plane[lane], plane[SBRI_BLOCK + lane], plane[2 * SBRI_BLOCK + lane]},
          .offset = plane[3 * SBRI_BLOCK + lane],
          .friction_scale = 1,
          .restitution = body->contact.restitution,
          .collider = SBRI_NO_COLLIDER};
      contact->gap = sbri_contact_predicted_gap(t, contact);
    }
  }
}

/* Marks contacts whose points have no other contact. In a body with samples, several contacts may share
 * points. */
static void find_single_contacts(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  sbri_soft_contact *contacts = tables->contacts + body->contact.first;
  uint32_t count = tables->contact_counts[body - t->model->bodies];
  memset(tables->slot_contacts + body->slots.begin, 0, body->slots.end - body->slots.begin);
  for (uint32_t i = 0; i < count; i++)
    for (int k = 0; k < 4; k++) {
      uint32_t slot = contacts[i].sample.slots[k];
      bool moves = contacts[i].sample.weights[k] != 0 && slot < t->island->free_count;
      if (moves && tables->slot_contacts[slot] < 2) tables->slot_contacts[slot]++;
    }
  for (uint32_t i = 0; i < count; i++) {
    const sbri_sample *s = &contacts[i].sample;
    contacts[i].is_single = !contacts[i].external_body && s->weights[0] == 1 && s->weights[1] == 0 &&
                            s->weights[2] == 0 && s->weights[3] == 0 && s->slots[0] < t->island->free_count &&
                            tables->slot_contacts[s->slots[0]] == 1;
  }
}

void sbri_contact_prepare(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  tables->contact_counts[body - t->model->bodies] = 0;
  t->contacts.block_counts[body - t->model->bodies] = 0;
  if (body->slots.begin == body->slots.end) return;
  if (body->contact.samples)
    sbri_ground_contacts_add(t, body, tables);
  else
    sbri_ground_planes_find(t, body, tables);
  uint32_t *count = &tables->contact_counts[body - t->model->bodies], first_shape_contact = *count;
  tables->external_bodies->count = 0;
  sbri_soft_shape_contacts_add(t, body, tables);
  if (body->contact.samples) sbri_point_contacts_limit(t, body, tables);
  if (body->self.face_count) {
    sbri_bounds_tree tree = {.nodes = tables->self_nodes, .items = tables->self_items};
    sbri_self_contacts_add(t, body, tables, &tree);
  }
  if (*count > first_shape_contact && !body->contact.samples) {
    convert_planes_to_contacts(t, body, tables);
    find_single_contacts(t, body, tables);
  }
  SBF_ASSERT(*count <= body->contact.max_count);
  sbri_contact_blocks_fill(t, body);
}
