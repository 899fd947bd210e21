#include "sbfmt/validate.h"

#include <stdio.h>
#include <string.h>

#include "validate/validation.h"

sbfi_path sbfi_path_of(const char *format, ...) {
  sbfi_path path;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(path.text, sizeof path.text, format, arguments);
  va_end(arguments);
  return path;
}

void sbfi_found(sbfi_validation *v, sbf_code code, const char *path, int64_t index, const char *format, ...) {
  sbf_diagnostic d;
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(&d, code, format, arguments);
  va_end(arguments);
  uint32_t *counts[] = {&v->result->errors, &v->result->warnings, &v->result->infos};
  ++*counts[d.severity];
  bool same = code == v->last_code && strcmp(path, v->last_path) == 0;
  v->run_length = same ? v->run_length + 1 : 1;
  v->last_code = code;
  sbfi_copy_text(v->last_path, sizeof v->last_path, path);
  if (v->run_length > v->repeats || !v->options->report) return;
  sbfi_copy_text(d.path, sizeof d.path, path);
  d.index = index;
  v->options->report(v->options->user, &d);
}

sbf_status sbf_validate(const sbf_asset *asset, const sbf_validate_options *options,
    sbf_validate_result *result, sbf_diagnostic *error) {
  static const sbf_validate_options defaults = {0};
  sbf_validate_result unseen;
  if (!options) options = &defaults;
  if (options->struct_size && options->struct_size != sizeof *options)
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "sbf_validate_options has another size than this library's");
  sbfi_validation v = {.asset = asset, .options = options, .result = result ? result : &unseen};
  v.repeats = options->repeats ? options->repeats : 8;
  *v.result = (sbf_validate_result){0};
  static void (*const families[])(sbfi_validation *) = {sbfi_check_surfaces, sbfi_check_lattices,
      sbfi_check_springs, sbfi_check_pins, sbfi_check_embeddings, sbfi_check_rig, sbfi_check_physics,
      sbfi_check_derived};
  for (size_t i = 0; i < sizeof families / sizeof *families && !v.out_of_memory; i++) {
    sbfi_arena_init(&v.scratch, options->allocator, 0);
    families[i](&v);
    sbfi_arena_free(&v.scratch);
  }
  if (v.out_of_memory) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while validating");
  return SBF_OK;
}
