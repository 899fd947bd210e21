#include "gait/gait_state.h"
#include "harness.h"
#include "quadruped.h"

#include <stdlib.h>

enum { BONES = 20, FORE_FOOT = 16 };

START_TEST(a_limb_reaches_while_the_others_stand)
{
  for (int solver = 0; solver <= SBF_IK_SOLVER_DAMPED_LEAST_SQUARES; solver++) {
    quadruped q;
    quadruped_create(&q);
    ((sbf_ik_chain *)(uintptr_t)&q.asset->ik_chains.at[2])->solver = (sbf_ik_solver)solver;
    sbr_ground ground = sbr_ground_flat(0);
    sbri_gait_input input = {.tick_s = 1.0f / 60, .scale = 1, .ground = &ground};
    sbri_gait_state *state = malloc(sbri_gait_state_size(&q.rig));
    sbr_transform pose[BONES];
    sbri_gait_place(&q.rig, state, &input, sbri_vec3(0, 0, 0), 0);
    sbf_vec3 target = {0.15f, 0.15f, 0.3f};
    sbri_limb_targets(&q.rig, state)[2] = (sbri_limb_target){target, {0, 0, 0, 1}, 1};
    for (int i = 0; i < 20; i++) sbri_gait_tick(&q.rig, state, &input, pose, NULL, 0);
    ck_assert_float_le(sbri_length(sbri_sub(pose[FORE_FOOT].position, target)), 1e-3f);
    ck_assert_float_le(sbri_length(sbri_sub(pose[10].position, q.rig.rest[10].position)), 1e-4f);
    sbri_gait_rebase(&q.rig, state, sbri_vec3(4, 0, 0)); /* the origin moves, the target does not */
    ck_assert_float_eq_tol(sbri_limb_targets(&q.rig, state)[2].position.x, target.x - 4, 1e-6f);
    sbri_gait_rebase(&q.rig, state, sbri_vec3(-4, 0, 0));
    sbri_limb_targets(&q.rig, state)[2].weight = 0.5f;
    sbri_gait_tick(&q.rig, state, &input, pose, NULL, 0);
    float halfway = sbri_length(sbri_sub(pose[FORE_FOOT].position, target));
    ck_assert_float_gt(halfway, 0.01f);
    sbri_limb_targets(&q.rig, state)[2].weight = 0;
    sbri_gait_tick(&q.rig, state, &input, pose, NULL, 0);
    ck_assert_float_le(
        sbri_length(sbri_sub(pose[FORE_FOOT].position, q.rig.rest[FORE_FOOT].position)), 1e-4f);
    free(state);
    quadruped_destroy(&q);
  }
}
END_TEST

START_TEST(a_leg_is_kept_within_its_limits)
{
  quadruped q;
  quadruped_create(&q);
  sbri_joint_limit *limits = (sbri_joint_limit *)(uintptr_t)q.rig.limits;
  for (int b = 8; b < 10; b++) /* thigh and shin: no more than 0.05 rad from rest */
    limits[b] = (sbri_joint_limit){.before = {0, 0, 0, 1},
        .after = {0, 0, 0, 1},
        .twist = {-0.05f, 0.05f},
        .swing_y = {-0.05f, 0.05f},
        .swing_z = {-0.05f, 0.05f},
        .cone = 0.05f,
        .active = true};
  sbr_ground ground = sbr_ground_flat(0);
  sbri_gait_input input = {.tick_s = 1.0f / 60, .scale = 1, .ground = &ground, .forward = 0.3f};
  sbri_gait_state *state = malloc(sbri_gait_state_size(&q.rig));
  sbr_transform pose[BONES];
  sbri_gait_place(&q.rig, state, &input, sbri_vec3(0, 0, 0), 0);
  for (int i = 0; i < 240; i++) {
    sbri_gait_tick(&q.rig, state, &input, pose, NULL, 0);
    ck_assert_float_le(sbri_rig_limit_excess(&q.rig, pose), 2e-4f);
  }
  free(state);
  quadruped_destroy(&q);
}
END_TEST

START_TEST(turning_about_a_foot_leaves_it_where_it_is)
{
  quadruped q;
  quadruped_create(&q);
  sbr_ground ground = sbr_ground_flat(0);
  sbri_gait_input input = {.tick_s = 1.0f / 60, .scale = 1, .ground = &ground, .turn = 0.8f};
  sbri_gait_state *state = malloc(sbri_gait_state_size(&q.rig));
  sbr_transform pose[BONES];
  sbri_gait_place(&q.rig, state, &input, sbri_vec3(0, 0, 0), 0);
  sbf_vec3 foot = state->feet[0].ground;
  state->pivot = 1;
  for (int i = 0; i < 300; i++) sbri_gait_tick(&q.rig, state, &input, pose, NULL, 0);
  ck_assert_float_le(sbri_length(sbri_sub(state->feet[0].ground, foot)), 1e-6f);
  ck_assert_uint_eq(state->feet[0].steps_taken, 0);
  ck_assert_uint_ge(state->feet[3].steps_taken, 3);
  ck_assert_float_gt(fabsf(state->heading), 0.5f);
  free(state);
  quadruped_destroy(&q);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("limbs");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_limb_reaches_while_the_others_stand);
  tcase_add_test(tests, a_leg_is_kept_within_its_limits);
  tcase_add_test(tests, turning_about_a_foot_leaves_it_where_it_is);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
