/* Mends what can be mended without a choice: source parts first, then what is derived from them is made
 * again. */
#include <string.h>

#include "validate/mend/mending.h"

static sbf_fix_options options_of(const sbf_fix_options *given) {
  sbf_fix_options options = {0};
  size_t size = given && given->struct_size && given->struct_size < sizeof options ? given->struct_size
                                                                                   : sizeof options;
  if (given) memcpy(&options, given, size);
  return options;
}

static void take_first(void *user, const sbf_diagnostic *diagnostic) {
  *(sbf_diagnostic *)user = *diagnostic;
}

/* Source parts come first: what is derived from them is made again at the end. */
static sbf_status run(sbfi_mending *m, sbf_diagnostic *error) {
  static void (*const passes[])(sbfi_mending *) = {sbfi_mend_rotations, sbfi_mend_weights,
      sbfi_mend_tetrahedra, sbfi_mend_winding, sbfi_mend_points, sbfi_mend_mesh_points, sbfi_mend_pins,
      sbfi_mend_springs, sbfi_mend_blends};
  sbf_diagnostic first;
  for (size_t i = 0; i < sizeof passes / sizeof *passes && !m->out_of_memory; i++) {
    sbfi_arena_init(&m->scratch, m->options->allocator, 0);
    passes[i](m);
    sbfi_arena_free(&m->scratch);
  }
  if (m->out_of_memory) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while mending");
  if (sbf_asset_check(m->asset, take_first, &first, 1)) {
    if (error) *error = first;
    return sbf_code_find(first.code)->fault;
  }
  return m->options->without_build ? SBF_OK : sbfi_mend_derived(m, error);
}

sbf_status sbf_fix(const sbf_asset *asset, const sbf_fix_options *given, sbf_asset **fixed,
    sbf_fix_result *result, sbf_diagnostic *error) {
  sbf_fix_result unseen;
  sbf_fix_options options = options_of(given);
  sbfi_mending m = {.options = &options, .result = result ? result : &unseen};
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
