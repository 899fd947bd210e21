#include "level_description.h"

#include <stdio.h>
#include <string.h>

static json_t *integer(uint64_t value) {
  return json_integer((json_int_t)value);
}

static json_t *measured(float value) {
  return value > 0 ? json_real((double)value) : json_null();
}

static json_t *numbers(sbf_f32_list list) {
  json_t *array = json_array();
  for (uint32_t i = 0; i < list.count; i++) json_array_append_new(array, json_real((double)list.at[i]));
  return array;
}

static json_t *calibration_of(const sbf_level *level) {
  const sbf_calibration *c = level->calibration;
  if (!c) return json_null();
  return json_pack("{s:o, s:f, s:f, s:f, s:f, s:o, s:o}", "reference_elements",
      integer(c->reference_elements), "factor", (double)c->factor, "surface_factor",
      (double)c->surface_factor, "residual", (double)c->residual, "period_error", (double)c->period_error,
      "load_errors", numbers(c->load_errors), "twist_errors", numbers(c->twist_errors));
}

json_t *level_description(const sbf_soft_body *body) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < body->levels.count; i++) {
    const sbf_level *level = &body->levels.at[i];
    uint64_t springs = 0;
    for (uint32_t s = 0; s < level->springs.count; s++) springs += level->springs.at[s].ends.count;
    json_array_append_new(
        list, json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "name",
                  level->name ? level->name : "", "model", sbf_elastic_model_name(level->model), "tetrahedra",
                  integer(level->lattice.tetrahedra.count), "springs", integer(springs), "error",
                  measured(level->simulation.error), "cost", measured(level->simulation.cost), "motion_error",
                  measured(level->simulation.motion_error), "motion_error_rms",
                  measured(level->simulation.motion_error_rms), "calibration", calibration_of(level)));
  }
  return list;
}

static double real(const json_t *object, const char *key) {
  return json_number_value(json_object_get(object, key));
}

void level_description_print(const json_t *level, char *text, size_t size) {
  const json_t *calibration = json_object_get(level, "calibration");
  const char *name = json_string_value(json_object_get(level, "name"));
  const char *model = json_string_value(json_object_get(level, "model"));
  long long tetrahedra = (long long)real(level, "tetrahedra"), springs = (long long)real(level, "springs");
  double residual = json_is_object(calibration) ? 100 * real(calibration, "residual") : 0;
  char parts[64] = "", error[64] = "", moving[64] = "", cost[64] = "", left[64] = "";
  if (!model) model = "";
  if (tetrahedra > 0)
    snprintf(parts, sizeof parts, "%lld tetrahedra", tetrahedra);
  else if (springs > 0)
    snprintf(parts, sizeof parts, "%lld springs", springs);
  if (real(level, "error") > 0) snprintf(error, sizeof error, ", within %.3g m", real(level, "error"));
  if (real(level, "motion_error") > 0)
    snprintf(moving, sizeof moving, ", within %.3g m as it moves", real(level, "motion_error"));
  if (real(level, "cost") > 0) snprintf(cost, sizeof cost, ", %.0f visits a tick", real(level, "cost"));
  if (json_is_object(calibration))
    snprintf(
        left, sizeof left, residual < 10 ? ", calibrated to %.2g %%" : ", calibrated to %.0f %%", residual);
  /* The counts imply whether a level has springs or tetrahedra. */
  bool implied = *parts && strcmp(model, tetrahedra > 0 ? "tetrahedra" : "springs") == 0;
  bool named = name && *name && strcmp(name, model) != 0;
  snprintf(text, size, "%s%s%s%s%s%s%s%s%s", named ? name : "", named ? ": " : "", implied ? "" : model,
      implied || !*parts ? "" : ", ", parts, error, moving, left, cost);
}
