/* Memory follows what characters do: before a tick changes anything each that is to go over to another detail
 * level gets room for it, and each that has begun to simulate rigid parts what these are solved in, one after
 * the other by one thread. What is no longer of use is kept for a while, so that who comes and goes asks for
 * nothing, and then given back. */
#include "detail/detail_levels.h"
#include "step/step.h"

/* What has not been of use for so long is given back; what there was no memory for is asked for again. */
static const float KEPT_S = 1, AGAIN_S = 0.5f;

/* The host hears of it. */
static void refuse(sbr_world *world, sbri_character *c, sbr_memory_use use) {
  c->refused_ticks = sbri_ticks_of(world, AGAIN_S);
  sbr_memory_event event = {.tick = world->ticks, .character = sbri_id_of(world, c), .use = use};
  sbri_event_add(world, SBRI_EVENT_MEMORY_REFUSED, &event);
}

static bool is_old(const sbr_world *world, uint32_t *ticks) {
  return (*ticks)++ >= sbri_ticks_of(world, KEPT_S);
}

/* Without room for it a character stays on its detail level. */
static void update_storage(sbr_world *world, sbri_character *c) {
  sbri_character_state *head = sbri_header(c);
  const sbr_model *ahead = sbri_next_detail_model(c);
  if (ahead == c->model) {
    if (c->spare.model && is_old(world, &c->spare_ticks))
      sbri_character_storage_free(&world->allocator, &c->spare);
    return;
  }
  c->spare_ticks = 0;
  if (c->spare.model == ahead) return;
  sbri_character_storage_free(&world->allocator, &c->spare);
  if (c->refused_ticks == 0 && !sbri_character_storage_create(&world->allocator, ahead, &c->spare))
    refuse(world, c, SBR_MEMORY_DETAIL_LEVEL);
  if (c->spare.model) return;
  head->fade_kept = 0;
  if (!head->set_detail_level_plus_1) head->next_detail_level = head->detail_level; /* it is chosen again */
}

/* Without it they stand still (ragdoll/rigid_parts.c). */
static void update_rigid_storage(sbr_world *world, sbri_character *c) {
  size_t size = c->model->layout.rigid_work_size;
  if (sbri_rigid_drive(c)->any) {
    c->rigid_ticks = 0;
    if (c->rigid_work || c->refused_ticks > 0) return;
    c->rigid_work = sbfi_allocate(&world->allocator, size);
    if (!c->rigid_work) refuse(world, c, SBR_MEMORY_RIGID_BODIES);
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
    if (c->model->base->detail_level_count > 1) update_storage(world, c);
  }
}
