#include "animation/skeleton/rig_limits.h"
#include "gait_stage.h"
#include "harness.h"
#include "quadruped.h"

enum { FORE_FOOT = 16 };

START_TEST(a_limb_reaches_while_the_others_stand)
{
  for (int solver = 0; solver <= SBF_IK_SOLVER_DAMPED_LEAST_SQUARES; solver++) {
    gait_stage s;
    sbf_asset *asset = quadruped_asset();
    ((sbf_ik_chain *)(uintptr_t)&asset->ik_chains.at[2])->solver = (sbf_ik_solver)solver;
    gait_stage_begin(&s, asset);
    sbf_vec3 target = {0.15f, 0.15f, 0.3f};
    sbri_limb_targets(&s.rig, s.state)[2] = (sbri_limb_target){target, {0, 0, 0, 1}, 1};
    gait_stage_ticks(&s, 20);
    ck_assert_float_le(sbri_length(sbri_sub(s.pose[FORE_FOOT].position, target)), 1e-3f);
    ck_assert_float_le(sbri_length(sbri_sub(s.pose[10].position, s.rig.bones.rest[10].position)), 1e-4f);
    sbri_gait_rebase(&s.rig, s.state, sbri_vec3(4, 0, 0)); /* the origin moves, the target does not */
    ck_assert_float_eq_tol(sbri_limb_targets(&s.rig, s.state)[2].position.x, target.x - 4, 1e-6f);
    sbri_gait_rebase(&s.rig, s.state, sbri_vec3(-4, 0, 0));
    sbri_limb_targets(&s.rig, s.state)[2].weight = 0.5f;
    gait_stage_ticks(&s, 1);
    float halfway = sbri_length(sbri_sub(s.pose[FORE_FOOT].position, target));
    ck_assert_float_gt(halfway, 0.01f);
    sbri_limb_targets(&s.rig, s.state)[2].weight = 0;
    gait_stage_ticks(&s, 1);
    ck_assert_float_le(
        sbri_length(sbri_sub(s.pose[FORE_FOOT].position, s.rig.bones.rest[FORE_FOOT].position)), 1e-4f);
    gait_stage_end(&s);
  }
}
END_TEST

START_TEST(a_leg_is_kept_within_its_limits)
{
  gait_stage s;
  gait_stage_begin(&s, quadruped_asset());
  sbri_joint_limit *limits = (sbri_joint_limit *)(uintptr_t)s.rig.bones.limits;
  for (int b = 8; b < 10; b++) /* thigh and shin: at most 0.05 rad from rest */
    limits[b] = (sbri_joint_limit){.before = {0, 0, 0, 1},
        .after = {0, 0, 0, 1},
        .twist = {-0.05f, 0.05f},
        .swing_y = {-0.05f, 0.05f},
        .swing_z = {-0.05f, 0.05f},
        .cone = 0.05f,
        .active = true};
  s.input.forward = 0.3f;
  for (int i = 0; i < 240; i++) {
    gait_stage_ticks(&s, 1);
    ck_assert_float_le(sbri_rig_limit_excess(&s.rig, s.pose), 2e-4f);
  }
  gait_stage_end(&s);
}
END_TEST

START_TEST(rotating_about_a_foot_keeps_its_position)
{
  gait_stage s;
  gait_stage_begin(&s, quadruped_asset());
  s.input.turn = 0.8f;
  sbf_vec3 foot = s.state->feet[0].ground;
  s.state->stepping.pivot_leg = 1;
  sbf_vec3 arm = sbri_sub(s.state->motion.position, foot);
  for (int i = 0; i < 300; i++) {
    gait_stage_ticks(&s, 1);
    /* The body orbits the foot by the angle of its heading. */
    sbf_vec3 now = sbri_sub(s.state->motion.position, foot);
    sbf_vec3 round = sbri_rotate(sbri_quat_about(sbri_vec3(0, 1, 0), s.state->motion.heading), arm);
    ck_assert_float_eq_tol(now.x, round.x, 0.02f * sbri_length(arm));
    ck_assert_float_eq_tol(now.z, round.z, 0.02f * sbri_length(arm));
  }
  ck_assert_float_le(sbri_length(sbri_sub(s.state->feet[0].ground, foot)), 1e-6f);
  ck_assert_uint_eq(s.state->feet[0].steps_taken, 0);
  ck_assert_uint_ge(s.state->feet[3].steps_taken, 3);
  ck_assert_float_gt(fabsf(s.state->motion.heading), 0.5f);
  gait_stage_end(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("limbs");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_limb_reaches_while_the_others_stand);
  tcase_add_test(tests, a_leg_is_kept_within_its_limits);
  tcase_add_test(tests, rotating_about_a_foot_keeps_its_position);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
