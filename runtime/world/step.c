/* Steps a world by one control tick: first the characters' animation, then contacts between characters, then
 * soft-body islands. Each stage is a set of tasks; then come a few large islands, one by one, each divided
 * among tasks. No task writes what another task reads, so the result has the same bits for any number of
 * threads and any order. */
#include <string.h>

#include "coupling/body_contact/body_contacts.h"
#include "coupling/ragdoll/ragdoll.h"
#include "math/vec3.h"
#include "soft/soft.h"
#include "soft/solvers/scheme.h"
#include "soft/tear/tear.h"
#include "world/detail/choose.h"
#include "world/stage_clock.h"
#include "world/step.h"

static void tick_character(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_character_tick(world, &world->characters[index]);
}

/* Runs before the broad phase, which needs the final detail level of every character. */
static void change_detail_level(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_character *c = &world->characters[index];
  if (!c->model || sbri_header(c)->paused || sbri_header(c)->asleep) return;
  sbri_detail_level_change(world, c);
  sbri_contact_surfaces_select_level(world, index);
}

/* With more large islands than this, each island is one task, because tasks of a divided island wait for each
 * other. */
enum { MAX_DIVIDED = 4 };

static bool is_stepped_alone(const sbr_world *world, const sbri_work *work) {
  sbri_character *c = &world->characters[work->character];
  return !sbri_character_is_grouped(world, c) && !sbri_island_is_coupled(c, work->island);
}

static void tick_island(void *context, uint32_t index) {
  sbr_world *world = context;
  const sbri_work *work = &world->work.at[index];
  if (!work->is_divided && is_stepped_alone(world, work))
    sbri_island_run(world, &world->characters[work->character], work->island, NULL);
}

/* Marks the large islands whose work is divided. */
static uint32_t mark_divided(sbr_world *world) {
  uint32_t count = 0;
  for (uint32_t i = 0; world->tasks.run && i < world->work.count; i++) {
    sbri_work *work = &world->work.at[i];
    work->is_divided = is_stepped_alone(world, work) &&
                       sbri_island_may_divide(&world->characters[work->character], work->island);
    count += work->is_divided;
  }
  if (count <= MAX_DIVIDED) return count;
  for (uint32_t i = 0; i < world->work.count; i++) world->work.at[i].is_divided = false;
  return 0;
}

static void tick_group(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_group_run(world, &world->body_contacts->groups[index]);
}

static void run(sbr_world *world, sbr_task *task, size_t count) {
  if (world->tasks.run)
    world->tasks.run(world->tasks.user, task, world, (uint32_t)count);
  else
    for (uint32_t i = 0; i < count; i++) task(world, i);
}

static void follow_tears(sbr_world *world) {
  for (uint32_t i = 0; i < world->work.count; i++) {
    sbri_character *c = &world->characters[world->work.at[i].character];
    uint32_t island = world->work.at[i].island;
    if (c->model->islands[island].splits && sbri_tears_of(c)[island].count > 0) sbri_skins_follow(c, island);
  }
}

void sbri_step_tick(sbr_world *world) {
  world->time.ticks++;
  sbri_stages_begin(world);
  sbri_colliders_begin_tick(&world->colliders, world->time.tick_s);
  sbri_stage_end(world, SBR_STAGE_COLLIDERS);
  if (world->body_contacts) sbri_near_characters_find(world);
  if (world->detail) sbri_detail_choose(world);
  sbri_character_storage_update(world);
  if (world->body_contacts) run(world, change_detail_level, world->character_capacity);
  sbri_stage_end(world, SBR_STAGE_DETAIL);
  if (world->body_contacts) sbri_broad_phase_update(world);
  sbri_stage_end(world, SBR_STAGE_BROAD_PHASE);
  run(world, tick_character, world->character_capacity);
  sbri_stage_end(world, SBR_STAGE_ANIMATION);
  if (world->body_contacts) {
    run(world, tick_group, world->body_contacts->group_count);
    sbri_contacts_store(world);
  }
  sbri_stage_end(world, SBR_STAGE_CONTACT_GROUPS);
  sbri_work_list(world);
  uint32_t divided_count = mark_divided(world);
  if (divided_count < world->work.count) run(world, tick_island, world->work.count);
  for (uint32_t i = 0; divided_count > 0 && i < world->work.count; i++) {
    const sbri_work *work = &world->work.at[i];
    if (work->is_divided)
      sbri_island_run(world, &world->characters[work->character], work->island, &world->tasks);
  }
  sbri_stage_end(world, SBR_STAGE_ISLANDS);
  follow_tears(world);
  sbri_tick_events_gather(world);
  if (world->body_contacts) sbri_pair_reports_publish(world);
  sbri_tick_report_sleep(world);
  sbri_stage_end(world, SBR_STAGE_EVENTS);
}
