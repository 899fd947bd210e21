#include "mechanics/angle.h"

#include <math.h>

#include "harness.h"

START_TEST(angles_are_those_of_the_library)
{
  for (int i = -50; i <= 50; i++)
    for (int j = -50; j <= 50; j++)
      if (j != 0 || i > 0) ck_assert_double_eq_tol(sbfi_angle(j, i), atan2(j, i), 2e-11);
  ck_assert_double_eq(sbfi_angle(0, 0), 0);
  ck_assert_double_eq_tol(sbfi_angle(0, -1), atan2(0, -1), 2e-11);
}
END_TEST

int main(void) {
  Suite *s = suite_create("angle");
  TCase *c = tcase_create("angle");
  tcase_add_test(c, angles_are_those_of_the_library);
  suite_add_tcase(s, c);
  return harness_run(s);
}
