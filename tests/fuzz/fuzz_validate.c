/* Either form, loaded and put before every rule of the validator. */
#include "fuzz.h"
#include "fuzz_asset.h"
#include "sbfmt/validate.h"

static void see(void *user, const sbf_diagnostic *diagnostic) {
  FUZZ_MUST(diagnostic->code != 0 && diagnostic->message[0] && diagnostic->path[0]);
  ++*(uint32_t *)user;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  sbf_asset *asset = fuzz_load_either(data, size);
  if (!asset) return 0;
  uint32_t listed = 0;
  sbf_validate_options options = {.report = see, .user = &listed};
  sbf_validate_result result = {0};
  sbf_diagnostic error = {0};
  FUZZ_MUST(sbf_validate(asset, &options, &result, &error) == SBF_OK);
  FUZZ_MUST(listed <= (uint64_t)result.errors + result.warnings + result.infos);
  sbf_asset_free(asset);
  return 0;
}
