/* Levels of detail: those of models, and worlds that select among them. */
#include <string.h>

#include "sbrun/detail.h"
#include "web.h"

/* Four numbers per detail level: kind, level, error, visits. Returns the number of levels. */
uint32_t WEB_CALL(web_model_detail_levels)(const sbr_model *model, float *to, uint32_t capacity) {
  enum { MAX = 64 };
  sbr_detail_level detail_levels[MAX];
  uint32_t count = sbr_model_get_detail_levels(model, detail_levels, MAX);
  for (uint32_t i = 0; i < count && i < capacity && i < MAX; i++, to += 4) {
    const float numbers[4] = {(float)detail_levels[i].kind, (float)detail_levels[i].level,
        detail_levels[i].error_m, detail_levels[i].visits};
    memcpy(to, numbers, sizeof numbers);
  }
  return count < MAX ? count : MAX;
}

uint32_t WEB_CALL(web_character_detail_level)(const sbr_world *world, uint32_t character) {
  return sbr_character_get_detail_level(world, (sbr_character_id){character});
}
/* SBR_DETAIL_AUTOMATIC: the world selects. */
void WEB_CALL(web_character_set_detail_level)(sbr_world *world, uint32_t character, uint32_t detail_level) {
  sbr_character_set_detail_level(world, (sbr_character_id){character}, detail_level);
}
float WEB_CALL(web_character_fade)(const sbr_world *world, uint32_t character) {
  return sbr_character_get_detail_fade(world, (sbr_character_id){character});
}
void WEB_CALL(web_character_shown)(sbr_world *world, uint32_t character, uint32_t shown) {
  sbr_character_set_visibility(world, (sbr_character_id){character}, (sbr_visibility)shown);
}
float WEB_CALL(web_character_error_px)(const sbr_world *world, uint32_t character) {
  return sbr_character_get_error_px(world, (sbr_character_id){character});
}

/* Six numbers, in the order of sbr_detail_definition; NaN keeps the default. */
uint32_t WEB_CALL(web_world_detail)(sbr_world *world, const float *from) {
  sbr_detail_definition definition = sbr_default_detail_definition();
  float *const fields[6] = {&definition.error_px, &definition.budget_us, &definition.ns_per_visit,
      &definition.coarsen_fraction, &definition.stay_s, &definition.offscreen_after_s};
  memset(web_failure(), 0, sizeof(sbf_diagnostic));
  for (int i = 0; i < 6; i++)
    if (from[i] == from[i]) *fields[i] = from[i];
  return sbr_world_select_detail_levels(world, &definition, web_failure()) == SBF_OK;
}
/* Nine numbers per view: eye, forward, height, aspect ratio, lines. */
void WEB_CALL(web_world_views)(sbr_world *world, const double *from, uint32_t count) {
  sbr_view views[SBR_MAX_VIEWS];
  for (uint32_t i = 0; i < count && i < SBR_MAX_VIEWS; i++, from += 9)
    views[i] = (sbr_view){.eye = {from[0], from[1], from[2]},
        .forward = {(float)from[3], (float)from[4], (float)from[5]},
        .height_rad = (float)from[6],
        .width_ratio = (float)from[7],
        .lines = (float)from[8]};
  sbr_world_set_views(world, views, count < SBR_MAX_VIEWS ? count : SBR_MAX_VIEWS);
}
double WEB_CALL(web_world_visits)(const sbr_world *world) {
  return sbr_world_get_element_visits(world);
}
