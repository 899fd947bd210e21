/* Rungs as hosts know them: sbrun/detail.h. */
#include "world/world.h"

uint32_t sbr_model_rungs(const sbr_model *model, sbr_rung *rungs, uint32_t capacity) {
  if (!model) return 0;
  for (uint32_t r = 0; rungs && r < model->rung_count && r < capacity; r++) rungs[r] = model->ladder[r];
  return model->rung_count;
}

uint32_t sbr_character_rung(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return c ? sbri_head(c)->next_rung : 0;
}

void sbr_character_set_rung(sbr_world *world, sbr_character_id character, uint32_t rung) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  sbri_record(world, SBRI_RECORDED_RUNG, (const double[]){character.value, rung});
  uint32_t last = c->model->base->rung_count - 1;
  if (rung != SBR_RUNG_CHOSEN && rung > last) rung = last;
  sbri_head(c)->set_rung_plus_1 = rung + 1; /* 0: chosen */
  if (rung == SBR_RUNG_CHOSEN) return;
  if (sbri_head(c)->next_rung != rung) sbri_character_wake(c);
  sbri_head(c)->next_rung = rung;
}

float sbr_character_fade(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return !c ? 0 : sbri_head(c)->fade_kept ? 1 : sbri_head(c)->fade;
}
