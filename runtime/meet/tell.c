/* Who touches whom, from tick to tick: the events of bodies that begin to touch each other and that part.
 *
 * Output, not state: nothing that moves goes by it. Groups are looked through one after the other when all of
 * them have stepped, so that the order of events does not depend on threads. */
#include "math/vec3.h"
#include "meet/meetings.h"

/* Who has touched still does while no further off than this: a push less must not part what lies. */
static const float STILL_M = 2e-4f;

static int order(const sbri_meet_contact *a, const sbri_meet_contact *b) {
  for (int k = 0; k < 2; k++)
    if (a->names[k] != b->names[k]) return a->names[k] < b->names[k] ? -1 : 1;
  return 0;
}

/* By names. They nearly are: group after group, pair after pair (D. L. Shell, A High-Speed Sorting Procedure,
 * 1959). */
static void sort(sbri_meet_contact *list, uint32_t count) {
  for (uint32_t step = count / 2; step > 0; step /= 2)
    for (uint32_t i = step; i < count; i++) {
      sbri_meet_contact one = list[i];
      uint32_t k = i;
      for (; k >= step && order(&one, &list[k - step]) < 0; k -= step) list[k] = list[k - step];
      list[k] = one;
    }
}

/* ---- What touches now ---- */

/* Whether the touch is between two bodies, and none lies on itself or on the ground. */
static bool is_between(const sbri_meet_touch *t) {
  return t->b.rigid_body != SBRI_MEET_PLANE && t->names[0] != t->names[1];
}

static bool names_them(const sbri_meet_contact *c, const sbri_meet_touch *t) {
  return (c->names[0] == t->names[0] && c->names[1] == t->names[1]) ||
         (c->names[0] == t->names[1] && c->names[1] == t->names[0]);
}

/* Adds what has pushed most to where they touch. */
static void add_touch(
    sbri_meet_contact *c, const sbri_meet_group *group, const sbri_meet_touch *t, float *most) {
  c->impulse += t->impulse;
  c->speed = c->speed > t->closing ? c->speed : t->closing;
  if (!(t->impulse > *most)) return;
  *most = t->impulse;
  c->normal = c->names[0] == t->names[0] ? t->normal : sbri_scale(t->normal, -1);
  c->position = (sbr_double3){group->origin.x + (double)t->place.x, group->origin.y + (double)t->place.y,
      group->origin.z + (double)t->place.z};
}

/* The pairs of a group that touch; those of a pair follow each other. */
static void list_group(sbri_meetings *all, const sbri_meet_group *group) {
  const sbri_meet_touch *touches = all->touches + group->first_touch;
  for (uint32_t i = 0; i < group->touch_count;) {
    const sbri_meet_touch *t = &touches[i];
    bool turned = t->names[1] < t->names[0], touch = false;
    sbri_meet_contact c = {.names = {t->names[turned], t->names[!turned]}};
    float most = 0;
    do {
      add_touch(&c, group, &touches[i], &most);
      touch = touch || all->rows[group->first_touch + i].gap <= STILL_M;
      i++;
    } while (i < group->touch_count && names_them(&c, &touches[i]));
    if (is_between(t) && (touch || c.impulse > 0) && all->contact_count < all->touch_capacity)
      all->contacts[all->contact_count++] = c;
  }
}

/* ---- What rests ---- */

static bool rests(const sbr_world *world, uint64_t name) {
  uint32_t index = (uint32_t)(name >> 32);
  const sbri_character *c = &world->characters[index];
  return c->model && world->meetings->group_of[index] == UINT32_MAX &&
         (sbri_head(c)->paused || !sbri_meet_is_awake(c));
}

/* Those that sleep or pause on each other go on touching. */
static void list_resting(sbr_world *world, const sbri_meet_contact *before, uint32_t count) {
  sbri_meetings *all = world->meetings;
  for (uint32_t i = 0; i < count; i++)
    if (rests(world, before[i].names[0]) && rests(world, before[i].names[1]) &&
        all->contact_count < all->touch_capacity) {
      all->contacts[all->contact_count] = before[i];
      all->contacts[all->contact_count++].impulse = 0;
    }
}

/* ---- Telling ---- */

static void tell(sbr_world *world, const sbri_meet_contact *c, sbr_event_kind kind) {
  const sbri_character *one = &world->characters[c->names[0] >> 32],
                       *other = &world->characters[c->names[1] >> 32];
  uint32_t numbers[2];
  int32_t rigid[2];
  if (!one->model || !other->model) return;
  for (int k = 0; k < 2; k++) {
    uint32_t number = (uint32_t)c->names[k] & 0x7fffffffu;
    bool is_rigid = c->names[k] >> 31 & 1;
    numbers[k] = is_rigid ? 0 : number;
    rigid[k] = is_rigid ? (int32_t)number : -1;
  }
  sbri_event_add(world, (sbr_event){.kind = kind,
                            .character = sbri_id_of(world, one),
                            .position = c->position,
                            .soft_body = numbers[0],
                            .rigid_body = rigid[0],
                            .normal = c->normal,
                            .impulse = c->impulse,
                            .other = sbri_id_of(world, other),
                            .other_soft_body = numbers[1],
                            .other_rigid_body = rigid[1],
                            .speed = c->speed});
}

void sbri_meet_tell(sbr_world *world) {
  sbri_meetings *all = world->meetings;
  sbri_meet_contact *before = all->contacts, *now = all->next_contacts;
  uint32_t before_count = all->contact_count, kept = 0, b = 0;
  all->contacts = now, all->next_contacts = before;
  all->contact_count = 0;
  for (uint32_t g = 0; g < all->group_count; g++) list_group(all, &all->groups[g]);
  list_resting(world, before, before_count);
  sort(now, all->contact_count);
  for (uint32_t i = 0; i < all->contact_count; i++) {
    sbri_meet_contact c = now[i];
    while (b < before_count && order(&before[b], &c) < 0) tell(world, &before[b++], SBR_EVENT_PARTED);
    bool touched = b < before_count && order(&before[b], &c) == 0;
    if (touched && !(c.impulse > 0)) c.position = before[b].position, c.normal = before[b].normal;
    if (touched) b++;
    if (!touched && !(c.impulse > 0)) continue;
    if (!touched) tell(world, &c, SBR_EVENT_CONTACT);
    c.impulse = c.speed = 0; /* of that tick alone */
    now[kept++] = c;
  }
  while (b < before_count) tell(world, &before[b++], SBR_EVENT_PARTED);
  all->contact_count = kept;
}

void sbri_meet_forget(sbr_world *world, uint32_t character) {
  sbri_meetings *all = world->meetings;
  uint32_t kept = 0;
  for (uint32_t i = 0; all && i < all->contact_count; i++) {
    const sbri_meet_contact *c = &all->contacts[i];
    if (c->names[0] >> 32 != character && c->names[1] >> 32 != character) all->contacts[kept++] = *c;
  }
  if (all) all->contact_count = kept;
}
