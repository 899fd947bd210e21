/* Chunks: three bytes say filter, scalars in an item and how much to expect; the rest is the stream. */
#include <string.h>

#include "fuzz.h"
#include "packed/packed_codec.h"

enum { FRONT = 4 };

static void round_trip(sbfi_packed_filter filter, uint32_t width, const uint8_t *raw, size_t raw_size) {
  sbfi_packed_coder coder;
  size_t capacity = raw_size + raw_size / 8 + 256, stored_size = 0;
  uint8_t *stored = malloc(capacity), *again = malloc(raw_size ? raw_size : 1);
  FUZZ_MUST(stored && again);
  sbfi_packed_coder_init(&coder, NULL, 1);
  sbfi_coded coded =
      sbfi_packed_deflate(&coder, raw, raw_size, filter, width, stored, capacity, &stored_size);
  /* The one that is for some lists only. */
  FUZZ_MUST(coded == SBFI_CODED || (coded == SBFI_CODED_TOO_LONG && filter == SBFI_FILTER_RECENT));
  if (coded == SBFI_CODED) {
    FUZZ_MUST(sbfi_packed_inflate(&coder, stored, stored_size, filter, width, again, raw_size) == SBFI_CODED);
    FUZZ_MUST(memcmp(raw, again, raw_size) == 0);
  }
  sbfi_packed_coder_free(&coder);
  free(stored);
  free(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size < FRONT) return 0;
  sbfi_packed_filter filter = (sbfi_packed_filter)(data[0] % SBFI_FILTER_COUNT);
  uint32_t width = 1 + data[1] % 4, unit = filter == SBFI_FILTER_NONE ? 1 : 4 * width;
  size_t raw_size = (data[2] | (size_t)data[3] << 8) * unit;
  uint8_t *raw = malloc(raw_size ? raw_size : 1); /* of the exact size: a byte beyond it is found */
  FUZZ_MUST(raw);
  sbfi_packed_coder coder;
  sbfi_packed_coder_init(&coder, NULL, 6);
  sbfi_coded coded = sbfi_packed_inflate(&coder, data + FRONT, size - FRONT, filter, width, raw, raw_size);
  FUZZ_MUST(coded == SBFI_CODED || coded == SBFI_CODED_DAMAGED);
  sbfi_packed_coder_free(&coder);
  if (coded == SBFI_CODED) round_trip(filter, width, raw, raw_size);
  free(raw);
  size_t whole = (size - FRONT) / unit * unit; /* and any bytes there and back */
  uint8_t *bytes = malloc(whole ? whole : 1);
  FUZZ_MUST(bytes);
  memcpy(bytes, data + FRONT, whole);
  round_trip(filter, width, bytes, whole);
  free(bytes);
  return 0;
}
