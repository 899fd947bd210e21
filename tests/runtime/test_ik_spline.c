#include "harness.h"
#include "ik_chains.h"

START_TEST(ends_at_the_target_on_one_smooth_bow)
{
  uint32_t seed = 31;
  for (int i = 0; i < 100; i++) {
    ik_chain_fixture f;
    ik_chain_bent(&f);
    f.chain.has_pole = true;
    sbf_vec3 towards = sbri_normalize(ik_random_place(&seed, 1), sbri_vec3(0, 1, 0));
    f.chain.target = sbri_scale(towards, 5 + 2 * ik_random(&seed));
    f.chain.pole = ik_random_place(&seed, 20);
    sbri_ik_result r = sbri_ik_spline(&f.chain);
    ck_assert_float_le(r.error, 0.02f);
    sbr_transform frames[IK_CHAIN_JOINTS];
    sbri_ik_compute_frames(&f.chain, frames);
    float min = 1;
    for (int k = 2; k < IK_CHAIN_JOINTS; k++) {
      sbf_vec3 a = sbri_sub(frames[k - 1].position, frames[k - 2].position);
      sbf_vec3 b = sbri_sub(frames[k].position, frames[k - 1].position);
      min = fminf(min, sbri_dot(a, b));
    }
    ck_assert_float_ge(min, -0.5f); /* no sharp bends */
  }
}
END_TEST

START_TEST(keeps_limits)
{
  ik_chain_fixture f;
  ik_chain_bent(&f);
  ik_chain_limit(&f, 0.3f);
  f.chain.target = sbri_vec3(2, 3, 1);
  sbri_ik_spline(&f.chain);
  ck_assert_float_le(ik_chain_excess(&f), 2e-5f);
}
END_TEST

START_TEST(keeps_hinges)
{ ik_expect_keeps_hinges(sbri_ik_spline, 0); }
END_TEST

START_TEST(targets_out_of_range_straighten_the_chain)
{
  ik_chain_fixture f;
  ik_chain_bent(&f);
  f.chain.target = sbri_vec3(0, 0, 20);
  sbri_ik_result r = sbri_ik_spline(&f.chain);
  ck_assert_float_eq_tol(r.error, 10, 0.02f);
}
END_TEST

START_TEST(invalid_targets_keep_it_finite)
{
  ik_chain_fixture f;
  ik_chain_straight(&f);
  f.chain.target = sbri_vec3(0, 0, 0);
  sbri_ik_result r = sbri_ik_spline(&f.chain);
  ck_assert(isfinite(r.error));
}
END_TEST

START_TEST(extension_is_eased)
{ ik_expect_eases(sbri_ik_spline, 0.002f); }
END_TEST

START_TEST(copies_the_target_s_rotation)
{ ik_expect_copies_rotation(sbri_ik_spline); }
END_TEST

int main(void) {
  Suite *suite = suite_create("ik_spline");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, ends_at_the_target_on_one_smooth_bow);
  tcase_add_test(tests, keeps_limits);
  tcase_add_test(tests, keeps_hinges);
  tcase_add_test(tests, targets_out_of_range_straighten_the_chain);
  tcase_add_test(tests, invalid_targets_keep_it_finite);
  tcase_add_test(tests, extension_is_eased);
  tcase_add_test(tests, copies_the_target_s_rotation);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
