#include "harness.h"
#include "ik_chains.h"

START_TEST(reaches_what_can_be_reached)
{ ik_expect_reaches(sbri_ccd, 75, 180); }
END_TEST

START_TEST(keeps_limits)
{ ik_expect_keeps_limits(sbri_ccd, 150); }
END_TEST

START_TEST(keeps_hinges)
{ ik_expect_keeps_hinges(sbri_ccd, 180); }
END_TEST

START_TEST(stretches_out_to_what_is_too_far)
{ ik_expect_stretches_to(sbri_ccd); }
END_TEST

START_TEST(bows_towards_the_pole)
{ ik_expect_bows_to_pole(sbri_ccd); }
END_TEST

START_TEST(copies_the_target_s_rotation)
{ ik_expect_copies_rotation(sbri_ccd); }
END_TEST

START_TEST(odd_targets_leave_it_whole)
{ ik_expect_survives(sbri_ccd); }
END_TEST

START_TEST(extension_is_eased)
{ ik_expect_eases(sbri_ccd, 0.08f); }
END_TEST

int main(void) {
  Suite *suite = suite_create("ccd");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, reaches_what_can_be_reached);
  tcase_add_test(tests, keeps_limits);
  tcase_add_test(tests, keeps_hinges);
  tcase_add_test(tests, stretches_out_to_what_is_too_far);
  tcase_add_test(tests, bows_towards_the_pole);
  tcase_add_test(tests, copies_the_target_s_rotation);
  tcase_add_test(tests, odd_targets_leave_it_whole);
  tcase_add_test(tests, extension_is_eased);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
