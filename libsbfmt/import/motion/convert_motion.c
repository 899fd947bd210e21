/* Reads a file with motion and retargets its clips; motion/ does the retargeting. */
#include <string.h>

#include "base/diagnostic.h"
#include "model/options.h"
#include "motion/retargeting.h"
#include "sbfmt/convert.h"
#include "sbfmt/io.h"

static bool is_bundle(const char *path) {
  size_t length = strlen(path);
  return (length > 4 && strcmp(path + length - 4, ".sbf") == 0) ||
         (length > 5 && strcmp(path + length - 5, ".sbfz") == 0);
}

/* Drops messages about a motion file's own meshes and gait. */
static void forward_report(void *user, const sbf_diagnostic *diagnostic) {
  if (diagnostic->code == SBF_CODE_IMPORT_KEYS || diagnostic->severity == SBF_SEVERITY_ERROR)
    sbfi_report(user, diagnostic);
}

static sbf_status read_motion(const char *file, const sbf_convert_options *options, sbfi_reporter *reporter,
    sbf_asset **from, sbf_diagnostic *error) {
  if (is_bundle(file))
    return sbf_load_file(file, &(sbf_load_options){.allocator = options->allocator}, from, error);
  const sbf_convert_options reading = {.allocator = options->allocator,
      .no_gait = true,
      .import_helper = options->import_helper,
      .report = forward_report,
      .user = reporter};
  return sbf_convert(file, &reading, from, error);
}

sbf_status sbf_convert_motion(
    sbf_asset *asset, const char *file, const sbf_convert_options *options, sbf_diagnostic *error) {
  sbf_convert_options taken = {.struct_size = 0};
  if (!sbfi_options_copy(&taken, sizeof taken, options))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbf_convert_options has a size that no version of the library had: initialize it with the defaults");
  sbfi_reporter reporter = {taken.report, taken.user, 0, 0};
  sbf_asset *from = NULL;
  if (asset->bones.count == 0)
    return sbfi_diagnose(
        error, SBF_CODE_IMPORT_MOTION_NONE, "%s: there is no skeleton to move: add one with --rig", file);
  sbf_status status = read_motion(file, &taken, &reporter, &from, error);
  if (status != SBF_OK) return status;
  status = sbfi_retarget_clips(asset, from, file, taken.allocator, &reporter, error);
  sbf_asset_free(from);
  return status;
}
