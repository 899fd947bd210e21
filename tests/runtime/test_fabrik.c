#include "harness.h"
#include "ik_chains.h"

START_TEST(reaches_targets_within_range)
{ ik_expect_reaches(sbri_fabrik, 15, 199); }
END_TEST

START_TEST(keeps_limits)
{ ik_expect_keeps_limits(sbri_fabrik, 150); }
END_TEST

START_TEST(keeps_hinges)
{ ik_expect_keeps_hinges(sbri_fabrik, 180); }
END_TEST

START_TEST(stretches_towards_targets_out_of_range)
{ ik_expect_stretches_to(sbri_fabrik); }
END_TEST

START_TEST(bows_towards_the_pole)
{ ik_expect_bows_to_pole(sbri_fabrik); }
END_TEST

START_TEST(copies_the_target_s_rotation)
{ ik_expect_copies_rotation(sbri_fabrik); }
END_TEST

START_TEST(invalid_targets_keep_it_finite)
{ ik_expect_survives(sbri_fabrik); }
END_TEST

START_TEST(targets_out_of_range_need_one_pass_and_are_exact)
{
  ik_chain_fixture f;
  ik_chain_bent(&f);
  f.chain.target = sbri_vec3(8, 8, 8);
  sbri_ik_result r = sbri_fabrik(&f.chain);
  ck_assert_uint_eq(r.iterations, 1);
  sbr_transform frames[IK_CHAIN_JOINTS];
  sbri_ik_compute_frames(&f.chain, frames);
  sbf_vec3 best = sbri_scale(sbri_normalize(f.chain.target, f.chain.target), 10);
  ck_assert_float_le(sbri_length(sbri_sub(frames[10].position, best)), 1e-4f);
}
END_TEST

/* A trunk of two links that forks into two arms of three. */
enum { TREE = 9 };
static const uint32_t tree_parents[TREE] = {0, 0, 1, 2, 3, 4, 2, 6, 7};
static void make_tree(sbri_ik_joint *joints) {
  for (int i = 0; i < TREE; i++) {
    joints[i] = (sbri_ik_joint){.offset = {0, i ? 1.0f : 0, 0}, .rotation = {0, 0, 0, 1}};
    if (i == 3) joints[i].offset = sbri_vec3(0.5f, 0.2f, 0);
    if (i == 6) joints[i].offset = sbri_vec3(-0.5f, 0.2f, 0);
  }
}

static sbri_ik_result reach_with_both(sbri_ik_joint *joints, sbf_vec3 left, sbf_vec3 right) {
  const sbri_ik_goal goals[2] = {{5, left}, {8, right}};
  sbri_ik_tree tree = {.base = {{0, 0, 0}, {0, 0, 0, 1}},
      .joints = joints,
      .parents = tree_parents,
      .count = TREE,
      .goals = goals,
      .goal_count = 2,
      .tolerance = 1e-3f,
      .iterations = 100};
  return sbri_fabrik_tree(&tree);
}

START_TEST(two_arms_reach_two_targets)
{
  uint32_t seed = 3;
  int reached = 0;
  for (int i = 0; i < 100; i++) {
    sbri_ik_joint joints[TREE];
    make_tree(joints);
    sbf_vec3 left = sbri_add(sbri_vec3(1, 2, 0), ik_random_place(&seed, 1));
    sbf_vec3 right = sbri_add(sbri_vec3(-1, 2, 0), ik_random_place(&seed, 1));
    reached += reach_with_both(joints, left, right).reached;
  }
  ck_assert_int_ge(reached, 95);
}
END_TEST

START_TEST(arms_that_cannot_both_reach_divide_the_error)
{
  sbri_ik_joint joints[TREE];
  make_tree(joints);
  sbri_ik_result r = reach_with_both(joints, sbri_vec3(9, 0, 0), sbri_vec3(-9, 0, 0));
  ck_assert(!r.reached);
  ck_assert_float_ge(r.error, 5);
  ck_assert_float_le(r.error, 7.5f);
}
END_TEST

START_TEST(extension_is_eased)
{ ik_expect_eases(sbri_fabrik, 0.01f); }
END_TEST

int main(void) {
  Suite *suite = suite_create("fabrik");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, reaches_targets_within_range);
  tcase_add_test(tests, keeps_limits);
  tcase_add_test(tests, keeps_hinges);
  tcase_add_test(tests, stretches_towards_targets_out_of_range);
  tcase_add_test(tests, bows_towards_the_pole);
  tcase_add_test(tests, copies_the_target_s_rotation);
  tcase_add_test(tests, invalid_targets_keep_it_finite);
  tcase_add_test(tests, targets_out_of_range_need_one_pass_and_are_exact);
  tcase_add_test(tests, two_arms_reach_two_targets);
  tcase_add_test(tests, arms_that_cannot_both_reach_divide_the_error);
  tcase_add_test(tests, extension_is_eased);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
