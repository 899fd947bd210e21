#include "event_log.h"

#include <string.h>

#include "harness.h"

static void append(void *to, uint32_t *count, const void *from, uint32_t more, size_t size) {
  ck_assert_uint_le(*count + more, EVENT_LOG_CAPACITY);
  if (more) memcpy((char *)to + *count * size, from, more * size);
  *count += more;
}

#define APPEND(kind, events)                                                                                 \
  append(log->kind, &log->kind##_count, events.kind, events.kind##_count, sizeof log->kind[0])

void event_log_add(event_log *log, const sbr_world *world) {
  sbr_contact_events contacts = sbr_world_get_contact_events(world);
  APPEND(begin, contacts);
  APPEND(end, contacts);
  APPEND(hit, contacts);
  sbr_tear_events tears = sbr_world_get_tear_events(world);
  APPEND(torn, tears);
  APPEND(unsplit, tears);
  sbr_foot_events feet = sbr_world_get_foot_events(world);
  APPEND(landed, feet);
  sbr_sleep_events sleep = sbr_world_get_sleep_events(world);
  log->asleep_count += sleep.asleep_count, log->awake_count += sleep.awake_count;
  log->detail_count += sbr_world_get_detail_events(world).changed_count;
  log->memory_count += sbr_world_get_memory_events(world).refused_count;
  ck_assert_uint_eq(sbr_world_count_lost_events(world), 0);
}

void scene_ticks_logged(scene *s, uint32_t ticks, event_log *log) {
  for (uint32_t i = 0; i < ticks; i++) {
    scene_ticks(s, 1);
    event_log_add(log, s->world);
  }
}
