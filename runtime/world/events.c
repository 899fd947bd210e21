/* The last events of a world, in a ring. */
#include "world/world.h"

void sbri_event_add(sbr_world *world, sbr_event event) {
  event.tick = world->ticks;
  if (!event.other.value) event.other_rigid_body = -1;
  world->events[world->event_head++ % SBRI_EVENTS] = event;
}

uint32_t sbr_world_take_events(sbr_world *world, sbr_event *events, uint32_t capacity) {
  if (!world || !events) return 0;
  if (world->event_head - world->event_tail > SBRI_EVENTS)
    world->event_tail = world->event_head - SBRI_EVENTS;
  uint32_t count = 0;
  while (count < capacity && world->event_tail < world->event_head)
    events[count++] = world->events[world->event_tail++ % SBRI_EVENTS];
  return count;
}
