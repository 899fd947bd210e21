/* Events of pairs of bodies that begin or cease to touch.
 *
 * Output, not state: no motion depends on it. Groups are read one after the other when all have stepped, so
 * the order of events does not depend on threads. */
#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"

/* A pair stays in contact within this gap: a resting pair may have no impulse in a tick. */
static const float MAX_GAP_M = 2e-4f;

static int order(const sbri_pair_report *a, const sbri_pair_report *b) {
  for (int k = 0; k < 2; k++)
    if (a->body_ids[k] != b->body_ids[k]) return a->body_ids[k] < b->body_ids[k] ? -1 : 1;
  return 0;
}

/* Sorts by body ids; the list is nearly sorted (D. L. Shell, A High-Speed Sorting Procedure, 1959). */
static void sort(sbri_pair_report *list, uint32_t count) {
  for (uint32_t step = count / 2; step > 0; step /= 2)
    for (uint32_t i = step; i < count; i++) {
      sbri_pair_report one = list[i];
      uint32_t k = i;
      for (; k >= step && order(&one, &list[k - step]) < 0; k -= step) list[k] = list[k - step];
      list[k] = one;
    }
}

/* ---- Pairs in contact now ---- */

/* Whether the contact is between two bodies: not self-contact, not the ground. */
static bool is_between(const sbri_contact *t) {
  return t->b.rigid_body != SBRI_CONTACT_PLANE && t->body_ids[0] != t->body_ids[1];
}

static bool is_same_pair(const sbri_pair_report *c, const sbri_contact *t) {
  return (c->body_ids[0] == t->body_ids[0] && c->body_ids[1] == t->body_ids[1]) ||
         (c->body_ids[0] == t->body_ids[1] && c->body_ids[1] == t->body_ids[0]);
}

/* Adds a contact; position and normal are those of the largest impulse. */
static void add_contact(
    sbri_pair_report *c, const sbri_contact_group *group, const sbri_contact *t, float *max_impulse) {
  c->impulse += t->tick.impulse;
  c->speed = c->speed > t->tick.max_closing_speed ? c->speed : t->tick.max_closing_speed;
  if (!(t->tick.impulse > *max_impulse)) return;
  *max_impulse = t->tick.impulse;
  c->normal = c->body_ids[0] == t->body_ids[0] ? t->normal : sbri_scale(t->normal, -1);
  c->position = (sbr_double3){group->origin.x + (double)t->tick.position.x,
      group->origin.y + (double)t->tick.position.y, group->origin.z + (double)t->tick.position.z};
}

/* Lists the touching pairs of a group. Contacts of a pair are adjacent. */
static void list_group(sbri_body_contacts *all, const sbri_contact_group *group) {
  const sbri_contact *contacts = all->contacts + group->first_contact;
  for (uint32_t i = 0; i < group->contact_count;) {
    const sbri_contact *t = &contacts[i];
    bool swapped = t->body_ids[1] < t->body_ids[0], is_touching = false;
    sbri_pair_report c = {.body_ids = {t->body_ids[swapped], t->body_ids[!swapped]}};
    float max_impulse = 0;
    do {
      add_contact(&c, group, &contacts[i], &max_impulse);
      is_touching = is_touching || all->constraints[group->first_contact + i].separation <= MAX_GAP_M;
      i++;
    } while (i < group->contact_count && is_same_pair(&c, &contacts[i]));
    if (is_between(t) && (is_touching || c.impulse > 0) && all->pair_reports.count < all->contact_capacity)
      all->pair_reports.at[all->pair_reports.count++] = c;
  }
}

/* ---- Resting pairs ---- */

static bool rests(const sbr_world *world, uint64_t body_id) {
  uint32_t index = (uint32_t)(body_id >> 32);
  const sbri_character *c = &world->characters[index];
  return c->model && world->body_contacts->group_of[index] == UINT32_MAX &&
         (sbri_header(c)->paused || !sbri_character_is_awake(c));
}

/* Sleeping or paused bodies stay in contact. */
static void list_resting(sbr_world *world, const sbri_pair_report *before, uint32_t count) {
  sbri_body_contacts *all = world->body_contacts;
  for (uint32_t i = 0; i < count; i++)
    if (rests(world, before[i].body_ids[0]) && rests(world, before[i].body_ids[1]) &&
        all->pair_reports.count < all->contact_capacity) {
      all->pair_reports.at[all->pair_reports.count] = before[i];
      all->pair_reports.at[all->pair_reports.count++].impulse = 0;
    }
}

/* ---- Events ---- */

static sbr_object object_of(const sbr_world *world, uint64_t body_id) {
  int32_t index = (int32_t)(body_id & 0x7fffffffu);
  bool is_rigid = body_id >> 31 & 1;
  return (sbr_object){.character = sbri_id_of(world, &world->characters[body_id >> 32]),
      .soft_body = is_rigid ? -1 : index,
      .rigid_body = is_rigid ? index : -1};
}

static void report(sbr_world *world, const sbri_pair_report *c, sbri_event_kind kind) {
  if (!world->characters[c->body_ids[0] >> 32].model || !world->characters[c->body_ids[1] >> 32].model)
    return;
  sbr_contact_event event = {.tick = world->time.ticks,
      .a = object_of(world, c->body_ids[0]),
      .b = object_of(world, c->body_ids[1]),
      .position = c->position,
      .normal = c->normal,
      .impulse = c->impulse,
      .speed = c->speed};
  sbri_event_add(world, kind, &event);
}

void sbri_pair_reports_publish(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  sbri_pair_report *before = all->pair_reports.at, *now = all->pair_reports.next;
  uint32_t before_count = all->pair_reports.count, kept = 0, b = 0;
  all->pair_reports.at = now, all->pair_reports.next = before;
  all->pair_reports.count = 0;
  for (uint32_t g = 0; g < all->group_count; g++) list_group(all, &all->groups[g]);
  list_resting(world, before, before_count);
  sort(now, all->pair_reports.count);
  for (uint32_t i = 0; i < all->pair_reports.count; i++) {
    sbri_pair_report c = now[i];
    while (b < before_count && order(&before[b], &c) < 0) report(world, &before[b++], SBRI_EVENT_CONTACT_END);
    bool was_touching = b < before_count && order(&before[b], &c) == 0;
    if (was_touching && !(c.impulse > 0)) c.position = before[b].position, c.normal = before[b].normal;
    if (was_touching) b++;
    if (!was_touching && !(c.impulse > 0)) continue;
    if (!was_touching) report(world, &c, SBRI_EVENT_CONTACT_BEGIN);
    if (c.impulse > 0 && c.speed >= world->hit_speed) report(world, &c, SBRI_EVENT_CONTACT_HIT);
    c.impulse = c.speed = 0; /* of this tick only */
    now[kept++] = c;
  }
  while (b < before_count) report(world, &before[b++], SBRI_EVENT_CONTACT_END);
  all->pair_reports.count = kept;
}

void sbri_pair_reports_remove(sbr_world *world, uint32_t character) {
  sbri_body_contacts *all = world->body_contacts;
  uint32_t kept = 0;
  for (uint32_t i = 0; all && i < all->pair_reports.count; i++) {
    const sbri_pair_report *c = &all->pair_reports.at[i];
    if (c->body_ids[0] >> 32 != character && c->body_ids[1] >> 32 != character)
      all->pair_reports.at[kept++] = *c;
  }
  if (all) all->pair_reports.count = kept;
}
