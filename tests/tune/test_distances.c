/* How far two tracks are apart, by each measure. */
#include "tune/distances.h"

#include <math.h>

#include "harness.h"

enum { TICKS = 10, POINTS = 30 };

static chart_track is, wanted;

static void setup(void) {
  ck_assert(chart_track_make(&is, TICKS, POINTS));
  ck_assert(chart_track_make(&wanted, TICKS, POINTS));
}
static void teardown(void) {
  chart_track_free(&is);
  chart_track_free(&wanted);
}

/* Distances 1..300 in a shuffled order: a multiplier prime to 300 visits each once. */
static void spread_out(void) {
  for (uint32_t i = 0; i < TICKS * POINTS; i++) is.positions[i].y = (float)(1 + (7 * i) % (TICKS * POINTS));
}

START_TEST(each_measure_has_its_documented_value)
{
  tune_distances d;
  spread_out();
  ck_assert(tune_distances_between(&is, &wanted, &d));
  ck_assert_double_eq(d.max_m, 300);
  ck_assert_double_eq_tol(d.p99_m, 297, 1e-9);
  ck_assert_double_eq_tol(d.rms_m, sqrt(301.0 * 601 / 6), 1e-9); /* of the first 300 squares */
  ck_assert_double_eq(tune_distance_by(&d, TUNE_BY_MAX), d.max_m);
  ck_assert_double_eq(tune_distance_by(&d, TUNE_BY_P99), d.p99_m);
  ck_assert_double_eq(tune_distance_by(&d, TUNE_BY_RMS), d.rms_m);
}
END_TEST

START_TEST(equal_and_missing_distances_have_one_value)
{
  tune_distances d;
  ck_assert(tune_distances_between(&is, &wanted, &d));
  ck_assert_double_eq(d.p99_m, 0);
  for (uint32_t i = 0; i < TICKS * POINTS; i++) is.positions[i].x = 2;
  ck_assert(tune_distances_between(&is, &wanted, &d));
  ck_assert_double_eq(d.p99_m, 2);
  ck_assert_double_eq(d.max_m, 2);
}
END_TEST

START_TEST(invalid_numbers_are_infinitely_distant)
{
  tune_distances d;
  for (uint32_t i = 0; i < 4; i++) is.positions[70 * i].z = NAN; /* more than one of a hundred */
  ck_assert(tune_distances_between(&is, &wanted, &d));
  ck_assert(isinf(d.max_m) && isinf(d.p99_m) && isinf(d.rms_m));
}
END_TEST

START_TEST(the_larger_of_each_is_used)
{
  const tune_distances a = {1, 5, 6}, b = {2, 3, 9};
  tune_distances both = tune_distances_larger(&a, &b);
  ck_assert_double_eq(both.rms_m, 2);
  ck_assert_double_eq(both.p99_m, 5);
  ck_assert_double_eq(both.max_m, 9);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("distances");
  TCase *c = tcase_create("distances");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, each_measure_has_its_documented_value);
  tcase_add_test(c, equal_and_missing_distances_have_one_value);
  tcase_add_test(c, invalid_numbers_are_infinitely_distant);
  tcase_add_test(c, the_larger_of_each_is_used);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
