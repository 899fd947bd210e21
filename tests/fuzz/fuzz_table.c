/* The packed form behind its checksums: magic, size and checksums are mended first, so that what changes in
 * header, table and records reaches the checks that lie behind them. */
#include <string.h>

#include "fuzz.h"
#include "fuzz_asset.h"
#include "packed/packed_format.h"
#include "packed_patch.h"

enum { AT_FILE_SIZE = 16 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size < SBFI_PACKED_HEADER_SIZE) return 0;
  uint8_t *repaired = malloc(size); /* the table's entries are read from it, aligned as a mapped file is */
  FUZZ_MUST(repaired);
  memcpy(repaired, data, size);
  memcpy(repaired, SBFI_PACKED_MAGIC, 8);
  patch_put(repaired, AT_FILE_SIZE, 8, size);
  patch_seal(repaired, size);
  sbf_load_options options = fuzz_load_options();
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  options.check_crc = true;
  sbf_status status = sbf_packed_load_memory(repaired, size, &options, &asset, &error);
  fuzz_check_load(status, asset, &error, sbf_packed_save_memory, sbf_packed_load_memory);
  fuzz_check_outline(repaired, size);
  free(repaired);
  return 0;
}
