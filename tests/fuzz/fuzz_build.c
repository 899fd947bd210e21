/* The whole way: loaded, built with what the length of the input chooses, written in both forms, loaded
 * again. */
#include "fuzz.h"
#include "fuzz_asset.h"
#include "sbfmt/build.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  sbf_asset *asset = fuzz_load_either(data, size), *built = NULL;
  if (!asset) return 0;
  sbf_build_report report;
  sbf_diagnostic error = {0};
  /* Few elements and no reference of 16,000 for calibration: the inputs vary in shape, not in size. */
  const sbf_build_options options = {
      .interior = (sbf_build_interior)(size % (SBF_BUILD_INTERIOR_TETRAHEDRA + 1)),
      .elements = 200,
      .without_calibration = true};
  sbf_status status = sbf_build(asset, &options, &built, &report, &error);
  sbf_asset_free(asset); /* what was built shares nothing with it */
  if (status != SBF_OK) {
    fuzz_check_failure(status, built, &error);
    return 0;
  }
  fuzz_check_promises(built);
  fuzz_check_round_trip(built, sbf_xml_save_memory, sbf_xml_load_memory);
  fuzz_check_round_trip(built, sbf_packed_save_memory, sbf_packed_load_memory);
  sbf_asset_free(built);
  return 0;
}
