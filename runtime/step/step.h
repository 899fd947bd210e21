/* One control tick of a world, from the top down: step.c has its order. */
#ifndef SBRI_STEP_H
#define SBRI_STEP_H

#include "world/world.h"

/* ---- step/step.c ---- */

void sbri_step_tick(sbr_world *world);

/* ---- step/rooms.c ---- */

/* When it is known who goes over to which rung, by one thread: memory for what this tick needs, and back what
 * is of no use. */
void sbri_rooms_tend(sbr_world *world);

/* ---- step/rebase.c ---- */

/* Moves the origin by whole metres to where the character is, and everything the other way. */
void sbri_character_rebase(sbri_character *c);

/* ---- step/character_sleep.c ---- */

/* Whether the character sleeps through this tick; and whether it would if its gait stood still. */
bool sbri_character_sleeps(const sbr_world *world, sbri_character *c);
bool sbri_character_may_sleep(const sbr_world *world, const sbri_character *c);
/* Before a tick of the gait, and after it: whether it has left everything as it was. */
void sbri_character_keep_gait(sbri_character *c);
bool sbri_character_is_still(const sbri_character *c);

/* ---- step/character_tick.c ---- */

/* It steps along with others whom it meets: step/group_run.c. */
bool sbri_character_is_grouped(const sbr_world *world, const sbri_character *c);
/* Everything of a character but the soft bodies that are stepped by themselves. */
void sbri_character_tick(sbr_world *world, sbri_character *c);

/* ---- step/group_run.c ---- */

struct sbri_contact_group;
/* The tick of a group, after its characters' gaits. */
void sbri_group_run(sbr_world *world, struct sbri_contact_group *group);

/* ---- step/tick_events.c ---- */

/* What all characters have met with in this tick, as events. */
void sbri_tick_events_gather(sbr_world *world);
/* Counts who was stepped, and tells who has fallen asleep or woken. */
void sbri_tick_sleep_note(sbr_world *world);

#endif
