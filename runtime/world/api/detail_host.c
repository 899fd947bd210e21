/* Public calls for the selection of detail levels: sbrun/detail.h. */
#include "base/diagnostic.h"
#include "math/usable.h"
#include "world/api/api.h"
#include "world/detail/choose.h"

enum { DETAIL_COOKIE = 0x5b726474 };

sbr_detail_definition sbr_default_detail_definition(void) {
  return (sbr_detail_definition){.cookie = DETAIL_COOKIE,
      .error_px = 0.5f,
      .ns_per_visit = 6,
      .coarsen_fraction = 0.7f,
      .stay_s = 0.5f,
      .offscreen_after_s = 1};
}

void sbri_detail_free(sbr_world *world) {
  sbri_detail *detail = world->detail;
  if (!detail) return;
  size_t count = world->character_capacity;
  sbfi_free(&world->allocator, detail->choices, count * sizeof *detail->choices);
  sbfi_free(&world->allocator, detail->savings, count * sizeof *detail->savings);
  sbfi_free(&world->allocator, detail, sizeof *detail);
  world->detail = NULL;
}

static bool make(sbr_world *world) {
  size_t count = world->character_capacity;
  sbri_detail *detail = sbfi_allocate(&world->allocator, sizeof *detail);
  if (!detail) return false;
  *detail = (sbri_detail){.choices = sbfi_allocate(&world->allocator, count * sizeof *detail->choices),
      .savings = sbfi_allocate(&world->allocator, count * sizeof *detail->savings)};
  world->detail = detail;
  if (detail->choices && detail->savings) return true;
  sbri_detail_free(world);
  return false;
}

sbf_status sbr_world_select_detail_levels(
    sbr_world *world, const sbr_detail_definition *definition, sbf_diagnostic *error) {
  if (!world || !definition)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_world_select_detail_levels: NULL argument");
  if (definition->cookie != DETAIL_COOKIE)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_world_select_detail_levels: begin the definition with sbr_default_detail_definition");
  if (!(definition->error_px > 0) || !(definition->ns_per_visit > 0) || !(definition->coarsen_fraction > 0) ||
      definition->coarsen_fraction > 1 || !(definition->budget_us >= 0) || !(definition->stay_s >= 0))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_world_select_detail_levels: error_px %g and ns_per_visit %g must be above 0, coarsen_fraction "
        "%g within "
        "(0, 1], "
        "budget_us "
        "%g and stay_s %g not below 0",
        (double)definition->error_px, (double)definition->ns_per_visit, (double)definition->coarsen_fraction,
        (double)definition->budget_us, (double)definition->stay_s);
  const double numbers[6] = {(double)definition->error_px, (double)definition->budget_us,
      (double)definition->ns_per_visit, (double)definition->coarsen_fraction, (double)definition->stay_s,
      (double)definition->offscreen_after_s};
  if (!sbri_usable(numbers, 6))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_world_select_detail_levels: error_px %g, budget_us %g, ns_per_visit %g, stay_s %g or "
        "offscreen_after_s %g is invalid: use finite numbers up to 1e15",
        numbers[0], numbers[1], numbers[2], numbers[4], numbers[5]);
  if (!world->detail && !make(world))
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory to choose levels of detail");
  world->detail->is = *definition;
  return SBF_OK;
}

void sbri_view_set(sbr_world *world, uint32_t index, uint32_t count, const sbr_view *view) {
  const double numbers[11] = {index, count, view->eye.x, view->eye.y, view->eye.z, (double)view->forward.x,
      (double)view->forward.y, (double)view->forward.z, (double)view->height_rad, (double)view->width_ratio,
      (double)view->lines};
  if (!sbri_record(world, SBRI_RECORDED_VIEW, numbers)) return;
  if (!world->detail) return;
  world->detail->eye_count = count < SBR_MAX_VIEWS ? count : SBR_MAX_VIEWS;
  if (index < world->detail->eye_count) world->detail->eyes[index] = sbri_eye_of(view);
}

void sbr_world_set_views(sbr_world *world, const sbr_view *views, uint32_t count) {
  static const sbr_view none = {{0, 0, 0}, {0, 0, 1}, 1, 1, 1};
  if (!world || !world->detail) return;
  if (!views || count == 0) sbri_view_set(world, 0, 0, &none);
  for (uint32_t i = 0; views && i < count && i < SBR_MAX_VIEWS; i++)
    sbri_view_set(world, i, count < SBR_MAX_VIEWS ? count : SBR_MAX_VIEWS, &views[i]);
}

void sbr_character_set_visibility(sbr_world *world, sbr_character_id character, sbr_visibility visibility) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  sbri_record(world, SBRI_RECORDED_VISIBILITY, (const double[]){character.value, visibility});
  sbri_header(c)->visibility = (uint32_t)visibility;
}

float sbr_character_get_error_px(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  if (!c || !world->detail) return 0;
  float error =
      c->model->detail.base->detail.definitions[sbri_header(c)->next_detail_level].error_m * c->scale;
  return sbri_pixels_of(world, c) * sbri_speed_factor(c) * error;
}

double sbr_world_get_element_visits(const sbr_world *world) {
  return world && world->detail ? world->detail->visits : 0;
}
