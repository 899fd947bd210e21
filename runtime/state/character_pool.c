/* Characters of a world by handle, and the work list of a tick. */
#include "base/assert.h"
#include "state/world.h"

enum { INDEX_BITS = 16 };

sbri_character *sbri_character_of(const sbr_world *world, sbr_character_id id) {
  uint32_t index = (id.value & 0xffff) - 1;
  if (!world || id.value == 0 || index >= world->character_capacity) return NULL;
  sbri_character *c = &world->characters[index];
  return c->model && c->generation == id.value >> INDEX_BITS ? c : NULL;
}

sbr_character_id sbri_id_of(const sbr_world *world, const sbri_character *c) {
  SBF_ASSERT(c->model && c >= world->characters && c < world->characters + world->character_capacity);
  return (sbr_character_id){c->generation << INDEX_BITS | (uint32_t)(c - world->characters + 1)};
}

sbr_collider_id sbri_collider_name(const sbri_collider_set *set, uint32_t number) {
  SBF_ASSERT(number < set->capacity && set->at[number].shape);
  return (sbr_collider_id){set->at[number].generation << INDEX_BITS | (number + 1)};
}

void sbri_work_list(sbr_world *world) {
  world->work.count = 0;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbr_model *model = world->characters[i].model;
    bool steps =
        model && !sbri_header(&world->characters[i])->paused && !sbri_header(&world->characters[i])->asleep;
    for (uint32_t k = 0; steps && k < model->island_count; k++)
      SBF_ASSERT(world->work.count < world->work.capacity),
          world->work.at[world->work.count++] = (sbri_work){i, k, false};
  }
}
