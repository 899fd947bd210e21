/* Public calls for detail levels: sbrun/detail.h. */
#include "state/world.h"

uint32_t sbr_model_get_detail_levels(
    const sbr_model *model, sbr_detail_level *detail_levels, uint32_t capacity) {
  if (!model) return 0;
  for (uint32_t r = 0; detail_levels && r < model->detail.level_count && r < capacity; r++)
    detail_levels[r] = model->detail.definitions[r];
  return model->detail.level_count;
}

uint32_t sbr_character_get_detail_level(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return c ? sbri_header(c)->next_detail_level : 0;
}

void sbr_character_set_detail_level(sbr_world *world, sbr_character_id character, uint32_t detail_level) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  sbri_record(world, SBRI_RECORDED_DETAIL_LEVEL, (const double[]){character.value, detail_level});
  uint32_t last = c->model->detail.base->detail.level_count - 1;
  if (detail_level != SBR_DETAIL_AUTOMATIC && detail_level > last) detail_level = last;
  sbri_header(c)->set_detail_level_plus_1 = detail_level + 1; /* 0: automatic */
  if (detail_level == SBR_DETAIL_AUTOMATIC) return;
  if (sbri_header(c)->next_detail_level != detail_level) sbri_character_wake(c);
  sbri_header(c)->next_detail_level = detail_level;
}

float sbr_character_get_detail_fade(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return !c ? 0 : sbri_header(c)->fade_kept ? 1 : sbri_header(c)->fade;
}
