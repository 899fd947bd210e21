/* Medians, quartiles and outliers of known samples. */
#include "chart/spread.h"

#include "harness.h"

START_TEST(quartiles_lie_between_samples)
{
  double samples[] = {4, 1, 3, 2};
  chart_spread s = chart_spread_of(samples, 4);
  ck_assert_double_eq(s.min, 1);
  ck_assert_double_eq(s.low, 1.75);
  ck_assert_double_eq(s.median, 2.5);
  ck_assert_double_eq(s.high, 3.25);
  ck_assert_double_eq(s.max, 4);
  ck_assert_uint_eq(s.outliers, 0);
}
END_TEST

START_TEST(outliers_are_counted_and_kept)
{
  double samples[] = {10, 11, 12, 13, 14, 100, 11.5, 12.5, -50};
  chart_spread s = chart_spread_of(samples, 9);
  ck_assert_uint_eq(s.outliers, 2);
  ck_assert_double_eq(s.median, 12);
  ck_assert_double_eq(s.max, 100);
  ck_assert_double_eq(s.min, -50);
}
END_TEST

START_TEST(one_sample_is_all_of_them)
{
  double sample = 7;
  chart_spread s = chart_spread_of(&sample, 1);
  ck_assert(s.min == 7 && s.low == 7 && s.median == 7 && s.high == 7 && s.max == 7 && s.outliers == 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("spread");
  TCase *c = tcase_create("spread");
  tcase_add_test(c, quartiles_lie_between_samples);
  tcase_add_test(c, outliers_are_counted_and_kept);
  tcase_add_test(c, one_sample_is_all_of_them);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
