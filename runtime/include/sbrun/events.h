/* Events of a step: contacts, feet, tears, sleep, levels of detail, memory.
 *
 * Each kind has its own array, oldest first. A step empties the arrays when it begins and fills them with the
 * events of all its ticks; sbr_world_tick is a step of one tick. The arrays belong to the world: they are
 * valid until the next step and until the world is destroyed. Events are output: snapshots do not store them.
 * Their order does not depend on threads.
 *
 * Each array holds at most sbr_world_definition.event_capacity events; later ones of the step are lost and
 * counted. A world that is NULL has no events. */
#ifndef SBRUN_EVENTS_H
#define SBRUN_EVENTS_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Contacts ----------------------------------------------------------------------------------------- */

/* A contact of a body of a character with the ground, a collider, or another body
 * (sbr_world_enable_body_contacts). Two bodies give one event, in either order. */
typedef struct sbr_contact_event {
  uint64_t tick;        /* ticks since the world was created */
  sbr_object a;         /* a body of a character */
  sbr_object b;         /* the ground, a collider or another body */
  sbr_double3 position; /* world, m; of an ended contact: its last position */
  sbf_vec3 normal;      /* unit, from b towards a; of an ended contact: its last normal */
  float impulse;        /* N s along the normal in that tick, approximate; 0 at the end of a contact */
  float speed;          /* m/s: greatest closing speed in that tick; 0 at the end of a contact */
} sbr_contact_event;

/* Contacts of the last step. Sleeping bodies give none. Destroying a character or a collider ends its
 * contacts without events. A body reports contacts with at most 12 colliders at once. */
typedef struct sbr_contact_events {
  const sbr_contact_event *begin; /* (begin_count) new contacts */
  const sbr_contact_event *end;   /* (end_count) ended contacts */
  const sbr_contact_event
      *hit;             /* (hit_count) one per tick and pair, faster than sbr_world_definition.hit_speed */
  uint32_t begin_count; /* of `begin` */
  uint32_t end_count;   /* of `end` */
  uint32_t hit_count;   /* of `hit` */
} sbr_contact_events;
SBF_API sbr_contact_events sbr_world_get_contact_events(const sbr_world *world);

/* ---- Feet --------------------------------------------------------------------------------------------- */

/* A foot of the gait, or a landing of the whole character. */
typedef struct sbr_foot_event {
  uint64_t tick;              /* ticks since the world was created */
  sbr_character_id character; /* whose */
  uint32_t leg;               /* of the gait, from 0; 0 for a landing */
  sbr_double3 position;       /* world, m: of the foot; of a landing where the character will stand */
} sbr_foot_event;

/* Steps and landings of the last step. A landing: a character that fell from a height stands; or a fallen one
 * (sbr_character_knock_over) is at rest and begins to get up. */
typedef struct sbr_foot_events {
  const sbr_foot_event *down;   /* (down_count) set down */
  const sbr_foot_event *up;     /* (up_count) lifted */
  const sbr_foot_event *landed; /* (landed_count) landings */
  uint32_t down_count;          /* of `down` */
  uint32_t up_count;            /* of `up` */
  uint32_t landed_count;        /* of `landed` */
} sbr_foot_events;
SBF_API sbr_foot_events sbr_world_get_foot_events(const sbr_world *world);

/* ---- Soft bodies -------------------------------------------------------------------------------------- */

/* A change of a soft body. */
typedef struct sbr_soft_body_event {
  uint64_t tick;              /* ticks since the world was created */
  sbr_character_id character; /* whose */
  uint32_t soft_body;         /* of a tear: whose element; else the first body of the island */
  sbr_double3 position;       /* world, m */
} sbr_soft_body_event;

/* Tears of the last step. */
typedef struct sbr_tear_events {
  const sbr_soft_body_event *torn; /* (torn_count) an element tore; at most 16 a tick for one island */
  const sbr_soft_body_event
      *unsplit;           /* (unsplit_count) a tear could not split a point: increase tear_points */
  uint32_t torn_count;    /* of `torn` */
  uint32_t unsplit_count; /* of `unsplit` */
} sbr_tear_events;
SBF_API sbr_tear_events sbr_world_get_tear_events(const sbr_world *world);

/* Islands of bodies that fell asleep or woke in the last step. */
typedef struct sbr_sleep_events {
  const sbr_soft_body_event *asleep; /* (asleep_count) */
  const sbr_soft_body_event *awake;  /* (awake_count) */
  uint32_t asleep_count;             /* of `asleep` */
  uint32_t awake_count;              /* of `awake` */
} sbr_sleep_events;
SBF_API sbr_sleep_events sbr_world_get_sleep_events(const sbr_world *world);

/* ---- Detail and memory -------------------------------------------------------------------------------- */

/* A character changed its level of detail (sbrun/detail.h). */
typedef struct sbr_detail_event {
  uint64_t tick;              /* ticks since the world was created */
  sbr_character_id character; /* which */
  uint32_t from;              /* the detail level before */
  uint32_t to;                /* the detail level after */
} sbr_detail_event;

/* Changes of the last step. */
typedef struct sbr_detail_events {
  const sbr_detail_event *changed; /* (changed_count) */
  uint32_t changed_count;          /* of `changed` */
} sbr_detail_events;
SBF_API sbr_detail_events sbr_world_get_detail_events(const sbr_world *world);

/* What there was no memory for. It is tried again after half a second. */
typedef enum sbr_memory_use {
  SBR_MEMORY_DETAIL_LEVEL, /* a change of the level of detail, which is put off */
  SBR_MEMORY_RIGID_BODIES  /* simulated rigid bodies, which stand still */
} sbr_memory_use;

/* The world's allocator had no memory. */
typedef struct sbr_memory_event {
  uint64_t tick;              /* ticks since the world was created */
  sbr_character_id character; /* for which */
  sbr_memory_use use;         /* for what */
} sbr_memory_event;

/* Refusals of the last step. */
typedef struct sbr_memory_events {
  const sbr_memory_event *refused; /* (refused_count) */
  uint32_t refused_count;          /* of `refused` */
} sbr_memory_events;
SBF_API sbr_memory_events sbr_world_get_memory_events(const sbr_world *world);

/* Number of events of the last step that found no space in their arrays. */
SBF_API uint32_t sbr_world_count_lost_events(const sbr_world *world);

#ifdef __cplusplus
}
#endif
#endif
