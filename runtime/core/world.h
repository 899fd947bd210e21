#ifndef SBRI_WORLD_H
#define SBRI_WORLD_H

#include "core/state.h"

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
  sbri_character *characters; /* (character_capacity) */
  uint32_t character_capacity;
  sbri_work *work; /* (work_count) of all characters, in their order */
  size_t work_count, work_capacity;
  sbr_event events[SBRI_EVENTS];
  uint64_t event_head, event_tail; /* numbers of the next one written and read */
};

/* The character that the handle names; NULL: none. */
sbri_character *sbri_character_of(const sbr_world *world, sbr_character_id id);
sbr_character_id sbri_id_of(const sbr_world *world, const sbri_character *c);

/* Anew the list of work, after characters came or went; its memory is there already. */
void sbri_work_list(sbr_world *world);

/* ---- core/step.c ---- */

void sbri_step_tick(sbr_world *world);
/* core/folded.c: whether an island has lost its shape, as it now is. */
bool sbri_is_folded(const sbr_world *world, const sbri_character *c, uint32_t island);
sbri_gait_input sbri_gait_input_of(const sbr_world *world, const sbri_character *c);

#endif
