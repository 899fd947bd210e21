/* A world: characters by handle, colliders, contacts, events and recording. */
#ifndef SBRI_WORLD_H
#define SBRI_WORLD_H

#include "sbrun/debug.h"
#include "sbrun/events.h"
#include "shapes/colliders.h"
#include "state/recorder.h"
#include "state/state.h"

/* Events of the last step: an array for each kind. */
typedef enum sbri_event_kind {
  SBRI_EVENT_CONTACT_BEGIN,
  SBRI_EVENT_CONTACT_END,
  SBRI_EVENT_CONTACT_HIT,
  SBRI_EVENT_FOOT_DOWN,
  SBRI_EVENT_FOOT_UP,
  SBRI_EVENT_LANDED,
  SBRI_EVENT_TORN,
  SBRI_EVENT_UNSPLIT,
  SBRI_EVENT_ASLEEP,
  SBRI_EVENT_AWAKE,
  SBRI_EVENT_DETAIL_CHANGED,
  SBRI_EVENT_MEMORY_REFUSED,
  SBRI_EVENT_KINDS
} sbri_event_kind;

typedef struct sbri_events {
  void *at[SBRI_EVENT_KINDS]; /* (capacity) each, of the kind's public struct */
  uint32_t counts[SBRI_EVENT_KINDS];
  uint32_t capacity;
  uint32_t lost; /* events without space */
} sbri_events;

/* Time is counted in units of 2^-32 s, so that frames add up without rounding. */
#define SBRI_TIME_UNITS 4294967296.0

/* About a microsecond, in those units: a shorter remainder does not cause a tick. */
enum { SBRI_TIME_SLACK = 4096 };

/* Task of the island stage: one island of one character. */
typedef struct sbri_work {
  uint32_t character, island;
  bool is_divided; /* among tasks of its own, after all others */
} sbri_work;

/* Islands to step in this tick, character after character. */
typedef struct sbri_work_queue {
  sbri_work *at; /* (count) */
  size_t count, capacity;
} sbri_work_queue;

/* Simulated time, in ticks and in the units of frames. */
typedef struct sbri_world_time {
  double tick_s;
  int64_t tick_units, longest_units;
  uint64_t ticks;
  int64_t ahead_units; /* time of the last tick minus the sampled time; may be less by SBRI_TIME_SLACK */
  uint64_t stamp;      /* number of the sampled time, from 1 */
} sbri_world_time;

/* Processor time, by the host's clock. */
typedef struct sbri_world_timing {
  sbr_clock clock;     /* now_s NULL: no timing */
  sbr_profile profile; /* of the last tick that was timed */
} sbri_world_timing;

typedef struct sbri_recording {
  sbr_record_output output; /* write NULL: no recording */
  uint64_t hashed_at_tick;  /* tick of the last recorded hash */
} sbri_recording;

struct sbr_world {
  sbf_allocator allocator;
  sbr_tasks tasks;
  sbr_ground ground;
  bool has_gravity;
  sbf_vec3 gravity;
  sbri_world_time time;
  sbri_collider_set colliders;
  struct sbri_body_contacts
      *body_contacts; /* coupling/body_contact/body_contacts.h; NULL: no contacts between characters */
  struct sbri_detail *detail; /* world/detail/choose.h; NULL: the host sets detail levels */
  sbri_character *characters; /* (character_capacity) */
  uint32_t character_capacity;
  sbri_work_queue work;
  uint32_t sleep_ticks; /* ticks at rest before sleep; 0: no sleep */
  uint32_t awake_count; /* soft bodies stepped in the last tick */
  sbri_events events;
  float hit_speed; /* m/s */
  sbri_world_timing timing;
  sbri_recording recording;
  void *user_data; /* the host's */
};

/* ---- state/character_pool.c ---- */

/* Returns the character of a handle; NULL if it is invalid. */
sbri_character *sbri_character_of(const sbr_world *world, sbr_character_id id);
sbr_character_id sbri_id_of(const sbr_world *world, const sbri_character *c);

sbr_collider_id sbri_collider_name(const sbri_collider_set *set, uint32_t number);

/* Rebuilds the list of islands of awake characters. Does not allocate. */
void sbri_work_list(sbr_world *world);

/* ---- state/events.c ---- */

bool sbri_events_create(sbri_events *events, uint32_t capacity, const sbf_allocator *allocator);
void sbri_events_free(sbri_events *events, const sbf_allocator *allocator);
void sbri_events_clear(sbri_events *events);
/* Copies an event: the public struct of its kind. */
void sbri_event_add(sbr_world *world, sbri_event_kind kind, const void *event);

#endif
