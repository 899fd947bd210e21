#include "math/follower.h"

#include "harness.h"

/* Answer to a step at time 0, r = 0, from rest; double precision. */
static double step_response(double f, double z, double t) {
  double w = 2 * 3.14159265358979 * f;
  if (z < 1) {
    double u = w * sqrt(1 - z * z);
    return 1 - exp(-z * w * t) * (cos(u * t) + z * w / u * sin(u * t));
  }
  if (z == 1) return 1 - exp(-w * t) * (1 + w * t);
  double u = w * sqrt(z * z - 1), a = z * w - u, b = z * w + u;
  return 1 - (b * exp(-a * t) - a * exp(-b * t)) / (b - a);
}

static const float ratios[] = {0, 0.2f, 0.7f, 1, 1.5f, 4};
enum { RATIOS = sizeof ratios / sizeof *ratios };

START_TEST(a_step_is_answered_exactly_at_any_frame_time)
{
  for (int k = 0; k < RATIOS; k++)
    for (int ms = 1; ms <= 250; ms += 7) {
      sbri_follower_step step = sbri_follower_step_of(2, ratios[k], 0, 0.001f * (float)ms);
      sbri_lag lag = {0, 0};
      for (int i = 1; i <= 40; i++) {
        sbri_lag_tick(&lag, 1, &step);
        double exact = step_response(2, (double)ratios[k], 0.001 * ms * i);
        ck_assert_double_eq_tol((double)lag.value, exact, 2e-5);
      }
    }
}
END_TEST

START_TEST(two_steps_are_one_of_twice_the_time)
{
  for (int k = 0; k < RATIOS; k++)
    for (int ms = 1; ms <= 125; ms += 5) {
      float h = 0.001f * (float)ms;
      sbri_follower_step once = sbri_follower_step_of(3, ratios[k], 1.5f, 2 * h);
      sbri_follower_step half = sbri_follower_step_of(3, ratios[k], 1.5f, h);
      sbri_position_follower a, b;
      sbri_position_follower_reset(&a, sbri_vec3(0, 0, 0));
      b = a;
      sbri_position_follower_tick(&a, sbri_vec3(1, -2, 0), &once); /* reaches the target linearly in 2 h */
      sbri_position_follower_tick(&b, sbri_vec3(0.5f, -1, 0), &half);
      sbri_position_follower_tick(&b, sbri_vec3(1, -2, 0), &half);
      ck_assert_float_le(sbri_length(sbri_sub(a.value, b.value)), 1e-5f);
      ck_assert_float_le(sbri_length(sbri_sub(a.rate, b.rate)), 2e-3f);
    }
}
END_TEST

START_TEST(it_follows_even_motion_at_a_constant_distance)
{
  sbri_follower_step step = sbri_follower_step_of(2, 0.7f, 0, 1.0f / 60);
  sbri_position_follower f;
  sbri_position_follower_reset(&f, sbri_vec3(0, 0, 0));
  float w = 6.2831853f * 2, behind = 2 * 0.7f / w; /* r = 0: 2 z / w seconds late */
  for (int i = 1; i <= 240; i++) sbri_position_follower_tick(&f, sbri_vec3((float)i / 60, 0, 0), &step);
  ck_assert_float_eq_tol(4 - f.value.x, behind, 1e-4f);
  sbri_follower_step ahead = sbri_follower_step_of(2, 0.7f, 2, 1.0f / 60);
  sbri_position_follower_reset(&f, sbri_vec3(0, 0, 0));
  for (int i = 1; i <= 240; i++) sbri_position_follower_tick(&f, sbri_vec3((float)i / 60, 0, 0), &ahead);
  ck_assert_float_eq_tol(f.value.x, 4, 1e-4f); /* r = 2: no delay */
}
END_TEST

START_TEST(rotations_follow_the_shorter_path_and_come_to_rest)
{
  sbri_follower_step step = sbri_follower_step_of(2, 0.5f, 0, 1.0f / 60);
  sbri_rotation_follower f;
  sbri_rotation_follower_reset(&f, sbri_quat_about(sbri_vec3(0, 1, 0), 3));
  sbf_quat to = sbri_quat_about(sbri_vec3(0, 1, 0), -3); /* 0.28 rad on, across half a turn */
  float beyond = 0;
  for (int i = 0; i < 240; i++) {
    sbri_rotation_follower_tick(&f, to, &step);
    sbf_vec3 off = sbri_quat_log(sbri_quat_multiply(f.value, sbri_quat_conjugate(to)));
    beyond = fmaxf(beyond, off.y);
    ck_assert_float_le(fabsf(off.y), 0.29f);
  }
  ck_assert_float_gt(beyond, 0.02f); /* it overshoots */
  ck_assert_float_le(sbri_length(sbri_quat_log(sbri_quat_multiply(f.value, sbri_quat_conjugate(to)))), 1e-4f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("follower");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_step_is_answered_exactly_at_any_frame_time);
  tcase_add_test(tests, two_steps_are_one_of_twice_the_time);
  tcase_add_test(tests, it_follows_even_motion_at_a_constant_distance);
  tcase_add_test(tests, rotations_follow_the_shorter_path_and_come_to_rest);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
