/* Characters as binary glTF from memory. */
#include "fuzz.h"
#include "fuzz_asset.h"
#include "sbfmt/gltf.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  sbf_load_options options = fuzz_load_options();
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  options.with_images = true;
  sbf_status status = sbf_gltf_load_memory(data, size, &options, &asset, &error);
  fuzz_check_load(status, asset, &error, sbf_packed_save_memory, sbf_packed_load_memory);
  return 0;
}
