#include "packed/packed_codec.h"

#include <stdlib.h>

#include "harness.h"
#include "packed/packed_filter.h"

enum { COUNT = 200000, BYTES = COUNT * 4 };

static uint32_t *ramp(void) {
  uint32_t *values = malloc(BYTES);
  /* Each four times, as the filter of repeated values needs them. */
  for (uint32_t i = 0; i < COUNT; i++) values[i] = i / 4 * 3 + (i / 4 * 2654435761u >> 29);
  return values;
}

START_TEST(test_every_filter_round_trips)
{
  uint32_t *values = ramp();
  uint8_t *stored = malloc(BYTES), *back = malloc(BYTES);
  sbfi_packed_coder coder;
  sbfi_packed_coder_init(&coder, NULL, 6);
  for (int filter = 0; filter < SBFI_FILTER_COUNT; filter++)
    for (size_t size = 8; size <= BYTES; size = size * 7 / 8 * 8) {
      size_t stored_size;
      sbfi_packed_filter f = (sbfi_packed_filter)filter;
      if (size > BYTES / 7) size = BYTES;
      ck_assert_int_eq(
          sbfi_packed_deflate(&coder, (uint8_t *)values, size, f, 2, stored, BYTES, &stored_size),
          SBFI_CODED);
      memset(back, 0xee, BYTES);
      ck_assert_int_eq(sbfi_packed_inflate(&coder, stored, stored_size, f, 2, back, size), SBFI_CODED);
      ck_assert_mem_eq(back, values, size);
      if (size < BYTES) ck_assert_uint_eq(back[size], 0xee);
      if (size == BYTES) break;
    }
  sbfi_packed_coder_free(&coder);
  free(values);
  free(stored);
  free(back);
}
END_TEST

START_TEST(test_truncated_streams_are_damaged)
{
  uint32_t *values = ramp();
  uint8_t *stored = malloc(BYTES + 1), *back = malloc(BYTES + 4);
  size_t size, raw = 4000;
  sbfi_packed_coder coder;
  sbfi_packed_coder_init(&coder, NULL, 6);
  for (int filter = 0; filter < SBFI_FILTER_COUNT; filter++) {
    sbfi_packed_filter f = (sbfi_packed_filter)filter;
    ck_assert_int_eq(
        sbfi_packed_deflate(&coder, (uint8_t *)values, raw, f, 1, stored, BYTES, &size), SBFI_CODED);
    for (size_t cut = 0; cut < size; cut++)
      ck_assert_int_eq(sbfi_packed_inflate(&coder, stored, cut, f, 1, back, raw), SBFI_CODED_DAMAGED);
    stored[size] = 0; /* something behind the stream; too much and too little in it */
    ck_assert_int_eq(sbfi_packed_inflate(&coder, stored, size + 1, f, 1, back, raw), SBFI_CODED_DAMAGED);
    ck_assert_int_eq(sbfi_packed_inflate(&coder, stored, size, f, 1, back, raw - 4), SBFI_CODED_DAMAGED);
    ck_assert_int_eq(sbfi_packed_inflate(&coder, stored, size, f, 1, back, raw + 4), SBFI_CODED_DAMAGED);
    stored[size - 1] ^= 1; /* zlib's own checksum */
    ck_assert_int_eq(sbfi_packed_inflate(&coder, stored, size, f, 1, back, raw), SBFI_CODED_DAMAGED);
    ck_assert_int_eq(sbfi_packed_inflate(&coder, stored, size - 4, f, 1, back, raw), SBFI_CODED_DAMAGED);
  }
  sbfi_packed_coder_free(&coder);
  free(values);
  free(stored);
  free(back);
}
END_TEST

START_TEST(test_capacity_is_exact_to_the_byte)
{
  uint32_t *values = ramp();
  uint8_t *stored = malloc(BYTES);
  size_t size, again;
  sbfi_packed_coder coder;
  sbfi_packed_coder_init(&coder, NULL, 6);
  ck_assert_int_eq(
      sbfi_packed_deflate(&coder, (uint8_t *)values, BYTES, SBFI_FILTER_DELTA, 1, stored, BYTES, &size),
      SBFI_CODED);
  for (size_t capacity = 0; capacity < size; capacity += size / 50 + 1) {
    memset(stored, 0xee, BYTES);
    ck_assert_int_eq(
        sbfi_packed_deflate(&coder, (uint8_t *)values, BYTES, SBFI_FILTER_DELTA, 1, stored, capacity, &again),
        SBFI_CODED_TOO_LONG);
    ck_assert_uint_eq(stored[capacity], 0xee);
  }
  ck_assert_int_eq(
      sbfi_packed_deflate(&coder, (uint8_t *)values, BYTES, SBFI_FILTER_DELTA, 1, stored, size - 1, &again),
      SBFI_CODED_TOO_LONG);
  ck_assert_int_eq(
      sbfi_packed_deflate(&coder, (uint8_t *)values, BYTES, SBFI_FILTER_DELTA, 1, stored, size, &again),
      SBFI_CODED);
  ck_assert_uint_eq(again, size);
  sbfi_packed_coder_free(&coder);
  free(values);
  free(stored);
}
END_TEST

START_TEST(test_failed_allocations_are_reported)
{
  uint32_t *values = ramp();
  uint8_t *stored = malloc(BYTES), *back = malloc(BYTES);
  size_t size = 0, raw = 100000;
  sbfi_coded coded = SBFI_CODED_NO_MEMORY;
  for (size_t allowed = 0; coded == SBFI_CODED_NO_MEMORY; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_packed_coder coder;
    sbfi_packed_coder_init(&coder, &memory.allocator, 6);
    coded = sbfi_packed_deflate(&coder, (uint8_t *)values, raw, SBFI_FILTER_DELTA, 1, stored, BYTES, &size);
    sbfi_packed_coder_free(&coder);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert_int_eq(coded, SBFI_CODED);
  coded = SBFI_CODED_NO_MEMORY;
  for (size_t allowed = 0; coded == SBFI_CODED_NO_MEMORY; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_packed_coder coder;
    sbfi_packed_coder_init(&coder, &memory.allocator, 6);
    coded = sbfi_packed_inflate(&coder, stored, size, SBFI_FILTER_DELTA, 1, back, raw);
    sbfi_packed_coder_free(&coder);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert_int_eq(coded, SBFI_CODED);
  free(values);
  free(stored);
  free(back);
}
END_TEST

START_TEST(test_crc_is_that_of_zip_and_png)
{
  ck_assert_uint_eq(sbfi_crc32("123456789", 9), 0xcbf43926);
  ck_assert_uint_eq(sbfi_crc32("", 0), 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_codec");
  TCase *tests = tcase_create("packed_codec");
  tcase_add_test(tests, test_every_filter_round_trips);
  tcase_add_test(tests, test_truncated_streams_are_damaged);
  tcase_add_test(tests, test_capacity_is_exact_to_the_byte);
  tcase_add_test(tests, test_failed_allocations_are_reported);
  tcase_add_test(tests, test_crc_is_that_of_zip_and_png);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
