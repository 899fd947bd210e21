#include "packed/packed_filter.h"

#include <stdlib.h>

#include "harness.h"
#include "random.h"

static uint32_t random_scalar(uint32_t *state) {
  random_next(state);
  return *state >> (*state >> 5 & 31);
}

/* Through planes and back, block after block. */
static void round_trip(sbfi_packed_filter filter, uint32_t width, size_t count, uint32_t seed) {
  uint32_t *values = malloc(count * 4 + 4), *back = malloc(count * 4 + 4), state = seed;
  uint8_t *planes = malloc(count * 4 + 4);
  for (size_t i = 0; i < count; i++) values[i] = random_scalar(&state);
  memset(back, 0xee, count * 4 + 4);
  for (size_t done = 0; done < count; done += SBFI_FILTER_BLOCK) {
    size_t some = count - done < SBFI_FILTER_BLOCK ? count - done : SBFI_FILTER_BLOCK;
    sbfi_filter_block(filter, (const uint8_t *)values, done, some, width, planes);
    sbfi_unfilter_block(filter, planes, some, width, (uint8_t *)back, done);
  }
  ck_assert_msg(memcmp(values, back, count * 4) == 0, "filter %d width %u count %zu", filter, width, count);
  ck_assert_uint_eq(back[count], 0xeeeeeeee);
  free(values);
  free(back);
  free(planes);
}

START_TEST(test_filters_round_trip)
{
  for (uint32_t width = 1; width <= 4; width++)
    for (int filter = SBFI_FILTER_PLANES; filter <= SBFI_FILTER_DELTA; filter++) {
      for (size_t items = 1; items < 40; items++)
        round_trip((sbfi_packed_filter)filter, width, items * width, (uint32_t)items);
      round_trip((sbfi_packed_filter)filter, width, 2041 * width, 5);
      round_trip((sbfi_packed_filter)filter, width, SBFI_FILTER_BLOCK, 6);
      round_trip((sbfi_packed_filter)filter, width, SBFI_FILTER_BLOCK + width, 7);
      round_trip((sbfi_packed_filter)filter, width, 3 * SBFI_FILTER_BLOCK - 2 * width, 8);
    }
}
END_TEST

/* Two items of two scalars, worked out by hand: 1, 2^24 + 2; then 0, 2^24 + 5. */
START_TEST(test_bytes_are_those_of_the_specification)
{
  const uint32_t values[4] = {1, 0x01000002, 0, 0x01000005};
  const uint8_t as_planes[16] = {1, 2, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1};
  /* differences 1, 2^24 + 2, -1, 3; zigzag 2, 2^25 + 4, 1, 6 */
  const uint8_t as_delta[16] = {2, 4, 1, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0};
  uint8_t planes[16];
  sbfi_filter_block(SBFI_FILTER_PLANES, (const uint8_t *)values, 0, 4, 2, planes);
  ck_assert_mem_eq(planes, as_planes, 16);
  sbfi_filter_block(SBFI_FILTER_DELTA, (const uint8_t *)values, 0, 4, 2, planes);
  ck_assert_mem_eq(planes, as_delta, 16);
}
END_TEST

START_TEST(test_scalars_of_a_file_are_little_endian)
{
  uint8_t bytes[8] = {1, 2, 3, 4, 0xfe, 0, 0, 0};
  uint32_t values[2];
  memcpy(values, bytes, sizeof values);
  sbfi_scalars_to_host(values, 2);
  ck_assert_uint_eq(values[0], 0x04030201);
  ck_assert_uint_eq(values[1], 0xfe);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_filter");
  TCase *tests = tcase_create("packed_filter");
  tcase_add_test(tests, test_filters_round_trip);
  tcase_add_test(tests, test_bytes_are_those_of_the_specification);
  tcase_add_test(tests, test_scalars_of_a_file_are_little_endian);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
