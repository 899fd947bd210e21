/* Events of a step: an array of fixed capacity for each kind. */
#include <string.h>

#include "state/world.h"

static const size_t event_sizes[SBRI_EVENT_KINDS] = {[SBRI_EVENT_CONTACT_BEGIN] = sizeof(sbr_contact_event),
    [SBRI_EVENT_CONTACT_END] = sizeof(sbr_contact_event),
    [SBRI_EVENT_CONTACT_HIT] = sizeof(sbr_contact_event),
    [SBRI_EVENT_FOOT_DOWN] = sizeof(sbr_foot_event),
    [SBRI_EVENT_FOOT_UP] = sizeof(sbr_foot_event),
    [SBRI_EVENT_LANDED] = sizeof(sbr_foot_event),
    [SBRI_EVENT_TORN] = sizeof(sbr_soft_body_event),
    [SBRI_EVENT_UNSPLIT] = sizeof(sbr_soft_body_event),
    [SBRI_EVENT_ASLEEP] = sizeof(sbr_soft_body_event),
    [SBRI_EVENT_AWAKE] = sizeof(sbr_soft_body_event),
    [SBRI_EVENT_DETAIL_CHANGED] = sizeof(sbr_detail_event),
    [SBRI_EVENT_MEMORY_REFUSED] = sizeof(sbr_memory_event)};

bool sbri_events_create(sbri_events *events, uint32_t capacity, const sbf_allocator *allocator) {
  *events = (sbri_events){.capacity = capacity};
  for (int k = 0; k < SBRI_EVENT_KINDS; k++) {
    events->at[k] = sbfi_allocate(allocator, capacity * event_sizes[k]);
    if (events->at[k]) continue;
    sbri_events_free(events, allocator);
    return false;
  }
  return true;
}

void sbri_events_free(sbri_events *events, const sbf_allocator *allocator) {
  for (int k = 0; k < SBRI_EVENT_KINDS; k++)
    sbfi_free(allocator, events->at[k], events->capacity * event_sizes[k]);
}

void sbri_events_clear(sbri_events *events) {
  memset(events->counts, 0, sizeof events->counts);
  events->lost = 0;
}

void sbri_event_add(sbr_world *world, sbri_event_kind kind, const void *event) {
  sbri_events *events = &world->events;
  if (events->counts[kind] == events->capacity) {
    events->lost++;
    return;
  }
  size_t size = event_sizes[kind];
  memcpy((char *)events->at[kind] + events->counts[kind]++ * size, event, size);
}

/* ---- Public calls: sbrun/events.h ---- */

sbr_contact_events sbr_world_get_contact_events(const sbr_world *world) {
  if (!world) return (sbr_contact_events){0};
  const sbri_events *e = &world->events;
  return (sbr_contact_events){.begin = e->at[SBRI_EVENT_CONTACT_BEGIN],
      .end = e->at[SBRI_EVENT_CONTACT_END],
      .hit = e->at[SBRI_EVENT_CONTACT_HIT],
      .begin_count = e->counts[SBRI_EVENT_CONTACT_BEGIN],
      .end_count = e->counts[SBRI_EVENT_CONTACT_END],
      .hit_count = e->counts[SBRI_EVENT_CONTACT_HIT]};
}

sbr_foot_events sbr_world_get_foot_events(const sbr_world *world) {
  if (!world) return (sbr_foot_events){0};
  const sbri_events *e = &world->events;
  return (sbr_foot_events){.down = e->at[SBRI_EVENT_FOOT_DOWN],
      .up = e->at[SBRI_EVENT_FOOT_UP],
      .landed = e->at[SBRI_EVENT_LANDED],
      .down_count = e->counts[SBRI_EVENT_FOOT_DOWN],
      .up_count = e->counts[SBRI_EVENT_FOOT_UP],
      .landed_count = e->counts[SBRI_EVENT_LANDED]};
}

sbr_tear_events sbr_world_get_tear_events(const sbr_world *world) {
  if (!world) return (sbr_tear_events){0};
  const sbri_events *e = &world->events;
  return (sbr_tear_events){.torn = e->at[SBRI_EVENT_TORN],
      .unsplit = e->at[SBRI_EVENT_UNSPLIT],
      .torn_count = e->counts[SBRI_EVENT_TORN],
      .unsplit_count = e->counts[SBRI_EVENT_UNSPLIT]};
}

sbr_sleep_events sbr_world_get_sleep_events(const sbr_world *world) {
  if (!world) return (sbr_sleep_events){0};
  const sbri_events *e = &world->events;
  return (sbr_sleep_events){.asleep = e->at[SBRI_EVENT_ASLEEP],
      .awake = e->at[SBRI_EVENT_AWAKE],
      .asleep_count = e->counts[SBRI_EVENT_ASLEEP],
      .awake_count = e->counts[SBRI_EVENT_AWAKE]};
}

sbr_detail_events sbr_world_get_detail_events(const sbr_world *world) {
  if (!world) return (sbr_detail_events){0};
  const sbri_events *e = &world->events;
  return (sbr_detail_events){
      .changed = e->at[SBRI_EVENT_DETAIL_CHANGED], .changed_count = e->counts[SBRI_EVENT_DETAIL_CHANGED]};
}

sbr_memory_events sbr_world_get_memory_events(const sbr_world *world) {
  if (!world) return (sbr_memory_events){0};
  const sbri_events *e = &world->events;
  return (sbr_memory_events){
      .refused = e->at[SBRI_EVENT_MEMORY_REFUSED], .refused_count = e->counts[SBRI_EVENT_MEMORY_REFUSED]};
}

uint32_t sbr_world_count_lost_events(const sbr_world *world) {
  return world ? world->events.lost : 0;
}
