#include "harness.h"
#include "ik_chains.h"

static float separation(sbf_quat a, sbf_quat b) {
  return sbri_length(sbri_quat_log(sbri_quat_multiply(a, sbri_quat_conjugate(b))));
}

static bool same(sbf_quat a, sbf_quat b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

static sbri_joint_limit random_limit(uint32_t *seed) {
  sbri_joint_limit limit = {
      .before = ik_random_rotation(seed), .after = ik_random_rotation(seed), .active = true};
  float *ranges[3] = {limit.twist, limit.swing_y, limit.swing_z};
  for (int i = 0; i < 3; i++) {
    ranges[i][0] = -1.5f * fabsf(ik_random(seed));
    ranges[i][1] = 1.5f * fabsf(ik_random(seed));
  }
  limit.cone = 0.2f + 2 * fabsf(ik_random(seed));
  return limit;
}

START_TEST(parts_multiply_to_the_whole)
{
  uint32_t seed = 1;
  for (int i = 0; i < 20000; i++) {
    sbf_quat q = ik_random_rotation(&seed);
    sbri_swing_twist p = sbri_swing_twist_of(q);
    ck_assert_float_le(separation(sbri_swing_twist_join(p), q), 2e-5f);
    ck_assert_float_le(fabsf(p.twist), 3.1415928f);
    ck_assert_float_le(p.swing_y * p.swing_y + p.swing_z * p.swing_z, 9.8697f);
  }
}
END_TEST

START_TEST(poses_within_the_limit_are_unchanged)
{
  uint32_t seed = 2;
  int within = 0;
  for (int i = 0; i < 20000; i++) {
    sbri_joint_limit limit = random_limit(&seed);
    sbf_quat q = ik_random_rotation(&seed);
    if (sbri_joint_limit_excess(&limit, q) > 0) continue;
    within++;
    ck_assert(same(sbri_joint_limit_clamp(&limit, q), q));
  }
  ck_assert_int_gt(within, 100);
}
END_TEST

START_TEST(twice_is_once)
{
  uint32_t seed = 3;
  for (int i = 0; i < 20000; i++) {
    sbri_joint_limit limit = random_limit(&seed);
    sbf_quat once = sbri_joint_limit_clamp(&limit, ik_random_rotation(&seed));
    ck_assert_float_le(sbri_joint_limit_excess(&limit, once), 1e-5f);
    ck_assert(same(sbri_joint_limit_clamp(&limit, once), once));
  }
}
END_TEST

START_TEST(a_hinge_keeps_the_rotation_about_its_axis)
{
  sbri_joint_limit hinge = {
      .before = {0, 0, 0, 1}, .after = {0, 0, 0, 1}, .twist = {-0.5f, 2}, .cone = 0, .active = true};
  sbf_quat about_x = sbri_quat_about(sbri_vec3(1, 0, 0), 1.1f);
  sbf_quat off = sbri_quat_multiply(sbri_quat_about(sbri_vec3(0, 0.6f, 0.8f), 0.4f), about_x);
  ck_assert_float_le(separation(sbri_joint_limit_clamp(&hinge, off), about_x), 1e-5f);
  sbf_quat far = sbri_quat_about(sbri_vec3(1, 0, 0), 2.9f), bound = sbri_quat_about(sbri_vec3(1, 0, 0), 2);
  ck_assert_float_le(separation(sbri_joint_limit_clamp(&hinge, far), bound), 1e-5f);
}
END_TEST

START_TEST(the_nearer_bound_is_used_across_half_a_rotation)
{
  sbri_joint_limit limit = {
      .before = {0, 0, 0, 1}, .after = {0, 0, 0, 1}, .twist = {-3, 1}, .cone = 1, .active = true};
  sbf_quat q = sbri_quat_about(sbri_vec3(1, 0, 0), 3.1f); /* nearer to -3 than to 1 */
  sbf_quat bound = sbri_quat_about(sbri_vec3(1, 0, 0), -3);
  ck_assert_float_le(separation(sbri_joint_limit_clamp(&limit, q), bound), 1e-5f);
  ck_assert(same(sbri_joint_limit_clamp(NULL, q), q));
}
END_TEST

/* Also near limits, where it must not exceed the angles' own excess. */
START_TEST(precomputed_bounds_do_not_change_results)
{
  uint32_t seed = 4;
  int pinned = 0, broken = 0;
  for (int i = 0; i < 100000; i++) {
    sbri_joint_limit slow = random_limit(&seed);
    if (i % 3 == 1) slow.cone = 0; /* a hinge */
    if (i % 3 == 2) slow.twist[0] = -3.2f, slow.twist[1] = 3.2f;
    sbri_joint_limit ready = slow;
    sbri_joint_limit_ready(&ready);
    sbf_quat q = sbri_joint_limit_clamp(&slow, ik_random_rotation(&seed)); /* often on a bound */
    float size = i % 2 ? 1e-6f : 0.02f;
    sbf_quat moved = sbri_quat_multiply(q, sbri_quat_exp(sbri_scale(ik_random_place(&seed, 1), size)));
    float excess = sbri_joint_limit_excess(&slow, moved);
    if (fabsf(excess - 1e-5f) < 1e-6f) continue; /* as near as rounding */
    bool holds = sbri_joint_limit_holds(&ready, moved, 1e-5f);
    ck_assert_int_eq(holds, excess <= 1e-5f);
    ck_assert(same(sbri_joint_limit_clamp(&ready, moved), sbri_joint_limit_clamp(&slow, moved)));
    *(holds ? &pinned : &broken) += 1;
  }
  ck_assert_int_gt(pinned, 10000);
  ck_assert_int_gt(broken, 10000);
}
END_TEST

static void expect_swing(const sbri_joint_limit *limit, float y, float z, float to_y, float to_z) {
  sbf_quat q = sbri_swing_twist_join((sbri_swing_twist){.twist = 0.1f, .swing_y = y, .swing_z = z});
  sbri_swing_twist p = sbri_swing_twist_of(sbri_joint_limit_clamp(limit, q));
  ck_assert_float_eq_tol(p.swing_y, to_y, 2e-5f);
  ck_assert_float_eq_tol(p.swing_z, to_z, 2e-5f);
  ck_assert_float_eq_tol(p.twist, 0.1f, 2e-5f);
}

/* A box of swing limits that excludes 0: the result stays in the box, even where a narrower cone would leave
 * it. */
START_TEST(a_box_without_zero_wins_over_the_cone)
{
  sbri_joint_limit limit = {.before = {0, 0, 0, 1},
      .after = {0, 0, 0, 1},
      .twist = {-1, 1},
      .swing_y = {0.3f, 0.6f},
      .swing_z = {-0.5f, 0.5f},
      .cone = 3,
      .active = true};
  expect_swing(&limit, 0, 0, 0.3f, 0);
  expect_swing(&limit, -0.4f, 0.2f, 0.3f, 0.2f);
  expect_swing(&limit, 0.9f, -0.7f, 0.6f, -0.5f);
  expect_swing(&limit, 0.4f, 0.1f, 0.4f, 0.1f);
  limit.cone = 0.2f;
  expect_swing(&limit, 0.4f, 0, 0.3f, 0);
  expect_swing(&limit, 0.4f, 0.3f, 0.3f, 0.12f); /* z as the cone has it */
  ck_assert_float_eq_tol(sbri_joint_limit_excess(&limit, (sbf_quat){0, 0, 0, 1}), 0.3f, 1e-5f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("joint_limit");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, parts_multiply_to_the_whole);
  tcase_add_test(tests, poses_within_the_limit_are_unchanged);
  tcase_add_test(tests, twice_is_once);
  tcase_add_test(tests, a_hinge_keeps_the_rotation_about_its_axis);
  tcase_add_test(tests, the_nearer_bound_is_used_across_half_a_rotation);
  tcase_add_test(tests, a_box_without_zero_wins_over_the_cone);
  tcase_add_test(tests, precomputed_bounds_do_not_change_results);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
