#include "harness.h"

#include "base/union_find.h"

enum { COUNT = 64 };

START_TEST(each_number_starts_in_its_own_set)
{
  uint32_t parents[COUNT];
  sbfi_sets_begin(parents, COUNT);
  for (uint32_t i = 0; i < COUNT; i++) ck_assert_uint_eq(sbfi_set_root(parents, i), i);
}
END_TEST

/* Numbers of one remainder by `step` are joined, neighbours from behind, from the front or crosswise. */
static void check_remainders(uint32_t step, uint32_t order) {
  uint32_t parents[COUNT];
  sbfi_sets_begin(parents, COUNT);
  for (uint32_t i = 0; i + step < COUNT; i++) {
    const uint32_t forth = (i * 37) % (COUNT - step), back = COUNT - step - 1 - i;
    const uint32_t a = order == 0 ? i : order == 1 ? back : forth;
    sbfi_sets_join(parents, order == 1 ? a : a + step, order == 1 ? a + step : a);
  }
  for (uint32_t i = 0; i < COUNT; i++) ck_assert_uint_eq(sbfi_set_root(parents, i), i % step);
}

START_TEST(the_lowest_is_the_root_in_any_order)
{
  for (uint32_t step = 1; step < 7; step++)
    for (uint32_t order = 0; order < 3; order++) check_remainders(step, order);
}
END_TEST

START_TEST(joining_again_changes_nothing)
{
  uint32_t parents[COUNT], before[COUNT];
  sbfi_sets_begin(parents, COUNT);
  sbfi_sets_join(parents, 3, 9);
  sbfi_sets_join(parents, 9, 5);
  for (uint32_t i = 0; i < COUNT; i++) before[i] = sbfi_set_root(parents, i);
  sbfi_sets_join(parents, 5, 3);
  sbfi_sets_join(parents, 9, 9);
  for (uint32_t i = 0; i < COUNT; i++) ck_assert_uint_eq(sbfi_set_root(parents, i), before[i]);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("union_find");
  TCase *c = tcase_create("union_find");
  tcase_add_test(c, each_number_starts_in_its_own_set);
  tcase_add_test(c, the_lowest_is_the_root_in_any_order);
  tcase_add_test(c, joining_again_changes_nothing);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
