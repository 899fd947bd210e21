/* A world: characters by handle, colliders, contacts, events and recording. */
#ifndef SBRI_WORLD_H
#define SBRI_WORLD_H

#include "collide/colliders.h"
#include "sbrun/debug.h"
#include "world/recorder.h"
#include "world/state.h"

enum { SBRI_EVENTS = 256 };

/* Time is counted in units of 2^-32 s, so that frames add up without rounding. */
#define SBRI_TIME_UNITS 4294967296.0

/* About a microsecond, in those units: a shorter remainder does not cause a tick. */
enum { SBRI_TIME_SLACK = 4096 };

/* Task of the island stage: one island of one character. */
typedef struct sbri_work {
  uint32_t character, island;
} sbri_work;

struct sbr_world {
  sbf_allocator allocator;
  sbr_tasks tasks;
  sbr_ground ground;
  bool has_gravity;
  sbf_vec3 gravity;
  double tick_s;
  int64_t tick_units, longest_units;
  uint64_t ticks;
  int64_t ahead_units; /* time of the last tick minus the sampled time; may be less by SBRI_TIME_SLACK */
  uint64_t stamp;      /* number of the sampled time, from 1 */
  sbri_collider_set colliders;
  struct sbri_body_contacts
      *body_contacts;         /* body_contact/body_contacts.h; NULL: no contacts between characters */
  struct sbri_detail *detail; /* detail/choose.h; NULL: the host sets detail levels */
  sbri_character *characters; /* (character_capacity) */
  uint32_t character_capacity;
  sbri_work *work; /* (work_count) of this tick, character after character */
  size_t work_count, work_capacity;
  uint32_t sleep_ticks; /* ticks at rest before sleep; 0: no sleep */
  uint32_t awake_count; /* soft bodies stepped in the last tick */
  sbr_event events[SBRI_EVENTS];
  sbr_clock clock;                 /* now_s NULL: no timing */
  sbr_profile profile;             /* of the last tick that was timed */
  sbr_record_output record;        /* write NULL: no recording */
  uint64_t recorded_at;            /* tick of the last recorded hash */
  void *user_data;                 /* the host's */
  uint64_t event_head, event_tail; /* sequence numbers of the next event to write and to read */
};

/* ---- world/character_pool.c ---- */

/* Returns the character of a handle; NULL if it is invalid. */
sbri_character *sbri_character_of(const sbr_world *world, sbr_character_id id);
sbr_character_id sbri_id_of(const sbr_world *world, const sbri_character *c);

sbr_collider_id sbri_collider_name(const sbri_collider_set *set, uint32_t number);

/* Rebuilds the list of islands of awake characters. Does not allocate. */
void sbri_work_list(sbr_world *world);

/* ---- world/events.c ---- */

/* Adds an event of this tick; its position is in world space. */
void sbri_event_add(sbr_world *world, sbr_event event);

#endif
