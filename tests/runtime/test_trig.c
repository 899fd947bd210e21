#include <float.h>
#include <math.h>

#include "harness.h"
#include "math/trig.h"

/* Distance in units in the last place of `exact`. */
static double ulps(float value, double exact) {
  float rounded = (float)exact;
  double unit = fabs((double)nextafterf(rounded, INFINITY) - rounded);
  return fabs(value - exact) / unit;
}

START_TEST(sine_and_cosine)
{
  double worst = 0;
  float s, c;
  for (int i = -200000; i <= 200000; i++) {
    float angle = (float)i * 0.005f;
    sbri_sincos(angle, &s, &c);
    worst = fmax(worst, fmax(ulps(s, sin(angle)), ulps(c, cos(angle))));
  }
  ck_assert_double_le(worst, 1.0);
  sbri_sincos(0, &s, &c);
  ck_assert(s == 0 && c == 1);
  sbri_sincos(NAN, &s, &c);
  ck_assert(isnan(s) && isnan(c));
  sbri_sincos(INFINITY, &s, &c);
  ck_assert(s == 0 && c == 1);
}
END_TEST

START_TEST(arcs)
{
  double worst = 0;
  for (int i = -3000; i <= 3000; i++)
    for (int j = -50; j <= 50; j++) {
      float y = (float)i * 0.001f, x = (float)j * 0.06f;
      if (i == 0 && j == 0) continue;
      worst = fmax(worst, ulps(sbri_atan2(y, x), i == 0 && j < 0 ? acos(-1) : atan2(y, x)));
    }
  ck_assert_double_le(worst, 1.0);
  for (int i = -10000; i <= 10000; i++) {
    float x = (float)i * 1e-4f;
    ck_assert_double_le(ulps(sbri_acos(x), acos(x)), 1.0);
  }
  ck_assert_float_eq(sbri_acos(1.5f), 0);
  ck_assert_float_eq(sbri_atan2(0, 0), 0);
  ck_assert_float_eq_tol(sbri_atan2(INFINITY, 1), 1.5707963f, 1e-6f);
}
END_TEST

START_TEST(exponential)
{
  for (int i = -86990; i <= 88690; i += 7) {
    float x = (float)i * 0.001f;
    ck_assert_double_le(ulps(sbri_exp(x), exp(x)), 1.0);
  }
  ck_assert_float_eq(sbri_exp(0), 1);
  ck_assert_float_eq(sbri_exp(-1000), 0);
  ck_assert_float_eq(sbri_exp(1000), FLT_MAX);
}
END_TEST

START_TEST(logarithm)
{
  for (int i = -1200; i <= 1200; i++) {
    float x = (float)exp2(0.1 * i + 0.003 * (i % 7));
    ck_assert_double_le(ulps(sbri_log(x), log((double)x)), 1.0);
  }
  ck_assert_float_eq(sbri_log(1), 0);
  ck_assert_float_eq(sbri_log(0), -87);
  ck_assert_float_eq(sbri_log(-3), -87);
  ck_assert_float_eq_tol(sbri_angle_between(3, -3), 6 - 6.2831853f, 1e-6f);
  ck_assert_float_eq_tol(sbri_angle_between(-3, 3), 6.2831853f - 6, 1e-6f);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("trig");
  TCase *c = tcase_create("trig");
  tcase_add_test(c, sine_and_cosine);
  tcase_add_test(c, arcs);
  tcase_add_test(c, exponential);
  tcase_add_test(c, logarithm);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
