/* A world: its characters by handle, what they meet, what happened, and what is recorded of it. */
#ifndef SBRI_WORLD_H
#define SBRI_WORLD_H

#include "collide/colliders.h"
#include "sbrun/debug.h"
#include "world/recorder.h"
#include "world/state.h"

enum { SBRI_EVENTS = 256 };

/* Time is counted in parts of 2^-32 s, so that frames add up without rounding. */
#define SBRI_TIME_UNITS 4294967296.0

/* Of those, about a microsecond: a tick that would only cover so little is left for later. */
enum { SBRI_TIME_SLACK = 4096 };

/* One island of one character: what a task steps. */
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
  int64_t
      ahead_units; /* by how much the last tick lies beyond the sampled moment; may lag by SBRI_TIME_SLACK */
  uint64_t stamp;  /* counts sampled moments; from 1 */
  sbri_collider_set colliders;
  struct sbri_body_contacts
      *body_contacts; /* body_contact/body_contacts.h; NULL: bodies of characters do not meet each other */
  struct sbri_detail *detail; /* detail/choose.h; NULL: rungs are the host's */
  sbri_character *characters; /* (character_capacity) */
  uint32_t character_capacity;
  sbri_work *work; /* (work_count) of this tick, character after character */
  size_t work_count, work_capacity;
  uint32_t sleep_ticks; /* of rest before sleep; 0: nothing sleeps */
  uint32_t awake_count; /* soft bodies stepped in the last tick */
  sbr_event events[SBRI_EVENTS];
  sbr_clock clock;                 /* now_s NULL: ticks are not timed */
  sbr_profile profile;             /* of the last tick that was timed */
  sbr_record_output record;        /* write NULL: it is not recorded */
  uint64_t recorded_at;            /* tick of the last hash in it */
  uint64_t event_head, event_tail; /* numbers of the next one written and read */
};

/* ---- world/roster.c ---- */

/* The character that the handle names; NULL: none. */
sbri_character *sbri_character_of(const sbr_world *world, sbr_character_id id);
sbr_character_id sbri_id_of(const sbr_world *world, const sbri_character *c);

sbr_collider_id sbri_collider_name(const sbri_collider_set *set, uint32_t number);

/* Anew the list of work, of the characters that are awake; its memory is there already. */
void sbri_work_list(sbr_world *world);

/* ---- world/events.c ---- */

/* Of this tick; the event's place is the world's. */
void sbri_event_add(sbr_world *world, sbr_event event);

#endif
