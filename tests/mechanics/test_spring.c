#include <math.h>

#include "harness.h"
#include "mechanics/spring.h"

START_TEST(the_force_is_the_slope_of_the_energy)
{
  static const float slacks[] = {0, 0.75f, 1, -2};
  for (int k = 0; k < 4; k++) {
    const sbfi_spring s = {0, 1, 120, 0.5f, 0, slacks[k]};
    for (int i = 1; i < 20; i++) {
      double length = 0.07 * i, step = 1e-5;
      double slope =
          (sbfi_spring_energy(&s, length + step) - sbfi_spring_energy(&s, length - step)) / (2 * step);
      ck_assert_double_eq_tol(sbfi_spring_force_factor(&s, (float)length) * length, slope, 2e-3);
    }
  }
}
END_TEST

START_TEST(slack_is_missing_stiffness_in_compression)
{
  const sbfi_spring s = {0, 1, 120, 0.5f, 0, 0.75f};
  ck_assert_double_eq_tol(sbfi_spring_energy(&s, 0.6), 0.6, 1e-6);
  ck_assert_double_eq_tol(sbfi_spring_energy(&s, 0.4), 0.15, 1e-6);
  ck_assert_float_eq(sbfi_spring_stiffness(&s, 0.5f), 120);
  ck_assert_float_eq(sbfi_spring_stiffness(&s, 0.4f), 30);
}
END_TEST

START_TEST(strain_and_pull_of_springs_without_length)
{
  const sbfi_spring goal = {0, 1, 120, 0, 0, 0}, s = {0, 1, 120, 2, 0, 0};
  ck_assert_float_eq(sbfi_spring_force_factor(&goal, 0.5f), 120);
  ck_assert_float_eq(sbfi_spring_force_factor(&s, 0), 0);
  ck_assert_float_eq(sbfi_spring_strain(&s, 3), 0.5f);
  ck_assert_float_eq(sbfi_spring_strain(&goal, 0.25f), 0.25f);
}
END_TEST

START_TEST(energies_add_up)
{
  const sbfi_spring springs[] = {{0, 1, 100, 1, 0, 0}, {1, 2, 50, 3, 0, 0}};
  const float positions[][4] = {{0, 0, 0, 7}, {2, 0, 0, 7}, {2, 4, 0, 7}};
  ck_assert_double_eq_tol(sbfi_springs_energy(springs, 2, positions[0], 4), 50 + 25, 1e-9);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("spring");
  TCase *c = tcase_create("spring");
  tcase_add_test(c, the_force_is_the_slope_of_the_energy);
  tcase_add_test(c, slack_is_missing_stiffness_in_compression);
  tcase_add_test(c, strain_and_pull_of_springs_without_length);
  tcase_add_test(c, energies_add_up);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
