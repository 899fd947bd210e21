/* Events of several ticks in a row. A world keeps those of the last step only. */
#ifndef TEST_EVENT_LOG_H
#define TEST_EVENT_LOG_H

#include "sbrun/events.h"
#include "scenes.h"

enum { EVENT_LOG_CAPACITY = 256 };

typedef struct event_log {
  sbr_contact_event begin[EVENT_LOG_CAPACITY], end[EVENT_LOG_CAPACITY], hit[EVENT_LOG_CAPACITY];
  uint32_t begin_count, end_count, hit_count;
  sbr_soft_body_event torn[EVENT_LOG_CAPACITY], unsplit[EVENT_LOG_CAPACITY];
  uint32_t torn_count, unsplit_count;
  sbr_foot_event landed[EVENT_LOG_CAPACITY];
  uint32_t landed_count;
  uint32_t asleep_count, awake_count, detail_count, memory_count;
} event_log;

/* Runs `ticks` control ticks and appends their events. */
void scene_ticks_logged(scene *s, uint32_t ticks, event_log *log);
/* Appends the events of the world's last step. */
void event_log_add(event_log *log, const sbr_world *world);

#endif
