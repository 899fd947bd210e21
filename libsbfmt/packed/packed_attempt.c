#include "packed/packed_attempt.h"

bool sbfi_packed_try(sbfi_packed_attempt *attempt, sbfi_packed_coder *coder, const void *items, size_t size,
    uint32_t stride, sbfi_packed_filter filter, size_t capacity) {
  size_t smaller, limit = attempt->size ? attempt->size - 1 : capacity;
  sbfi_coded coded =
      sbfi_packed_deflate(coder, items, size, filter, stride / 4, attempt->spare, limit, &smaller);
  if (coded != SBFI_CODED) return coded != SBFI_CODED_NO_MEMORY;
  *attempt = (sbfi_packed_attempt){attempt->spare, attempt->best, smaller, filter};
  return true;
}

bool sbfi_packed_best_filter(
    sbfi_packed_coder *coder, const void *items, size_t size, uint32_t stride, sbfi_packed_filter *filter) {
  uint8_t memory[2][SBFI_PACKED_CHUNK_FROM_COMPRESSED];
  sbfi_packed_attempt attempt = {.best = memory[0], .spare = memory[1]};
  bool fits = true;
  for (int f = SBFI_FILTER_NONE; f <= SBFI_FILTER_DELTA && fits; f++)
    fits = sbfi_packed_try(&attempt, coder, items, size, stride, (sbfi_packed_filter)f, size - 1);
  *filter = attempt.filter;
  return fits;
}
