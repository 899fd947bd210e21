/* The packed form from memory. */
#include "fuzz.h"
#include "fuzz_asset.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  for (int crc = 0; crc < 2; crc++) { /* with the check sums compared, and with damage let through */
    sbf_load_options options = fuzz_load_options();
    sbf_asset *asset = NULL;
    sbf_diagnostic error = {0};
    options.check_crc = crc;
    sbf_status status = sbf_packed_load_memory(data, size, &options, &asset, &error);
    fuzz_check_load(status, asset, &error, sbf_packed_save_memory, sbf_packed_load_memory);
  }
  fuzz_check_outline(data, size);
  return 0;
}
