/* Rebuilds stale derived parts with their original settings. Parts of other programs, or with unknown
 * settings, stay unchanged. */
#include <string.h>

#include "build/build_settings.h"
#include "build/source_reading.h"
#include "validate/repair/repair.h"

/* A build replaces all derived parts, so it works only if there is one derivation, made by this program. */
static const sbf_derivation *stale_derivation(
    const sbf_asset *asset, sbf_status *status, sbf_diagnostic *error) {
  char hash[SBFI_SHA256_TEXT_SIZE];
  const sbf_derivation *only = asset->derivations.at;
  if (asset->derivations.count != 1 || !*only->source_hash || strncmp(only->tool, "sbfmt ", 6) != 0)
    return NULL;
  *status = sbfi_build_source_hash(asset, hash, error);
  return *status == SBF_OK && strcmp(hash, only->source_hash) != 0 ? only : NULL;
}

sbf_status sbfi_repair_derived(sbfi_repair *m, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  sbf_build_options options = {.allocator = m->options->allocator};
  sbf_asset *built;
  sbf_diagnostic refused;
  const sbf_derivation *stale = stale_derivation(m->asset, &status, error);
  if (!stale || !sbfi_build_settings_read(stale->settings, &options)) return status;
  status = sbf_build(m->asset, &options, &built, NULL, &refused);
  if (status == SBF_FAILED && error) *error = refused;
  /* parts that cannot be built stay stale */
  if (status != SBF_OK) return status == SBF_FAILED ? status : SBF_OK;
  if (strcmp(built->derivations.at[0].settings, stale->settings) != 0) {
    sbf_asset_free(built);
    return SBF_OK;
  }
  m->result->rebuilt = true;
  sbfi_count_repair(m, SBF_CODE_DERIVED_STALE, 1, "/sbf/derivations/derivation[1]", -1,
      "derived parts built again, with the settings %s", stale->settings);
  sbf_asset_free(m->asset);
  m->asset = built;
  return SBF_OK;
}
