/* The XML form from memory. */
#include "fuzz.h"
#include "fuzz_asset.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  sbf_load_options options = fuzz_load_options();
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  sbf_status status = sbf_xml_load_memory(data, size, &options, &asset, &error);
  fuzz_check_load(status, asset, &error, sbf_xml_save_memory, sbf_xml_load_memory);
  return 0;
}
