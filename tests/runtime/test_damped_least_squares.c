#include "harness.h"
#include "ik_chains.h"

START_TEST(reaches_targets_within_range)
{ ik_expect_reaches(sbri_damped_least_squares, 30, 195); }
END_TEST

START_TEST(keeps_limits)
{ ik_expect_keeps_limits(sbri_damped_least_squares, 150); }
END_TEST

START_TEST(keeps_hinges)
{ ik_expect_keeps_hinges(sbri_damped_least_squares, 190); }
END_TEST

START_TEST(stretches_towards_targets_out_of_range)
{ ik_expect_stretches_to(sbri_damped_least_squares); }
END_TEST

START_TEST(bows_towards_the_pole)
{ ik_expect_bows_to_pole(sbri_damped_least_squares); }
END_TEST

START_TEST(copies_the_target_s_rotation)
{ ik_expect_copies_rotation(sbri_damped_least_squares); }
END_TEST

START_TEST(invalid_targets_keep_it_finite)
{ ik_expect_survives(sbri_damped_least_squares); }
END_TEST

START_TEST(comfort_angles_act_without_moving_the_end)
{
  ik_chain_fixture f, comfortable;
  ik_chain_bent(&f);
  f.chain.target = sbri_vec3(3, 4, 2);
  comfortable = f;
  comfortable.chain.joints = comfortable.joints;
  comfortable.joints[1].comfort = sbri_quat_about(sbri_vec3(0, 0, 1), 1.2f);
  comfortable.joints[1].comfort_weight = 1;
  ck_assert(sbri_damped_least_squares(&f.chain).reached);
  ck_assert(sbri_damped_least_squares(&comfortable.chain).reached);
  sbf_quat wanted = comfortable.joints[1].comfort;
  sbf_quat off = sbri_quat_multiply(wanted, sbri_quat_conjugate(f.joints[1].rotation));
  sbf_quat near = sbri_quat_multiply(wanted, sbri_quat_conjugate(comfortable.joints[1].rotation));
  ck_assert_float_lt(sbri_length(sbri_quat_log(near)), 0.6f * sbri_length(sbri_quat_log(off)));
}
END_TEST

/* A comfort weight has no effect about axes that it excludes, and its full effect about the others. */
START_TEST(comforts_act_by_axis)
{
  ik_chain_fixture f[4];
  for (int k = 0; k < 4; k++) {
    ik_chain_bent(&f[k]);
    f[k].chain.joints = f[k].joints;
    f[k].chain.target = sbri_vec3(3, 4, 2);
    for (uint32_t i = 0; k > 0 && i < f[k].chain.count; i++) {
      f[k].joints[i].comfort = f[k].joints[i].rotation;
      if (i == 1) f[k].joints[i].comfort = sbri_quat_about(sbri_vec3(0, 0, 1), 1.2f);
      f[k].joints[i].comfort_weight = i == 1;
    }
    if (k == 2) f[k].joints[1].comfort_slack = sbri_vec3(1, 1, 1);
    if (k == 3) f[k].joints[1].comfort_slack = sbri_vec3(1, 0.5f, 0);
    ck_assert(sbri_damped_least_squares(&f[k].chain).reached);
  }
  float off[4];
  for (int k = 0; k < 4; k++) {
    sbf_quat back = sbri_quat_conjugate(f[k].joints[1].rotation);
    off[k] = fabsf(sbri_quat_log(sbri_quat_multiply(back, f[1].joints[1].comfort)).z);
  }
  ck_assert_float_eq_tol(off[2], off[0], 1e-6f);
  ck_assert_float_lt(off[3], 0.6f * off[0]);
  ck_assert_float_lt(fabsf(off[3] - off[1]), 0.5f * off[0]);
}
END_TEST

START_TEST(extension_is_eased)
{ ik_expect_eases(sbri_damped_least_squares, 0.002f); }
END_TEST

int main(void) {
  Suite *suite = suite_create("damped_least_squares");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, reaches_targets_within_range);
  tcase_add_test(tests, keeps_limits);
  tcase_add_test(tests, keeps_hinges);
  tcase_add_test(tests, stretches_towards_targets_out_of_range);
  tcase_add_test(tests, bows_towards_the_pole);
  tcase_add_test(tests, copies_the_target_s_rotation);
  tcase_add_test(tests, invalid_targets_keep_it_finite);
  tcase_add_test(tests, comfort_angles_act_without_moving_the_end);
  tcase_add_test(tests, comforts_act_by_axis);
  tcase_add_test(tests, extension_is_eased);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
