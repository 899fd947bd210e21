/* Public calls for models. */
#include "base/diagnostic.h"
#include "math/usable.h"
#include "model/kernels.h"
#include "prepare/prepare.h"
#include "soft/solvers/scheme.h"
#include "state/state.h"

/* Maximum substeps of rigid parts per control tick. */
enum { MODEL_COOKIE = 0x5b726d6f, MAX_RIGID_SUBSTEPS = 1000 };

sbr_model_options sbr_default_model_options(void) {
  return (sbr_model_options){.cookie = MODEL_COOKIE};
}

static sbf_status check_options(const sbr_model_options *options, sbf_diagnostic *error) {
  if (options->cookie != MODEL_COOKIE)
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "sbr_model_create: begin the options with sbr_default_model_options");
  if (options->rigid_substeps > MAX_RIGID_SUBSTEPS)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_model_options: rigid_substeps is %u, at most %d",
        (unsigned)options->rigid_substeps, (int)MAX_RIGID_SUBSTEPS);
  const double numbers[4] = {(double)options->gravity.x, (double)options->gravity.y,
      (double)options->gravity.z, (double)options->step_error_m};
  if (!sbri_usable(numbers, options->has_gravity ? 3 : 0) || !sbri_usable(numbers + 3, 1))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_model_options: gravity %g %g %g m/s^2 or step_error_m %g is invalid: use finite numbers up to "
        "1e15",
        numbers[0], numbers[1], numbers[2], numbers[3]);
  if (!sbri_kernels_of(options->instructions)) {
    const char *name = sbr_instructions_get_name(options->instructions);
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "this processor or this library does not support the instructions %s: use automatic",
        name ? name : "of that number");
  }
  if (options->scheme == SBF_SCHEME_AUTOMATIC || sbri_scheme_of(options->scheme)) return SBF_OK;
  return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "scheme %s is not one of the runtime's: %s",
      sbf_scheme_name(options->scheme), sbri_scheme_names());
}

sbf_status sbr_model_create(
    const sbf_asset *asset, const sbr_model_options *options, sbr_model **model, sbf_diagnostic *error) {
  const sbr_model_options defaults = sbr_default_model_options();
  if (!asset || !model) return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_model_create: NULL argument");
  *model = NULL;
  if (!options) options = &defaults;
  sbf_status status = check_options(options, error);
  if (status == SBF_OK) status = sbri_number_limits_check(asset, error);
  if (status != SBF_OK) return status;
  sbf_allocator allocator = sbfi_allocator_or_default(options->allocator);
  sbr_model *made = sbfi_allocate(&allocator, sizeof *made);
  if (!made) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the model");
  *made = (sbr_model){.asset = asset, .kernels = sbri_kernels_of(options->instructions)};
  made->detail.base = made;
  sbfi_arena_init(&made->arena, &allocator, 0);
  status = sbri_model_prepare(made, options, error);
  if (status == SBF_OK) status = sbri_detail_levels_make(made, options, error);
  if (status != SBF_OK) {
    sbr_model_destroy(made);
    return status;
  }
  sbri_layouts_make(made);
  *model = made;
  return SBF_OK;
}

void sbr_model_destroy(sbr_model *model) {
  if (!model) return;
  sbf_allocator allocator = model->arena.allocator;
  sbri_detail_levels_free(model);
  sbfi_arena_free(&model->arena);
  sbfi_free(&allocator, model, sizeof *model);
}

sbr_instructions sbr_model_get_instructions(const sbr_model *model) {
  return model ? model->kernels->instructions : SBR_INSTRUCTIONS_AUTOMATIC;
}

static uint32_t substeps_at_rest(const sbri_island *island) {
  return sbri_scheme_substeps(island, 1.0 / 60, island->springs.rest_stretch);
}

uint32_t sbr_model_get_substeps(const sbr_model *model) {
  uint32_t max = 1;
  for (uint32_t i = 0; model && i < model->island_count; i++) {
    uint32_t substeps = substeps_at_rest(&model->islands[i]);
    max = substeps > max ? substeps : max;
  }
  return max;
}

uint32_t sbr_model_get_body_substeps(const sbr_model *model, uint32_t soft_body) {
  for (uint32_t i = 0; model && i < model->island_count; i++)
    for (uint32_t b = 0; b < model->islands[i].body_count; b++)
      if (model->islands[i].bodies[b] == soft_body) return substeps_at_rest(&model->islands[i]);
  return 0;
}
