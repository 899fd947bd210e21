/* Verdicts of stability maps against the closed forms of each scheme's step. */
#include "chart/stability.h"

#include <math.h>

#include "harness.h"

static chart_verdict check(sbf_scheme scheme, double turn, double damping) {
  const chart_cell cell = {.scheme = scheme, .turn = turn, .damping = damping, .stretch = 0.02};
  chart_verdict verdict;
  sbf_diagnostic error;
  ck_assert_int_eq(chart_cell_evaluate(&cell, &verdict, &error), SBF_OK);
  return verdict;
}

/* Not a twentieth below it; 15 % above it explicit Euler with a ratio of 0.1 has gained 62 times its energy
 * by the end, 5 % above it but 3.5 times. */
START_TEST(steps_become_unstable_only_beyond_their_bound)
{
  static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_HEUN};
  static const double ratios[] = {0.1, 0.3, 0.6, 0.9};
  for (int k = 0; k < 4; k++) {
    double bound = chart_stable_below(schemes[_i], ratios[k]);
    ck_assert(bound > 0.1 && bound < 3);
    chart_verdict below = check(schemes[_i], 0.95 * bound, ratios[k]);
    chart_verdict above = check(schemes[_i], 1.15 * bound, ratios[k]);
    ck_assert_msg(below.outcome <= CHART_BIASED, "ratio %g: %s", ratios[k], below.why);
    ck_assert_msg(above.outcome == CHART_DEAD, "ratio %g: off by %g", ratios[k], above.off);
  }
}
END_TEST

START_TEST(bounds_are_those_of_the_books)
{
  ck_assert_double_eq_tol(chart_stable_below(SBF_SCHEME_SYMPLECTIC, 0), 2, 1e-12);
  ck_assert_double_eq_tol(chart_stable_below(SBF_SCHEME_EXPLICIT_EULER, 0.25), 0.5, 1e-12);
  ck_assert_double_eq(chart_stable_below(SBF_SCHEME_HEUN, 0), 0);
  /* Where damping is all, the real axis of Heun's region: w h = 2. */
  ck_assert_double_eq_tol(chart_stable_below(SBF_SCHEME_HEUN, 1), 2, 1e-9);
  ck_assert(isinf(chart_stable_below(SBF_SCHEME_POSITION_BASED, 0.1)));
  ck_assert(isnan(chart_stable_below(SBF_SCHEME_RELAXATION, 0.1)));
}
END_TEST

/* Undamped: symplectic's frequency is off by (w h)^2 / 24, implicit steps' damping by w h / 2. */
START_TEST(measured_errors_are_those_of_the_scheme)
{
  chart_verdict v = check(SBF_SCHEME_SYMPLECTIC, 0.5, 0);
  ck_assert_int_eq(v.outcome, CHART_SOUND);
  ck_assert_double_eq_tol(v.off, 2 * asin(0.25) / 0.5 - 1, 1e-4);
  ck_assert_int_eq(check(SBF_SCHEME_SYMPLECTIC, 1.3, 0).outcome, CHART_BIASED);
  ck_assert_int_eq(check(SBF_SCHEME_SYMPLECTIC, 2.1, 0).outcome, CHART_DEAD);
  ck_assert_double_eq_tol(check(SBF_SCHEME_POSITION_BASED, 0.06, 0).off, 0.03, 5e-4);
  ck_assert_double_eq_tol(check(SBF_SCHEME_BLOCK_DESCENT, 0.06, 0).off, 0.03, 5e-4);
  ck_assert_int_eq(check(SBF_SCHEME_EXPLICIT_EULER, 0.2, 0).outcome, CHART_DEAD);
}
END_TEST

/* Damped by z: the first order of |s' - s| / w is z w h / (2 sqrt(1 - z^2)), and what damping grows by z^2 w
 * h, since a step's damping goes by the speed before it. Undamped there is no first order at all. */
START_TEST(errors_of_symplectic_steps_grow_with_damping)
{
  static const double ratios[] = {0.1, 0.3, 0.5}, turns[] = {0.03, 0.06};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 2; k++) {
      double z = ratios[i], expected = z * turns[k] / (2 * sqrt(1 - z * z));
      double off = check(SBF_SCHEME_SYMPLECTIC, turns[k], z).off;
      ck_assert_msg(
          fabs(off - expected) < 0.1 * expected, "z %g, w h %g: %g, not %g", z, turns[k], off, expected);
    }
  ck_assert_int_eq(check(SBF_SCHEME_SYMPLECTIC, 0.14, 0.5).outcome, CHART_SOUND);
  ck_assert_int_eq(check(SBF_SCHEME_SYMPLECTIC, 0.17, 0.5).outcome, CHART_BIASED);
  ck_assert_int_eq(check(SBF_SCHEME_SYMPLECTIC, 0.9, 0).outcome, CHART_SOUND);
}
END_TEST

/* No step that is implicit dies, however stiff; nor does any become sound again. */
START_TEST(implicit_steps_live_and_are_biased)
{
  static const double turns[] = {0.2, 1, 2, 5, 20};
  for (int k = 0; k < 5; k++) {
    ck_assert_int_eq(check(SBF_SCHEME_POSITION_BASED, turns[k], 0.1).outcome, CHART_BIASED);
    ck_assert_int_eq(check(SBF_SCHEME_BLOCK_DESCENT, turns[k], 0.1).outcome, CHART_BIASED);
  }
}
END_TEST

/* Uneven frames and a long one change nothing: ticks are even. */
START_TEST(frames_move_no_bound)
{
  static const double turns[] = {0.3, 1.2, 1.7, 1.95};
  for (int k = 0; k < 4; k++) {
    chart_verdict even = check(SBF_SCHEME_SYMPLECTIC, turns[k], 0.1), verdict;
    for (int late = 0; late < 2; late++) {
      const chart_cell cell = {.scheme = SBF_SCHEME_SYMPLECTIC,
          .turn = turns[k],
          .damping = 0.1,
          .jitter = late ? 0 : 0.8,
          .slow_ticks = late ? 12 : 0,
          .stretch = 0.02};
      sbf_diagnostic error;
      ck_assert_int_eq(chart_cell_evaluate(&cell, &verdict, &error), SBF_OK);
      ck_assert_int_eq(verdict.outcome, even.outcome);
      if (even.outcome != CHART_DEAD) ck_assert_double_eq_tol(verdict.off, even.off, 0.002);
    }
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("stability");
  TCase *c = tcase_create("stability");
  tcase_add_loop_test(c, steps_become_unstable_only_beyond_their_bound, 0, 3);
  tcase_add_test(c, bounds_are_those_of_the_books);
  tcase_add_test(c, measured_errors_are_those_of_the_scheme);
  tcase_add_test(c, errors_of_symplectic_steps_grow_with_damping);
  tcase_add_test(c, implicit_steps_live_and_are_biased);
  tcase_add_test(c, frames_move_no_bound);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
