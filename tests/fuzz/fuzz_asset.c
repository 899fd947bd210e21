#include "fuzz_asset.h"

#include "fuzz.h"

sbf_load_options fuzz_load_options(void) {
  return (sbf_load_options){
      .limits = {
          .file_bytes = 1 << 24, .memory_bytes = 1 << 26, .inflated_bytes = 1 << 26, .list_items = 1 << 22}};
}

void fuzz_check_load(
    sbf_status status, sbf_asset *asset, const sbf_diagnostic *error, fuzz_save *save, fuzz_load *load) {
  if (status != SBF_OK) {
    FUZZ_MUST(!asset);
    FUZZ_MUST(error->code != 0 && error->message[0]);
    return;
  }
  FUZZ_MUST(asset && sbf_asset_check(asset, NULL, NULL, 1) == 0);
  sbf_buffer buffer = {0};
  sbf_asset *again = NULL;
  sbf_diagnostic trouble;
  FUZZ_MUST(save(asset, NULL, NULL, &buffer, &trouble) == SBF_OK);
  FUZZ_MUST(load(buffer.at, buffer.size, NULL, &again, &trouble) == SBF_OK);
  FUZZ_MUST(sbf_asset_equal(asset, again, NULL, 0));
  sbf_asset_free(again);
  sbf_buffer_free(&buffer);
  sbf_asset_free(asset);
}
