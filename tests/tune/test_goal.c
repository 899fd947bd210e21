/* The choice from a front for each kind of goal, and the nearest entry if no entry meets it. */
#include "tune/goal.h"

#include "harness.h"

static const tune_offer FRONT[] = {{0.04, 10}, {0.02, 25}, {0.01, 22}, {0.001, 300}};

static uint32_t choose(double error_m, double budget_us, tune_verdict wanted) {
  uint32_t chosen = 99;
  const tune_goal goal = {error_m, budget_us};
  ck_assert_int_eq(tune_choose(FRONT, 4, &goal, &chosen), wanted);
  ck_assert_uint_lt(chosen, 4);
  return chosen;
}

START_TEST(an_error_goal_selects_the_cheapest_within_it)
{
  ck_assert_uint_eq(choose(1, 0, TUNE_MET), 0);
  ck_assert_uint_eq(choose(0.02, 0, TUNE_MET), 1);
  ck_assert_uint_eq(choose(0.005, 0, TUNE_MET), 3);
}
END_TEST

START_TEST(a_budget_selects_the_best_accuracy_within_it)
{
  ck_assert_uint_eq(choose(0, 1000, TUNE_MET), 3);
  ck_assert_uint_eq(choose(0, 24, TUNE_MET), 2);
  ck_assert_uint_eq(choose(0, 12, TUNE_MET), 0);
}
END_TEST

START_TEST(without_a_goal_it_is_the_nearest_of_all)
{ ck_assert_uint_eq(choose(0, 0, TUNE_MET), 3); }
END_TEST

START_TEST(error_and_budget_are_kept_if_possible)
{
  ck_assert_uint_eq(choose(0.02, 23, TUNE_MET), 2); /* the next on the front, quicker than its visits say */
  ck_assert_uint_eq(choose(0.02, 30, TUNE_MET), 1);
}
END_TEST

START_TEST(unreachable_targets_are_reported_with_the_closest)
{
  uint32_t chosen;
  ck_assert_uint_eq(choose(1e-6, 0, TUNE_TOO_FINE), 3);
  ck_assert_uint_eq(choose(0, 1, TUNE_TOO_CHEAP), 0);
  ck_assert_uint_eq(choose(0.02, 11, TUNE_NOT_BOTH), 2);
  ck_assert_uint_eq(choose(0.005, 11, TUNE_NOT_BOTH), 3);
  ck_assert_int_eq(tune_choose(NULL, 0, &(tune_goal){1, 1}, &chosen), TUNE_TOO_FINE);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("goal");
  TCase *c = tcase_create("goal");
  tcase_add_test(c, an_error_goal_selects_the_cheapest_within_it);
  tcase_add_test(c, a_budget_selects_the_best_accuracy_within_it);
  tcase_add_test(c, without_a_goal_it_is_the_nearest_of_all);
  tcase_add_test(c, error_and_budget_are_kept_if_possible);
  tcase_add_test(c, unreachable_targets_are_reported_with_the_closest);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
