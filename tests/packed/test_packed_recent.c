#include "packed/packed_recent.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"

/* Worked out by hand: 7, 7, 9, 7, 9, 0, 8, 7. New are 7, 9 and 8; 0 is remembered from the beginning, behind
 * the other two. */
START_TEST(test_bytes_are_those_of_the_specification)
{
  const uint32_t values[8] = {7, 7, 9, 7, 9, 0, 8, 7};
  const uint8_t expected[32] = {0, 1, 0, 2, 2, 3, 0, 4, /* differences 7, 2, -1 */ 14, 4, 1};
  uint8_t block[32];
  uint32_t back[8];
  ck_assert(sbfi_filter_recent((const uint8_t *)values, 0, 8, block));
  ck_assert_mem_eq(block, expected, sizeof expected);
  ck_assert(sbfi_unfilter_recent(block, 8, (uint8_t *)back, 0));
  ck_assert_mem_eq(back, values, sizeof values);
}
END_TEST

/* Strips of triangles with large indices, cut into blocks that restart the differences. */
START_TEST(test_blocks_round_trip)
{
  enum { COUNT = 3000 };
  static uint32_t values[COUNT], back[COUNT + 1];
  static uint8_t block[4 * COUNT];
  for (uint32_t i = 0; i < COUNT; i++) values[i] = 0xffffff00u + (i / 3 + i % 3) * 5;
  for (size_t size = 1; size <= COUNT; size = size * 3 + 1) {
    memset(back, 0xee, sizeof back);
    for (size_t done = 0; done < COUNT; done += size) {
      size_t some = COUNT - done < size ? COUNT - done : size;
      bool fits = sbfi_filter_recent((const uint8_t *)values, done, some, block);
      ck_assert(fits || some < 8);
      if (fits)
        ck_assert(sbfi_unfilter_recent(block, some, (uint8_t *)back, done));
      else
        memcpy(back + done, values + done, 4 * some);
    }
    ck_assert_mem_eq(back, values, sizeof values);
    ck_assert_uint_eq(back[COUNT], 0xeeeeeeee);
  }
}
END_TEST

START_TEST(test_new_scalars_fit_up_to_three_quarters)
{
  for (uint32_t new_count = 0; new_count <= 8; new_count++) {
    uint32_t values[8], back[8];
    uint8_t block[32];
    for (uint32_t i = 0; i < 8; i++) values[i] = i < new_count ? 0xdeadbeefu * (i + 1) : 0;
    ck_assert_int_eq(sbfi_filter_recent((const uint8_t *)values, 0, 8, block), new_count <= 6);
    if (new_count > 6) continue;
    ck_assert(sbfi_unfilter_recent(block, 8, (uint8_t *)back, 0));
    ck_assert_mem_eq(back, values, sizeof values);
  }
}
END_TEST

START_TEST(test_impossible_blocks_are_refused)
{
  uint32_t back[8];
  uint8_t block[32] = {1, 1, 1, 1, 1, 1, 1, SBFI_RECENT_COUNT};
  ck_assert(sbfi_unfilter_recent(block, 8, (uint8_t *)back, 0));
  block[7] = SBFI_RECENT_COUNT + 1;
  ck_assert(!sbfi_unfilter_recent(block, 8, (uint8_t *)back, 0));
  memset(block, 0, sizeof block);
  block[0] = block[1] = 1;
  ck_assert(sbfi_unfilter_recent(block, 8, (uint8_t *)back, 0));
  block[1] = 0; /* seven new ones, and bytes for six */
  ck_assert(!sbfi_unfilter_recent(block, 8, (uint8_t *)back, 0));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_recent");
  TCase *tests = tcase_create("packed_recent");
  tcase_add_test(tests, test_bytes_are_those_of_the_specification);
  tcase_add_test(tests, test_blocks_round_trip);
  tcase_add_test(tests, test_new_scalars_fit_up_to_three_quarters);
  tcase_add_test(tests, test_impossible_blocks_are_refused);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
