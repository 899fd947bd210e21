/* Remainders of angles, times and phases, however large. */
#include <math.h>

#include "harness.h"
#include "math/vec3.h"

START_TEST(a_remainder_is_within_the_period)
{
  static const float values[] = {0, 1, 2.5f, -0.1f, 100, -7, 1e6f, 4e9f, -4e9f, 4.2855e14f, -1e15f, 3e38f};
  static const float periods[] = {1e-6f, 0.7f, 1, 6.2831853f, 1e4f};
  for (int i = 0; i < 12; i++)
    for (int k = 0; k < 5; k++) {
      float wrapped = sbri_wrap(values[i], periods[k]);
      ck_assert_msg(wrapped >= 0 && wrapped <= periods[k], "%g by %g: %g", (double)values[i],
          (double)periods[k], (double)wrapped);
    }
  ck_assert_float_eq(sbri_wrap(2.5f, 1), 0.5f);
  ck_assert_float_eq(sbri_wrap(-0.25f, 1), 0.75f);
  ck_assert_float_eq(sbri_wrap(NAN, 1), 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("wrap");
  TCase *c = tcase_create("wrap");
  tcase_add_test(c, a_remainder_is_within_the_period);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
