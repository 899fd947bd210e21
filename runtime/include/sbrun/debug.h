/* Debugging: times by stage of a tick, counters, drawing of the state, and checks. Reading changes nothing,
 * and the motion is the same with a clock and without. Threads: as in sbrun/sbrun.h. */
#ifndef SBRUN_DEBUG_H
#define SBRUN_DEBUG_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The host's clock: seconds from any origin, never decreasing. The world calls it on the thread that steps
 * it.
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

/* Lower case with underscores, such as "broad_phase"; "" for a number that is not a stage. */
SBF_API const char *sbr_stage_get_name(sbr_stage stage);

/* Part of a tick. */
typedef struct sbr_time_span {
  double begin_s;    /* of the host's clock */
  double duration_s; /* from there */
} sbr_time_span;

/* Times of the last control tick by the host's clock; zeros without a clock, and before the first tick with
 * one. */
typedef struct sbr_profile {
  uint64_t tick;                         /* its number, from 1 */
  sbr_time_span whole;                   /* the tick */
  sbr_time_span stages[SBR_STAGE_COUNT]; /* its stages; all worker threads together count once */
} sbr_profile;

/* Times the ticks from now on; a clock without now_s stops that. Clears the profile. */
SBF_API void sbr_world_set_clock(sbr_world *world, sbr_clock clock);
SBF_API sbr_profile sbr_world_get_profile(const sbr_world *world);

/* Contents of the world after its last tick. */
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

/* Counts the contents; takes time in proportion to the points. */
SBF_API sbr_counters sbr_world_get_counters(const sbr_world *world);

/* ---- Drawing ---- */

/* Parts of a world that sbr_world_draw shows. */
typedef enum sbr_draw_part {
  SBR_DRAW_BONES = 1 << 0,        /* from head to tail */
  SBR_DRAW_SURFACES = 1 << 1,     /* edges of the surfaces of soft bodies, a colour per island */
  SBR_DRAW_SPRINGS = 1 << 2,      /* blue at -20 % strain or less, grey at rest, red at +20 % or more */
  SBR_DRAW_TETRAHEDRA = 1 << 3,   /* edges, a colour per island */
  SBR_DRAW_RIGID_BODIES = 1 << 4, /* edges of hulls: grey kinematic, orange passive, green driven */
  SBR_DRAW_JOINTS = 1 << 5,    /* axes of both frames; limits as cones, arcs and segments; position error */
  SBR_DRAW_CONTACTS = 1 << 6,  /* points, and normals as long as the impulse times `impulse_m` */
  SBR_DRAW_BOUNDS = 1 << 7,    /* boxes around islands, along the world's axes, a colour per island */
  SBR_DRAW_GAIT = 1 << 8,      /* feet, where each comes down or stands, and the poles of knees */
  SBR_DRAW_COLLIDERS = 1 << 9, /* edges of the host's shapes; of the host's own geometry its bounds */
  SBR_DRAW_ALL = (1 << 10) - 1
} sbr_draw_part;

/* The host's drawing functions. Colours are 0xRRGGBB; islands that sleep are grey. */
typedef struct sbr_debug_draw {
  uint32_t cookie; /* set by sbr_default_debug_draw */
  void (*line)(void *user, sbr_double3 from, sbr_double3 to, uint32_t color);         /* NULL: no lines */
  void (*point)(void *user, sbr_double3 position, float size_pixels, uint32_t color); /* NULL: no points */
  void *user;                                                                         /* the host's */
  uint32_t parts;  /* sum of sbr_draw_part; default SBR_DRAW_ALL */
  float impulse_m; /* length of a contact's line, m per N s; default 0.1; at most a metre is drawn */
} sbr_debug_draw;
/* Begin with the default, which draws nothing until `line` or `point` is set. */
SBF_API sbr_debug_draw sbr_default_debug_draw(void);

/* Draws the state after the last tick through the functions of `draw`, in world metres, in an order that is
 * the same in every run. The ground is not drawn: the host has it. Takes time in proportion to what is drawn.
 * A world or `draw` that is NULL, or a wrong cookie, draws nothing. */
SBF_API void sbr_world_draw(const sbr_world *world, const sbr_debug_draw *draw);

/* ---- Checking ---- */

/* Checks the state between two steps: numbers are finite, rotations have unit length, indices are in range,
 * handles are alive, lists are sorted and within their capacities. SBF_FAILED with WORLD_INVALID, with the
 * location of the first error, if something is wrong: an error of the runtime. Takes time in proportion to
 * the state. NULL is valid. */
SBF_API sbf_status sbr_world_validate(const sbr_world *world, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif

#endif
