#include <stdio.h>
#include <string.h>

#include "model/schema.h"
#include "validate/mend/mending.h"

void sbfi_mended(sbfi_mending *m, sbf_code code, uint32_t count, const char *path, int64_t index,
    const char *format, ...) {
  sbf_diagnostic d;
  va_list arguments;
  if (count == 0) return;
  m->result->mended += count;
  if (!m->options->report) return;
  va_start(arguments, format);
  sbfi_diagnose_v(&d, code, format, arguments);
  va_end(arguments);
  sbfi_copy_text(d.path, sizeof d.path, path);
  d.index = index;
  m->options->report(m->options->user, &d);
}

void *sbfi_mending_scratch(sbfi_mending *m, size_t count, size_t size) {
  void *memory = sbfi_arena_allocate(&m->scratch, count ? count : 1, size);
  if (!memory) m->out_of_memory = true;
  return memory;
}

void sbfi_list_drop(void *list, size_t size, const uint8_t *dropped) {
  sbfi_list all;
  uint32_t kept = 0;
  memcpy(&all.at, list, sizeof all.at);
  memcpy(&all.count, (char *)list + sizeof all.at, sizeof all.count);
  char *items = sbfi_writable(all.at);
  for (uint32_t i = 0; i < all.count; i++) {
    if (dropped[i]) continue;
    if (kept != i) memcpy(items + kept * size, items + i * size, size);
    kept++;
  }
  if (kept == 0) all.at = NULL;
  memcpy(list, &all.at, sizeof all.at);
  memcpy((char *)list + sizeof all.at, &kept, sizeof kept);
}

void sbfi_colors_drop(sbf_u32_list *counts, const uint8_t *dropped, uint32_t count) {
  uint32_t *at = sbfi_writable(counts->at);
  uint64_t sum = 0;
  for (uint32_t c = 0; c < counts->count; c++) sum += at[c];
  if (sum != count) return; /* reported as it is */
  for (uint32_t c = 0, i = 0; c < counts->count; c++)
    for (uint32_t left = at[c]; left > 0; left--) at[c] -= dropped[i++];
}

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
