/* One control tick of a world. step.c has the order of the stages. */
#ifndef SBRI_STEP_H
#define SBRI_STEP_H

#include "state/world.h"

/* ---- world/step.c ---- */

void sbri_step_tick(sbr_world *world);

/* ---- world/storage_update.c ---- */

/* Allocates storage for detail levels that this tick needs and frees storage that has been unused for a
 * while. Runs after detail selection, on one thread. */
void sbri_character_storage_update(sbr_world *world);

/* ---- world/rebase.c ---- */

/* Moves the character's origin by whole metres to the character, and everything stored relative to it by the
 * opposite. Keeps float positions precise far from the world's origin. */
void sbri_character_rebase(sbri_character *c);

/* ---- world/character_sleep.c ---- */

/* Whether the character sleeps through this tick; and whether it could sleep if its gait did not move. */
bool sbri_character_sleeps(const sbr_world *world, sbri_character *c);
bool sbri_character_may_sleep(const sbr_world *world, const sbri_character *c);
/* Stores the gait's state before its tick; after it, returns whether the tick changed nothing. */
void sbri_character_store_gait(sbri_character *c);
bool sbri_character_is_still(const sbri_character *c);

/* ---- world/character_tick.c ---- */

/* Whether the character is in a contact group, which world/group_run.c steps as a whole. */
bool sbri_character_is_grouped(const sbr_world *world, const sbri_character *c);
/* Steps a character's gait, rigid bodies and frames. Soft bodies are stepped later, as islands. */
void sbri_character_tick(sbr_world *world, sbri_character *c);

/* ---- world/group_run.c ---- */

struct sbri_contact_group;
/* Steps all bodies of a contact group together, after the gaits of its characters. */
void sbri_group_run(sbr_world *world, struct sbri_contact_group *group);

/* ---- world/tick_events.c ---- */

/* Gathers the events of all characters in this tick. */
void sbri_tick_events_gather(sbr_world *world);
/* Counts the stepped characters and adds sleep and wake events. */
void sbri_tick_report_sleep(sbr_world *world);

#endif
