/* What each axis says of two tracks that differ in a known way. */
#include "chart/errors.h"

#include <math.h>

#include "harness.h"

enum { TICKS = 240, ALL = (1 << CHART_AXIS_COUNT) - 1 };
static const double tick_s = 1.0 / 60;

/* Two points that swing along y, the second the other way. */
static chart_track swings(double height, double period_s) {
  chart_track t;
  ck_assert(chart_track_make(&t, TICKS, 2));
  for (uint32_t i = 0; i < TICKS; i++) {
    double y = -height * cos(6.283185307179586 * i * tick_s / period_s);
    t.positions[2 * i].y = (float)y, t.positions[2 * i + 1].y = (float)-y;
    t.energy_j[i] = 5 + height, t.kinetic_j[i] = 2, t.volume[i] = 1 - height / 10;
  }
  return t;
}

static const chart_signal along_y = {.there = true, .along = 1};
static const sbf_vec3 rest[2] = {{1, 0, 0}, {-1, 0, 0}};

START_TEST(each_axis_shows_the_difference)
{
  chart_track a = swings(0.12, 0.61), b = swings(0.1, 0.6);
  double errors[CHART_AXIS_COUNT];
  ck_assert(chart_errors_of(&a, &b, rest, tick_s, &along_y, ALL, errors));
  ck_assert_double_eq_tol(errors[CHART_PERIOD], 1.0 / 60, 1e-4);
  ck_assert_double_eq_tol(errors[CHART_AMPLITUDE], 0.2, 1e-3);
  ck_assert_double_eq_tol(errors[CHART_VOLUME], 0.002, 1e-9);
  ck_assert_double_eq_tol(errors[CHART_ENERGY], 0.01, 1e-9);
  ck_assert_double_gt(errors[CHART_PATH], 0.02);
  ck_assert_double_lt(errors[CHART_PATH], errors[CHART_FARTHEST]);
  ck_assert_double_le(errors[CHART_FARTHEST], 0.22);
  chart_track_free(&a), chart_track_free(&b);
}
END_TEST

START_TEST(the_same_is_not_off)
{
  chart_track a = swings(0.1, 0.6), b = swings(0.1, 0.6);
  double errors[CHART_AXIS_COUNT];
  ck_assert(chart_errors_of(&a, &b, rest, tick_s, &along_y, ALL, errors));
  for (int i = 0; i < CHART_PIXELS; i++) ck_assert_double_eq(errors[i], 0);
  ck_assert(chart_errors_of(&a, &b, rest, tick_s, &along_y, 1u << CHART_ENERGY, errors));
  ck_assert(isnan(errors[CHART_PATH]) && !isnan(errors[CHART_ENERGY]));
  chart_track_free(&a), chart_track_free(&b);
}
END_TEST

START_TEST(rest_is_detected_from_the_last_tick_alone)
{
  chart_track a = swings(0.1, 0.6), b = swings(0.1, 0.6);
  double errors[CHART_AXIS_COUNT];
  for (uint32_t i = 0; i < TICKS; i++)
    for (int k = 0; k < 2; k++) a.positions[2 * i + k] = b.positions[2 * i + k] = (sbf_vec3){9, 9, 9};
  for (int k = 0; k < 2; k++) {
    b.positions[2 * TICKS - 2 + k] = (sbf_vec3){rest[k].x, -0.2f, 0};
    a.positions[2 * TICKS - 2 + k] = (sbf_vec3){rest[k].x, -0.21f, 0};
  }
  ck_assert(chart_errors_of(&a, &b, rest, tick_s, &along_y, ALL, errors));
  ck_assert_double_eq_tol(errors[CHART_SHAPE], 0.05, 1e-5);
  ck_assert(isnan(errors[CHART_PERIOD]));
  chart_track_free(&a), chart_track_free(&b);
}
END_TEST

/* A pixel is 5.3 mm from 5 m. */
START_TEST(a_pixel_is_so_many_millimetres)
{
  ck_assert_double_eq_tol(1 / chart_pixels_a_metre(5), 0.005346, 1e-6);
  ck_assert_double_eq_tol(chart_pixels_a_metre(1), 5 * chart_pixels_a_metre(5), 1e-9);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("errors");
  TCase *c = tcase_create("errors");
  tcase_add_test(c, each_axis_shows_the_difference);
  tcase_add_test(c, the_same_is_not_off);
  tcase_add_test(c, a_pixel_is_so_many_millimetres);
  tcase_add_test(c, rest_is_detected_from_the_last_tick_alone);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
