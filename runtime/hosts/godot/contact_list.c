#include "contact_list.h"

#include "sbrun/collision.h"

static bool same_object(const sbr_object *a, const sbr_object *b) {
  return a->character.value == b->character.value && a->soft_body == b->soft_body &&
         a->rigid_body == b->rigid_body && a->collider.value == b->collider.value;
}

static uint32_t find(const contact_list *list, const sbr_contact_event *e) {
  uint32_t i = 0;
  while (i < list->count && !(same_object(&list->each[i].a, &e->a) && same_object(&list->each[i].b, &e->b)) &&
         !(same_object(&list->each[i].a, &e->b) && same_object(&list->each[i].b, &e->a)))
    i++;
  return i;
}

static void store(contact_list *list, const sbr_contact_event *e, bool begins) {
  uint32_t i = find(list, e);
  if (i < list->count)
    list->each[i] = *e;
  else if (begins && list->count < CONTACT_CAPACITY)
    list->each[list->count++] = *e;
}

static void drop(contact_list *list, uint32_t i) {
  list->each[i] = list->each[--list->count];
}

static bool is_gone(const sbr_world *world, const sbr_object *object) {
  return (object->character.value && !sbr_character_is_valid(world, object->character)) ||
         (object->collider.value && !sbr_collider_is_valid(world, object->collider));
}

/* Characters and colliders that are destroyed end their contacts without an event. A contact that begins and
 * ends within one step comes with both. */
void contact_list_update(contact_list *list, const sbr_world *world) {
  sbr_contact_events events = sbr_world_get_contact_events(world);
  for (uint32_t i = 0; i < list->count;)
    if (is_gone(world, &list->each[i].a) || is_gone(world, &list->each[i].b))
      drop(list, i);
    else
      i++;
  for (uint32_t i = 0; i < events.begin_count; i++) store(list, &events.begin[i], true);
  for (uint32_t i = 0; i < events.hit_count; i++) store(list, &events.hit[i], false);
  for (uint32_t i = 0; i < events.end_count; i++) {
    uint32_t at = find(list, &events.end[i]);
    if (at < list->count) drop(list, at);
  }
}
