/* Periods, heights and damping ratios found in signals that are known. */
#include "chart/oscillation.h"

#include <math.h>

#include "harness.h"

enum { COUNT = 600 };
static const double step_s = 1.0 / 60, pi = 3.14159265358979323846;

static void make(double *signal, double w, double ratio, double level, double height) {
  for (int i = 0; i < COUNT; i++) {
    double t = (i + 1) * step_s;
    signal[i] = level - height * exp(-ratio * w * t) * cos(w * sqrt(1 - ratio * ratio) * t + 0.3);
  }
}

START_TEST(a_sine_has_its_period_and_height)
{
  static const double frequencies[] = {3, 5, 11, 20};
  double signal[COUNT];
  for (int i = 0; i < 4; i++) {
    double w = frequencies[i];
    chart_swing swing;
    make(signal, w, 0, 0.7, 0.02);
    ck_assert(chart_swing_of(signal, COUNT, step_s, 0.7, &swing));
    ck_assert_double_eq_tol(swing.period_s, 2 * pi / w, 1e-6 / w);
    ck_assert_double_eq_tol(swing.first_height, 0.02, 1e-5);
    ck_assert_double_eq_tol(swing.last_height, 0.02, 1e-5);
    ck_assert_double_eq_tol(swing.damping_ratio, 0, 1e-5);
    ck_assert_uint_eq(swing.periods, (uint32_t)floor((10 * w + 0.3 - pi / 2) / (2 * pi)));
  }
}
END_TEST

START_TEST(a_decaying_oscillation_has_a_damping_ratio)
{
  double signal[COUNT];
  chart_swing swing;
  make(signal, 7, 0.03, -2, 1);
  ck_assert(chart_swing_of(signal, COUNT, step_s, -2, &swing));
  ck_assert_double_eq_tol(swing.period_s, 2 * pi / (7 * sqrt(1 - 0.03 * 0.03)), 1e-4);
  ck_assert_double_eq_tol(swing.damping_ratio, 0.03 / sqrt(1 - 0.03 * 0.03), 2e-4);
  make(signal, 7, -0.01, 0, 0.1);
  ck_assert(chart_swing_of(signal, COUNT, step_s, 0, &swing));
  ck_assert_double_eq_tol(swing.damping_ratio, -0.01, 2e-4);
}
END_TEST

START_TEST(monotonic_signals_have_no_oscillation)
{
  double signal[COUNT];
  chart_swing swing;
  for (int i = 0; i < COUNT; i++) signal[i] = i;
  ck_assert(!chart_swing_of(signal, COUNT, step_s, 100.5, &swing));
  ck_assert(!chart_swing_of(signal, COUNT, step_s, -5, &swing));
  for (int i = 0; i < COUNT; i++) signal[i] = NAN;
  ck_assert(!chart_swing_of(signal, COUNT, step_s, 0, &swing));
  ck_assert(!chart_swing_of(signal, 1, step_s, 0, &swing));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("oscillation");
  TCase *c = tcase_create("oscillation");
  tcase_add_test(c, a_sine_has_its_period_and_height);
  tcase_add_test(c, a_decaying_oscillation_has_a_damping_ratio);
  tcase_add_test(c, monotonic_signals_have_no_oscillation);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
