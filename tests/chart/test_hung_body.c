/* Whole bodies of stability maps: their lowest modes against linear theory, verdicts against closed forms. */
#include "chart/hung_body.h"

#include <math.h>

#include "harness.h"

static chart_hung_body body_of(chart_elastic elastic, double mass_ratio, double poisson_ratio) {
  chart_hung_body body;
  sbf_diagnostic error;
  sbf_status status = chart_hung_body_make(elastic, mass_ratio, poisson_ratio, &body, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  return body;
}

static chart_verdict check(const chart_hung_body *body, sbf_scheme scheme, double turn) {
  chart_verdict verdict;
  sbf_diagnostic error;
  ck_assert_int_eq(chart_hung_body_evaluate(body, scheme, turn, &verdict, &error), SBF_OK);
  return verdict;
}

/* Five masses of 1 kg on springs of 1000 N/m, one end free: 2 sqrt(k / m) sin((2 i - 1) pi / 22). */
START_TEST(a_chain_has_the_modes_of_the_books)
{
  static const double pi = 3.14159265358979323846;
  chart_hung_body body = body_of(CHART_OF_SPRINGS, 1, 0);
  double low = 2 * sqrt(1000) * sin(pi / 22), high = 2 * sqrt(1000) * sin(9 * pi / 22);
  double damping = 0.1 * low / high;
  ck_assert_double_eq_tol(body.highest_rad_s, high, 1e-3 * high);
  ck_assert_double_eq_tol(body.rate[1], low * sqrt(1 - damping * damping), 2e-3 * low);
  ck_assert_double_eq_tol(body.rate[0], -damping * low, 0.01 * damping * low);
  chart_hung_body_free(&body);
}
END_TEST

/* A tenth below the bound of the stiffest mode nothing grows, beyond it all is lost, whatever hangs at the
 * end. Just beyond its own explicit Euler gains too slowly for 600 ticks to show it. Of regions the
 * stiffest mode is the runtime's own estimate. */
START_TEST(bodies_become_unstable_with_their_stiffest_mode)
{
  static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_HEUN, SBF_SCHEME_EXPLICIT_EULER};
  static const double ratios[] = {1, 30};
  for (int k = 0; k < 2; k++) {
    chart_hung_body body = body_of((chart_elastic)_i, ratios[k], 0.3);
    for (int s = 0; s < 3; s++) {
      double bound = chart_stable_below(schemes[s], 0.1);
      double beyond = s == 2 ? 2.5 : 1.3;
      chart_verdict below = check(&body, schemes[s], 0.9 * bound);
      chart_verdict above = check(&body, schemes[s], beyond * bound);
      ck_assert_msg(below.outcome == CHART_SOUND, "scheme %d, ratio %g: %s", s, ratios[k], below.why);
      ck_assert_msg(above.outcome == CHART_DEAD, "scheme %d, ratio %g: off by %g", s, ratios[k], above.off);
    }
    chart_hung_body_free(&body);
  }
}
END_TEST

/* One sweep of position-based steps is too soft where the stiffest mode turns by more than about half a
 * radian, the more so the heavier the end; block descent damps what it does not lose. */
START_TEST(stable_bodies_are_soft_or_damped)
{
  double off[2], hangs[2];
  for (int k = 0; k < 2; k++) {
    chart_hung_body body = body_of(CHART_OF_SPRINGS, k ? 100 : 1, 0);
    chart_verdict soft = check(&body, SBF_SCHEME_POSITION_BASED, 1),
                  fine = check(&body, SBF_SCHEME_POSITION_BASED, 0.1);
    ck_assert_int_eq(fine.outcome, CHART_SOUND);
    ck_assert_int_eq(soft.outcome, CHART_BIASED);
    off[k] = soft.off, hangs[k] = soft.reached;
    ck_assert_int_eq(check(&body, SBF_SCHEME_BLOCK_DESCENT, 20).outcome, CHART_BIASED);
    ck_assert_int_eq(check(&body, SBF_SCHEME_SYMPLECTIC, 1).outcome, CHART_SOUND);
    chart_hung_body_free(&body);
  }
  ck_assert_double_gt(off[0], 0.1);
  ck_assert_double_gt(hangs[0], 1.1);
  ck_assert_double_gt(hangs[1], hangs[0] + 0.05);
}
END_TEST

/* Matter that keeps its volume is stiffer against pressing: steps get shorter, and nothing else changes. */
START_TEST(poisson_ratios_move_the_stiffest_mode_alone)
{
  chart_hung_body low = body_of(CHART_OF_TETRAHEDRA, 1, 0.1), high = body_of(CHART_OF_TETRAHEDRA, 1, 0.48);
  ck_assert_double_gt(high.highest_rad_s, 2 * low.highest_rad_s);
  ck_assert_int_eq(check(&high, SBF_SCHEME_SYMPLECTIC, 1.6).outcome, CHART_SOUND);
  ck_assert_int_eq(check(&high, SBF_SCHEME_SYMPLECTIC, 2).outcome, CHART_DEAD);
  ck_assert_int_eq(check(&high, SBF_SCHEME_RELAXATION, 0.1).outcome, CHART_REFUSED);
  chart_hung_body_free(&low);
  chart_hung_body_free(&high);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("hung_body");
  TCase *c = tcase_create("hung_body");
  tcase_add_test(c, a_chain_has_the_modes_of_the_books);
  tcase_add_loop_test(c, bodies_become_unstable_with_their_stiffest_mode, 0, 3);
  tcase_add_test(c, stable_bodies_are_soft_or_damped);
  tcase_add_test(c, poisson_ratios_move_the_stiffest_mode_alone);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
