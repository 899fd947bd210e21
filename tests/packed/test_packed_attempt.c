#include "packed/packed_attempt.h"

#include "harness.h"

enum { COUNT = 255, BYTES = COUNT * 4 };

/* What each of them holds compresses best by another filter. */
static void fill_noise(uint32_t *values) {
  for (uint32_t i = 0, seed = 7; i < COUNT; i++)
    values[i] = seed = (seed ^ seed >> 15) * 2246822519u + 3266489917u;
}
static void fill_bytes_of_equal_weight(uint32_t *values) {
  fill_noise(values);
  for (uint32_t i = 0; i < COUNT; i++) values[i] = 0x3f000000u | (values[i] & 0xff);
}
static void fill_ramp(uint32_t *values) {
  for (uint32_t i = 0; i < COUNT; i++) values[i] = i * 1021;
}

START_TEST(test_the_filter_with_the_smallest_result_is_best)
{
  static const struct {
    void (*fill)(uint32_t *values);
    sbfi_packed_filter best;
  } cases[] = {{fill_noise, SBFI_FILTER_NONE}, {fill_bytes_of_equal_weight, SBFI_FILTER_PLANES},
      {fill_ramp, SBFI_FILTER_DELTA}};
  uint32_t values[COUNT];
  uint8_t stored[2 * BYTES];
  sbfi_packed_coder coder;
  sbfi_packed_filter found;
  size_t size, min = SIZE_MAX;
  cases[_i].fill(values);
  sbfi_packed_coder_init(&coder, NULL, 6);
  ck_assert(sbfi_packed_best_filter(&coder, values, BYTES, 4, &found));
  ck_assert_int_eq(found, cases[_i].best);
  for (int f = SBFI_FILTER_NONE; f <= SBFI_FILTER_DELTA; f++) {
    ck_assert_int_eq(sbfi_packed_deflate(&coder, (const uint8_t *)values, BYTES, (sbfi_packed_filter)f, 1,
                         stored, sizeof stored, &size),
        SBFI_CODED);
    if (f == (int)found) min = size;
  }
  ck_assert(found == SBFI_FILTER_NONE ? min >= BYTES : min < BYTES);
  sbfi_packed_coder_free(&coder);
}
END_TEST

START_TEST(test_the_first_of_the_smallest_results_is_kept)
{
  uint32_t values[COUNT];
  uint8_t memory[2][BYTES], twin[BYTES];
  size_t size;
  sbfi_packed_coder coder;
  sbfi_packed_attempt attempt = {.best = memory[0], .spare = memory[1]};
  fill_ramp(values);
  sbfi_packed_coder_init(&coder, NULL, 6);
  ck_assert(sbfi_packed_try(&attempt, &coder, values, BYTES, 4, SBFI_FILTER_DELTA, 4));
  ck_assert_uint_eq(attempt.size, 0); /* nothing is as small as that */
  ck_assert(sbfi_packed_try(&attempt, &coder, values, BYTES, 4, SBFI_FILTER_PLANES, BYTES));
  size_t planes = attempt.size;
  ck_assert(sbfi_packed_try(&attempt, &coder, values, BYTES, 4, SBFI_FILTER_DELTA, BYTES));
  ck_assert_uint_lt(attempt.size, planes);
  ck_assert_int_eq(attempt.filter, SBFI_FILTER_DELTA);
  ck_assert(sbfi_packed_try(&attempt, &coder, values, BYTES, 4, SBFI_FILTER_PLANES, BYTES));
  ck_assert(sbfi_packed_try(&attempt, &coder, values, BYTES, 4, SBFI_FILTER_DELTA, BYTES));
  ck_assert_int_eq(attempt.filter, SBFI_FILTER_DELTA);
  ck_assert_int_eq(
      sbfi_packed_deflate(&coder, (const uint8_t *)values, BYTES, SBFI_FILTER_DELTA, 1, twin, BYTES, &size),
      SBFI_CODED);
  ck_assert_uint_eq(size, attempt.size);
  ck_assert_mem_eq(attempt.best, twin, size);
  sbfi_packed_coder_free(&coder);
}
END_TEST

START_TEST(test_failed_allocations_are_reported)
{
  uint32_t values[COUNT];
  bool fits = false;
  fill_ramp(values);
  for (size_t allowed = 0; !fits; allowed++) {
    harness_memory memory;
    sbfi_packed_coder coder;
    sbfi_packed_filter filter;
    harness_memory_init(&memory, allowed);
    sbfi_packed_coder_init(&coder, &memory.allocator, 6);
    fits = sbfi_packed_best_filter(&coder, values, BYTES, 4, &filter);
    ck_assert(fits == (memory.calls <= allowed));
    sbfi_packed_coder_free(&coder);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_attempt");
  TCase *all = tcase_create("all");
  tcase_add_loop_test(all, test_the_filter_with_the_smallest_result_is_best, 0, 3);
  tcase_add_test(all, test_the_first_of_the_smallest_results_is_kept);
  tcase_add_test(all, test_failed_allocations_are_reported);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
