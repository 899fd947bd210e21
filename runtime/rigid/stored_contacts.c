/* Warm start: contact impulses of the last step, kept for the next tick. The passes that find the active set
 * begin with them; for a body at rest they end there too. The stored impulses are initial guesses, and the
 * bounds of friction for the first pass. */
#include "base/assert.h"
#include "rigid/rigid_work.h"

/* Tolerance for matching contact points of two ticks, as a fraction of the body's size. */
static const float SAME_FRACTION = 0.05f;

/* A contact that is not found again persists within this fraction of the body's size if it was active in so
 * many ticks and another one of the pair faces a similar direction. */
static const float NEAR_FRACTION = 0.02f, FACING = 0.97f;
enum { IDLE_TICKS = 4 };

static bool is_same(const sbri_stored_contact *kept, const sbri_rigid_contact *contact, float max) {
  sbf_vec3 off = sbri_sub(kept->at, contact->at);
  return kept->surface == contact->surface && sbri_dot(off, off) <= max * max;
}

static void give_back(const sbri_stored_contact *kept, sbri_rigid_contact *contact) {
  contact->known = true;
  contact->idle = kept->idle;
  contact->normal_n = kept->normal_n, contact->drag_n = kept->drag_n;
  contact->left = kept->left;
}

/* A newly found contact of the pair whose normal is similar to that of the lost one; NULL: none. */
static const sbri_rigid_contact *beside(const sbri_rigid_solving *work, const sbri_stored_contact *kept) {
  for (uint32_t i = 0; i < work->rigid_contact_count; i++) {
    const sbri_rigid_contact *contact = &work->contacts[i];
    if (contact->body == kept->body && contact->surface == kept->surface &&
        sbri_dot(contact->normal, kept->normal) > FACING &&
        sbri_dot(contact->velocity, contact->velocity) == 0)
      return contact;
  }
  return NULL;
}

/* Two hulls with crossing edges have one contact point at a time and would rock between two. So the one that
 * is not found this time persists while the body is near it. */
static void bear_on(const sbri_rigid_tick *t, sbri_rigid_solving *work, const sbri_stored_contact *kept) {
  if (kept->idle > IDLE_TICKS || work->rigid_contact_count >= work->max_contacts) return;
  const sbri_rigid_contact *by = beside(work, kept);
  if (!by) return;
  const sbri_rigid_body_state *s = &t->bodies[kept->body];
  sbf_vec3 x = sbri_add(s->pose.position, sbri_rotate(s->pose.rotation, kept->at));
  float gap = sbri_dot(kept->normal, x) - kept->offset;
  if (fabsf(gap) > NEAR_FRACTION * t->model->bodies[kept->body].radius) return;
  sbri_rigid_contact *contact = &work->contacts[work->rigid_contact_count++];
  *contact = *by;
  contact->at = kept->at, contact->normal = kept->normal, contact->offset = kept->offset;
  if (contact->external_body)
    contact->external_body_arm = sbri_sub(x, work->external_bodies[contact->external_body - 1].is.centre);
  give_back(kept, contact);
}

void sbri_stored_contacts_apply(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  uint32_t count = t->drive->stored_contacts, begin = 0;
  for (uint32_t i = 0; i < work->rigid_contact_count; i++) {
    sbri_rigid_contact *contact = &work->contacts[i];
    float max = SAME_FRACTION * t->model->bodies[contact->body].radius;
    if (contact->surface == UINT32_MAX) max = 0; /* those on the ground are vertices */
    for (uint32_t k = 0; k < count; k++) {       /* mostly the one behind the last */
      sbri_stored_contact *kept = &t->kept[(begin + k) % count];
      if (kept->body != contact->body || !is_same(kept, contact, max)) continue;
      kept->found = 1;
      give_back(kept, contact);
      begin = (begin + k + 1) % count;
      break;
    }
  }
  for (uint32_t k = 0; k < count; k++)
    if (!t->kept[k].found && t->kept[k].surface != UINT32_MAX) bear_on(t, work, &t->kept[k]);
}

void sbri_stored_contacts_save(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < work->rigid_contact_count; i++) {
    const sbri_rigid_contact *contact = &work->contacts[i];
    if (!contact->known) continue;
    t->kept[count++] = (sbri_stored_contact){.body = contact->body,
        .surface = contact->surface,
        .at = contact->at,
        .drag_n = contact->drag_n,
        .left = contact->left,
        .idle = contact->normal_n > 0 ? 0 : contact->idle + 1,
        .normal = contact->normal,
        .offset = contact->offset,
        .normal_n = contact->normal_n};
  }
  SBF_ASSERT(count <= sbri_rigid_contact_capacity(t->model));
  t->drive->stored_contacts = count;
}
