#include "harness.h"
#include "ik_chains.h"

START_TEST(reaches_targets_within_range)
{ ik_expect_reaches(sbri_ccd, 75, 180); }
END_TEST

START_TEST(keeps_limits)
{ ik_expect_keeps_limits(sbri_ccd, 150); }
END_TEST

START_TEST(keeps_hinges)
{ ik_expect_keeps_hinges(sbri_ccd, 180); }
END_TEST

START_TEST(stretches_towards_targets_out_of_range)
{ ik_expect_stretches_to(sbri_ccd); }
END_TEST

START_TEST(bows_towards_the_pole)
{ ik_expect_bows_to_pole(sbri_ccd); }
END_TEST

START_TEST(copies_the_target_s_rotation)
{ ik_expect_copies_rotation(sbri_ccd); }
END_TEST

START_TEST(invalid_targets_keep_it_finite)
{ ik_expect_survives(sbri_ccd); }
END_TEST

START_TEST(extension_is_eased)
{ ik_expect_eases(sbri_ccd, 0.08f); }
END_TEST

int main(void) {
  Suite *suite = suite_create("ccd");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, reaches_targets_within_range);
  tcase_add_test(tests, keeps_limits);
  tcase_add_test(tests, keeps_hinges);
  tcase_add_test(tests, stretches_towards_targets_out_of_range);
  tcase_add_test(tests, bows_towards_the_pole);
  tcase_add_test(tests, copies_the_target_s_rotation);
  tcase_add_test(tests, invalid_targets_keep_it_finite);
  tcase_add_test(tests, extension_is_eased);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
