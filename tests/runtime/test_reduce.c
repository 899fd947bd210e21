#include "harness.h"
#include "math/reduce.h"

START_TEST(the_order_of_the_sum_is_fixed)
{
  float values[19];
  for (int i = 0; i < 19; i++) values[i] = 1.0f / (float)(3 * i + 1);
  float lanes[8];
  for (int i = 0; i < 8; i++) lanes[i] = values[i] + values[i + 8];
  for (int i = 0; i < 3; i++) lanes[i] += values[i + 16];
  float expected =
      ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
  ck_assert_float_eq(sbri_sum(values, 19), expected);
  ck_assert_float_eq(sbri_sum(values, 0), 0);
  ck_assert_float_eq(sbri_sum(values, 1), 1);
}
END_TEST

START_TEST(the_greatest)
{
  const float values[] = {-3, -1, -2};
  ck_assert_float_eq(sbri_greatest(values, 3, -10), -1);
  ck_assert_float_eq(sbri_greatest(values, 3, 0), 0);
  ck_assert_float_eq(sbri_greatest(values, 0, 5), 5);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("reduce");
  TCase *c = tcase_create("reduce");
  tcase_add_test(c, the_order_of_the_sum_is_fixed);
  tcase_add_test(c, the_greatest);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
