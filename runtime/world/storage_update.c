/* Allocates and frees memory of characters, on one thread before a tick changes anything. Characters that are
 * about to change their detail level get storage for it; characters that begin to simulate rigid parts get
 * solver memory. Unused memory is kept for a while, so that frequent changes do not allocate. */
#include "world/detail/detail_levels.h"
#include "world/step.h"

/* Time after which unused memory is freed, and time between attempts after a failed allocation. */
static const float KEPT_S = 1, RETRY_S = 0.5f;

/* Reports the failure to the host. */
static void report_refusal(sbr_world *world, sbri_character *c, sbr_memory_use use) {
  c->refused_ticks = sbri_ticks_of(world, RETRY_S);
  sbr_memory_event event = {.tick = world->time.ticks, .character = sbri_id_of(world, c), .use = use};
  sbri_event_add(world, SBRI_EVENT_MEMORY_REFUSED, &event);
}

static bool is_old(const sbr_world *world, uint32_t *ticks) {
  return (*ticks)++ >= sbri_ticks_of(world, KEPT_S);
}

/* Without storage a character stays at its detail level. */
static void update_storage(sbr_world *world, sbri_character *c) {
  sbri_character_state *head = sbri_header(c);
  const sbr_model *next = sbri_next_detail_model(c);
  if (next == c->model) {
    if (c->spare.model && is_old(world, &c->spare_ticks))
      sbri_character_storage_free(&world->allocator, &c->spare);
    return;
  }
  c->spare_ticks = 0;
  if (c->spare.model == next) return;
  sbri_character_storage_free(&world->allocator, &c->spare);
  if (c->refused_ticks == 0 && !sbri_character_storage_create(&world->allocator, next, &c->spare))
    report_refusal(world, c, SBR_MEMORY_DETAIL_LEVEL);
  if (c->spare.model) return;
  head->fade_kept = 0;
  if (!head->set_detail_level_plus_1) head->next_detail_level = head->detail_level; /* selection repeats */
}

/* Without solver memory, rigid parts do not move (coupling/ragdoll/rigid_parts.c). */
static void update_rigid_storage(sbr_world *world, sbri_character *c) {
  size_t size = c->model->layout.rigid.work_size;
  if (sbri_rigid_drive(c)->any_dynamic) {
    c->rigid_ticks = 0;
    if (c->rigid_work || c->refused_ticks > 0) return;
    c->rigid_work = sbfi_allocate(&world->allocator, size);
    if (!c->rigid_work) report_refusal(world, c, SBR_MEMORY_RIGID_BODIES);
  } else if (c->rigid_work && is_old(world, &c->rigid_ticks)) {
    sbri_rigid_work_free(&world->allocator, c);
  }
}

void sbri_character_storage_update(sbr_world *world) {
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    sbri_character *c = &world->characters[i];
    if (!c->model || sbri_header(c)->paused) continue;
    if (c->refused_ticks > 0) c->refused_ticks--;
    if (c->model->rigid.body_count) update_rigid_storage(world, c);
    if (c->model->detail.base->detail.level_count > 1) update_storage(world, c);
  }
}
