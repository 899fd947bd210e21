/* What a world costs and what it holds: times by stage of a tick, and counters. Reading changes nothing, and
 * the motion is the same with a clock and without. Threads: as sbrun/sbrun.h. */
#ifndef SBRUN_DEBUG_H
#define SBRUN_DEBUG_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The host's clock: seconds since any moment, never falling. The world calls it on the thread that steps it.
 */
typedef struct sbr_clock {
  double (*now_s)(void *user); /* NULL: nothing is timed */
  void *user;                  /* the host's */
} sbr_clock;

/* Stages of a control tick, in their order. Each ends before the next begins. */
typedef enum sbr_stage {
  SBR_STAGE_COLLIDERS,   /* colliders move to where the host put them */
  SBR_STAGE_DETAIL,      /* levels of detail are selected and changed */
  SBR_STAGE_BROAD_PHASE, /* pairs of bodies whose bounds overlap, and groups of them */
  SBR_STAGE_ANIMATION, /* gait, inverse kinematics, clips, rigid parts; contacts with the ground are found */
  SBR_STAGE_CONTACT_GROUPS, /* characters in contact with each other are stepped */
  SBR_STAGE_ISLANDS,        /* all other soft bodies are stepped */
  SBR_STAGE_EVENTS,         /* tears of the skin, events, sleep */
  SBR_STAGE_COUNT
} sbr_stage;

/* Lower case with underscores, as "broad_phase"; "" for a number that is no stage. */
SBF_API const char *sbr_stage_name(sbr_stage stage);

/* Part of a tick. */
typedef struct sbr_time_span {
  double begin_s;    /* of the host's clock */
  double duration_s; /* from there */
} sbr_time_span;

/* The last control tick, as the host's clock saw it; zeros where the world has no clock or no tick was made
 * with it. */
typedef struct sbr_profile {
  uint64_t tick;                         /* its number, from 1 */
  sbr_time_span whole;                   /* the tick */
  sbr_time_span stages[SBR_STAGE_COUNT]; /* its stages; all worker threads together count once */
} sbr_profile;

/* Times the ticks from now on; a clock without now_s ends that. The profile so far is cleared. */
SBF_API void sbr_world_set_clock(sbr_world *world, sbr_clock clock);
SBF_API sbr_profile sbr_world_get_profile(const sbr_world *world);

/* What the world holds after its last tick. */
typedef struct sbr_counters {
  uint32_t character_count;       /* characters */
  uint32_t collider_count;        /* colliders of the host */
  uint32_t soft_body_count;       /* on their present levels of detail */
  uint32_t soft_body_awake_count; /* of them, stepped in the last tick */
  uint32_t rigid_body_count;      /* rigid bodies of characters, simulated or not */
  uint32_t island_count;          /* of soft bodies that are stepped together */
  uint32_t point_count;           /* free points of soft bodies */
  uint32_t spring_count;          /* springs, goals of pins included */
  uint32_t tetrahedron_count;     /* tetrahedra */
  uint32_t contact_count;         /* samples of awake soft bodies near ground, colliders or themselves */
  uint32_t body_contact_count;    /* pairs of bodies of characters in contact */
  uint64_t
      element_visit_count; /* passes over all elements of all bodies, since the characters were created */
  size_t state_bytes;      /* of characters: a snapshot's */
  size_t memory_bytes;     /* of characters: state and scratch */
} sbr_counters;

/* Counts anew; takes time in proportion to the points. */
SBF_API sbr_counters sbr_world_get_counters(const sbr_world *world);

#ifdef __cplusplus
}
#endif

#endif
