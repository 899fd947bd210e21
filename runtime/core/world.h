#ifndef SBRI_WORLD_H
#define SBRI_WORLD_H

#include "collide/colliders.h"
#include "core/recorder.h"
#include "core/state.h"
#include "rigid/rigid_work.h"

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
  struct sbri_meetings *meetings; /* meet/meetings.h; NULL: bodies of characters do not meet each other */
  struct sbri_detail *detail;     /* detail/choose.h; NULL: rungs are the host's */
  sbri_character *characters;     /* (character_capacity) */
  uint32_t character_capacity;
  sbri_work *work; /* (work_count) of this tick, character after character */
  size_t work_count, work_capacity;
  uint32_t sleep_ticks; /* of rest before sleep; 0: nothing sleeps */
  uint32_t awake_count; /* soft bodies stepped in the last tick */
  sbr_event events[SBRI_EVENTS];
  sbr_record_output record;        /* write NULL: it is not recorded */
  uint64_t recorded_at;            /* tick of the last hash in it */
  uint64_t event_head, event_tail; /* numbers of the next one written and read */
};

/* The character that the handle names; NULL: none. */
sbri_character *sbri_character_of(const sbr_world *world, sbr_character_id id);
sbr_character_id sbri_id_of(const sbr_world *world, const sbri_character *c);

/* Anew the list of work, of the characters that are awake; its memory is there already. */
void sbri_work_list(sbr_world *world);

/* ---- core/collider_host.c ---- */

bool sbri_collider_set_make(sbri_collider_set *set, uint32_t capacity, const sbf_allocator *allocator);
void sbri_collider_set_free(sbri_collider_set *set, const sbf_allocator *allocator);
sbr_collider_id sbri_collider_name(const sbri_collider_set *set, uint32_t number);

/* ---- core/step.c ---- */

void sbri_step_tick(sbr_world *world);
/* Of this tick; the event's place is the world's. */
void sbri_event_add(sbr_world *world, sbr_event event);

/* ---- core/island_run.c ---- */

/* One control tick of an island by itself. */
void sbri_island_run(const sbr_world *world, sbri_character *c, uint32_t island);
/* Planes of the ground near the island's points, into the character's scratch, as of now. */
void sbri_island_contacts(const sbr_world *world, sbri_character *c, uint32_t island);

/* What such a tick is put together from; `island` as sbri_island_now has it. */
sbri_island_tick sbri_island_tick_of(
    const sbr_world *world, sbri_character *c, uint32_t index, const sbri_island *island);
/* Inert lanes lie where their block's first point does, room for points that split where the body's does. */
void sbri_island_tuck(sbri_character *c, const sbri_island *island);
void sbri_island_prepare_contacts(const sbri_island_tick *tick, sbri_character *c);
/* Notes for events what its bodies touch, after a tick of it. */
void sbri_island_tell(const sbri_island_tick *tick, sbri_character *c);

/* ---- core/coupled.c ---- */

/* Soft bodies that pull on simulated rigid bodies: they are stepped along with these, in the character's own
 * task, not in one of their own. */
bool sbri_island_is_coupled(const sbri_character *c, uint32_t island);

typedef struct sbri_coupled {
  const sbr_world *world;
  sbri_character *character;
  const sbr_transform *animated; /* (frame_count) the pose at the tick's end but for what bodies move */
  bool any;                      /* soft body is coupled; set by sbri_coupled_begin, as: */
  uint32_t steps;                /* of the tick, that the soft bodies ask for */
} sbri_coupled;

/* A tick of them: what comes before it, before each step of the rigid parts (rigid_state.h), and after it. */
void sbri_coupled_begin(sbri_coupled *group);
void sbri_coupled_act(const sbri_coupled *group, const sbri_rigid_tick *tick, float from, float to);
void sbri_coupled_end(sbri_coupled *group);

/* ---- core/rigid_parts.c ---- */

/* A tick of a character's rigid parts on its way, with the soft bodies that are coupled to them. It stays
 * where it is until its end. */
typedef struct sbri_rigid_parts {
  sbri_coupled coupled;
  sbri_rigid_tick tick;
  sbri_rigid_solving work;
  bool steps; /* it has begun, and must be ended */
} sbri_rigid_parts;

/* What comes before the steps, whose number is tick.substeps, and after them; false where nothing is to be
 * stepped. The pose has all bones where they go when this is over. */
bool sbri_rigid_parts_begin(const sbr_world *world, sbri_character *c, sbri_rigid_parts *parts);
void sbri_rigid_parts_end(sbri_rigid_parts *parts);

/* ---- core/coupled.c ---- */

/* Whether all of them may go on sleeping, whether all are slow enough to begin to, and their beginning to. */
bool sbri_coupled_sleep(sbri_coupled *group);
bool sbri_coupled_are_quiet(const sbri_character *c);
void sbri_coupled_put_to_sleep(const sbr_world *world, sbri_character *c);

/* ---- core/sleep.c ---- */

/* Whether the island sleeps through this tick, whose frames are known; it wakes where it does not. */
bool sbri_island_sleeps(const sbr_world *world, sbri_character *c, uint32_t island);
/* After a tick of it; and the parts of that: whether it is slow enough, and that it sleeps from now on. */
void sbri_island_may_sleep(const sbr_world *world, sbri_character *c, uint32_t island);
bool sbri_island_is_quiet(const sbri_character *c, uint32_t island);
void sbri_island_put_to_sleep(const sbr_world *world, sbri_character *c, uint32_t island);
/* Whether the character sleeps through this tick; and whether it would if its gait stood still. */
bool sbri_character_sleeps(const sbr_world *world, sbri_character *c);
bool sbri_character_may_sleep(const sbr_world *world, const sbri_character *c);
/* Before a tick of the gait, and after it: whether it has left everything as it was. */
void sbri_character_keep_gait(sbri_character *c);
bool sbri_character_is_still(const sbri_character *c);

/* ---- core/folded.c ---- */

/* How an island looks as it now is. */
typedef struct sbri_shape {
  bool folded;    /* it has lost its shape, and will not find it again by itself should that last */
  bool heaped;    /* so strained that it was thrown about or put so */
  bool wild;      /* the same, or not yet back from there */
  float excess_j; /* what it holds beyond its rest shape; 0: not looked at */
  bool told;      /* all that loads it is known, so that no load is what strains it */
} sbri_shape;
sbri_shape sbri_shape_of(const sbr_world *world, const sbri_character *c, uint32_t island);

/* ---- core/recovery.c ---- */

/* After a tick: calms what is wild, and puts into its rest shape what has lost its numbers or its shape for
 * good. */
void sbri_island_recover(const sbr_world *world, sbri_character *c, uint32_t island);

/* ---- core/health.c ---- */

/* Volume within a body's surface as `points` of its character lie; uses scratch of the body's own island, so
 * that tasks may call it side by side. */
double sbri_surface_volume(const sbri_character *c, const sbri_body *body, const sbri_point *points);

/* One region of shape matching: adds its energy; the greatest way of a point from its place, as a share of
 * the region's size. */
double sbri_region_look(const sbri_region_block *block, const sbri_region_member *members, uint32_t lane,
    const sbri_point *positions, double *energy_j);

sbri_gait_input sbri_gait_input_of(const sbr_world *world, const sbri_character *c);

#endif
