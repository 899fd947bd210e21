/* Repairs everything that has a unique repair: source parts first, then rebuilds what is derived from
 * them. */
#include <string.h>

#include "validate/repair/repair.h"

static sbf_fix_options options_of(const sbf_fix_options *given) {
  sbf_fix_options options = {0};
  size_t size = given && given->struct_size && given->struct_size < sizeof options ? given->struct_size
                                                                                   : sizeof options;
  if (given) memcpy(&options, given, size);
  return options;
}

static void store_first(void *user, const sbf_diagnostic *diagnostic) {
  *(sbf_diagnostic *)user = *diagnostic;
}

/* Source parts come first: derived parts are rebuilt at the end. */
static sbf_status run(sbfi_repair *m, sbf_diagnostic *error) {
  static void (*const passes[])(sbfi_repair *) = {sbfi_repair_rotations, sbfi_repair_weights,
      sbfi_repair_tetrahedra, sbfi_repair_winding, sbfi_repair_points, sbfi_repair_mesh_points,
      sbfi_repair_pins, sbfi_repair_springs, sbfi_repair_blends};
  sbf_diagnostic first;
  for (size_t i = 0; i < sizeof passes / sizeof *passes && !m->out_of_memory; i++) {
    sbfi_arena_init(&m->scratch, m->options->allocator, 0);
    passes[i](m);
    sbfi_arena_free(&m->scratch);
  }
  if (m->out_of_memory) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while repairing");
  if (sbf_asset_check(m->asset, store_first, &first, 1)) {
    if (error) *error = first;
    return sbf_code_find(first.code)->fault;
  }
  return m->options->without_build ? SBF_OK : sbfi_repair_derived(m, error);
}

sbf_status sbf_fix(const sbf_asset *asset, const sbf_fix_options *given, sbf_asset **fixed,
    sbf_fix_result *result, sbf_diagnostic *error) {
  sbf_fix_result ignored;
  sbf_fix_options options = options_of(given);
  sbfi_repair m = {.options = &options, .result = result ? result : &ignored};
  *fixed = NULL;
  *m.result = (sbf_fix_result){0};
  m.asset = sbf_asset_clone(asset, options.allocator);
  if (!m.asset) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for an asset");
  sbf_status status = run(&m, error);
  if (status == SBF_OK)
    *fixed = m.asset;
  else
    sbf_asset_free(m.asset);
  return status;
}
