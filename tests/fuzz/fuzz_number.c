/* Numbers as text: against the C library's own reading, and printed and read again. */
#include <errno.h>
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "fuzz.h"

enum { LONGEST = 4096 };

static void see_float(const char *text, size_t length) {
  float value = 0, again = 0;
  size_t used = 0;
  sbfi_number_status status = sbfi_scan_f32(text, length, &value, &used);
  FUZZ_MUST(used <= length);
  if (status == SBFI_NUMBER_MALFORMED) return;
  char copy[LONGEST + 1];
  memcpy(copy, text, used);
  copy[used] = 0;
  char *end;
  float theirs = strtof(copy, &end); /* reads all that we read, and more that we do not */
  FUZZ_MUST(end == copy + used);
  FUZZ_MUST((status == SBFI_NUMBER_OUT_OF_RANGE) == (bool)isinf(theirs));
  if (status != SBFI_NUMBER_READ) return;
  FUZZ_MUST(memcmp(&value, &theirs, sizeof value) == 0);
  char printed[SBFI_F32_TEXT_SIZE];
  size_t size = sbfi_print_f32(printed, value);
  FUZZ_MUST(size > 0 && size <= sizeof printed);
  FUZZ_MUST(sbfi_parse_f32(printed, size, &again) == SBFI_NUMBER_READ);
  FUZZ_MUST(memcmp(&value, &again, sizeof value) == 0);
}

static void see_integers(const char *text, size_t length) {
  int32_t whole;
  uint32_t natural;
  size_t used;
  char printed[SBFI_INTEGER_TEXT_SIZE], copy[LONGEST + 1];
  if (sbfi_scan_i32(text, length, &whole, &used) == SBFI_NUMBER_READ) {
    int32_t again;
    memcpy(copy, text, used);
    copy[used] = 0;
    FUZZ_MUST(strtoll(copy, NULL, 10) == whole);
    FUZZ_MUST(sbfi_parse_i32(printed, sbfi_print_i32(printed, whole), &again) == SBFI_NUMBER_READ);
    FUZZ_MUST(again == whole);
  }
  if (sbfi_scan_u32(text, length, &natural, &used) == SBFI_NUMBER_READ) {
    uint32_t again;
    memcpy(copy, text, used);
    copy[used] = 0;
    FUZZ_MUST(strtoll(copy, NULL, 10) == (long long)natural);
    FUZZ_MUST(sbfi_parse_u32(printed, sbfi_print_u32(printed, natural), &again) == SBFI_NUMBER_READ);
    FUZZ_MUST(again == natural);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size > LONGEST) return 0;
  see_float((const char *)data, size);
  see_integers((const char *)data, size);
  if (size < sizeof(float)) return 0;
  float any, again; /* and any four bytes as a number */
  char printed[SBFI_F32_TEXT_SIZE];
  memcpy(&any, data, sizeof any);
  size_t length = sbfi_print_f32(printed, any);
  FUZZ_MUST((length == 0) == !isfinite(any));
  if (length == 0) return 0;
  FUZZ_MUST(sbfi_parse_f32(printed, length, &again) == SBFI_NUMBER_READ);
  FUZZ_MUST(memcmp(&any, &again, sizeof any) == 0);
  return 0;
}
