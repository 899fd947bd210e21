/* Warm start: contact impulses of the last step, stored for the next tick. The iterations that find the
 * active set begin with them; for a body at rest they end there too. The stored impulses are initial guesses,
 * and give the bounds of friction for the first iteration. */
#include "base/assert.h"
#include "rigid/rigid_work.h"

/* Tolerance for matching contact points of two ticks, as a fraction of the body's size. */
static const float SAME_FRACTION = 0.05f;

/* A contact that is not found again persists within this fraction of the body's size, if it was active within
 * so many ticks and another contact of the pair has a similar normal. */
static const float NEAR_FRACTION = 0.02f, FACING = 0.97f;
enum { IDLE_TICKS = 4 };

static bool is_same(const sbri_stored_contact *stored, const sbri_rigid_contact *contact, float max) {
  sbf_vec3 distance = sbri_sub(stored->at, contact->at);
  return stored->surface == contact->surface && sbri_dot(distance, distance) <= max * max;
}

static void restore(const sbri_stored_contact *stored, sbri_rigid_contact *contact) {
  contact->history.is_known = true;
  contact->history.idle_ticks = stored->idle_ticks;
  contact->history.normal_n = stored->normal_n, contact->history.friction_n = stored->friction_n;
  contact->history.velocity_error = stored->velocity_error;
}

/* A newly found contact of the pair whose normal is similar to that of the lost one; NULL: none. */
static const sbri_rigid_contact *find_similar(
    const sbri_rigid_solving *work, const sbri_stored_contact *stored) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    const sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (contact->body == stored->body && contact->surface == stored->surface &&
        sbri_dot(contact->normal, stored->normal) > FACING &&
        sbri_dot(contact->velocity, contact->velocity) == 0)
      return contact;
  }
  return NULL;
}

/* Two hulls with crossing edges have one contact point at a time and would rock between two. So a contact
 * that is not found in this tick persists while the body is near it. */
static void store_contact(
    const sbri_rigid_tick *t, sbri_rigid_solving *work, const sbri_stored_contact *stored) {
  if (stored->idle_ticks > IDLE_TICKS || work->contact_list.count >= work->contact_list.capacity) return;
  const sbri_rigid_contact *similar = find_similar(work, stored);
  if (!similar) return;
  const sbri_rigid_body_state *s = &t->bodies[stored->body];
  sbf_vec3 x = sbri_add(s->pose.position, sbri_rotate(s->pose.rotation, stored->at));
  float gap = sbri_dot(stored->normal, x) - stored->offset;
  if (fabsf(gap) > NEAR_FRACTION * t->model->bodies[stored->body].radius) return;
  sbri_rigid_contact *contact = &work->contact_list.at[work->contact_list.count++];
  *contact = *similar;
  contact->at = stored->at, contact->normal = stored->normal, contact->offset = stored->offset;
  if (contact->external_body)
    contact->external_body_arm = sbri_sub(x, work->external_list.at[contact->external_body - 1].is.centre);
  restore(stored, contact);
}

void sbri_stored_contacts_apply(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  uint32_t count = t->drive->stored_contacts, begin = 0;
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    float max = SAME_FRACTION * t->model->bodies[contact->body].radius;
    if (contact->surface == UINT32_MAX) max = 0; /* ground contacts are vertices */
    for (uint32_t k = 0; k < count; k++) {       /* usually the one after the last match */
      sbri_stored_contact *stored = &t->kept[(begin + k) % count];
      if (stored->body != contact->body || !is_same(stored, contact, max)) continue;
      stored->found = 1;
      restore(stored, contact);
      begin = (begin + k + 1) % count;
      break;
    }
  }
  for (uint32_t k = 0; k < count; k++)
    if (!t->kept[k].found && t->kept[k].surface != UINT32_MAX) store_contact(t, work, &t->kept[k]);
}

void sbri_stored_contacts_save(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    const sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (!contact->history.is_known) continue;
    t->kept[count++] = (sbri_stored_contact){.body = contact->body,
        .surface = contact->surface,
        .at = contact->at,
        .friction_n = contact->history.friction_n,
        .velocity_error = contact->history.velocity_error,
        .idle_ticks = contact->history.normal_n > 0 ? 0 : contact->history.idle_ticks + 1,
        .normal = contact->normal,
        .offset = contact->offset,
        .normal_n = contact->history.normal_n};
  }
  SBF_ASSERT(count <= sbri_rigid_contact_capacity(t->model));
  t->drive->stored_contacts = count;
}
