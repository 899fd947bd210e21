#include "saving.h"

#include <string.h>

#include "checking.h"
#include "glb_images.h"
#include "output_name.h"
#include "sbfmt/export.h"

/* Images that are not embedded are in the input, if it is a .glb, or beside it. */
static sbf_status save_glb(const cli_call *call, const char *from, const char *out, const sbf_asset *asset,
    const sbf_asset *images, const sbf_save_options *options, sbf_diagnostic *error) {
  char folder[4096];
  const char *slash = strrchr(from, '/');
  int length = snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - from) : 1, slash ? from : ".");
  sbf_export_options to = {.soft_bodies = true,
      .store = options && options->store,
      .compression = options ? options->level : 0,
      .folder = length > 0 && (size_t)length < sizeof folder ? folder : NULL,
      .images = images ? &images->textures : NULL,
      .report = cli_report,
      .user = (void *)(uintptr_t)call};
  return sbf_export(asset, out, &to, error);
}

/* Saves a valid asset with the images of its input. */
static sbf_status save(const cli_call *call, const char *from, const char *out, const sbf_asset *asset,
    const sbf_save_options *options) {
  sbf_diagnostic error;
  sbf_asset *images = glb_images_load(from);
  bool to_glb = output_name_ends(out, ".glb");
  sbf_status status = to_glb ? save_glb(call, from, out, asset, images, options, &error)
                             : sbf_save_file(asset, out, options, &error);
  if (status != SBF_OK)
    cli_print_diagnostic(call, &error);
  else if (images && !to_glb && !glb_images_write(call, asset, images, out))
    status = SBF_FAILED;
  sbf_asset_free(images);
  return status;
}

int saving_run(const cli_call *call, const char *from, const char *out, const sbf_asset *asset,
    const sbf_save_options *options) {
  checked found = {.path = out};
  check_loaded(asset, out, &found);
  sbf_status status = found.status;
  if (checked_is_valid(&found, false)) {
    status = save(call, from, out, asset, options);
  } else {
    unsigned errors = found.result.errors;
    if (status == SBF_OK) status = SBF_BAD_INPUT;
    checked_report(call, &found, NULL);
    cli_wrong(call,
        "%s was not written: the result for %s has %u error%s, listed above; repair the input there", out,
        from, errors, errors == 1 ? "" : "s");
  }
  findings_free(&found.found);
  return (int)status;
}
