#include "animation/gait/gait_state.h"
#include "gait_stage.h"
#include "harness.h"
#include "quadruped.h"

static const sbf_vec3 UP = {0, 1, 0};
static const float TURNED = 0.7f, FOOT_TURNED = -0.3f, SCALE = 1.5f;

/* A quadruped that has turned, its first foot by another angle, with its ankle beside its sole. */
static sbri_foot *begin(gait_stage *stage) {
  gait_stage_begin_scaled(stage, quadruped_asset(), 1.0f / 60, SCALE);
  stage->rig.legs[0].home.ankle = sbri_vec3(0.02f, 0.03f, -0.05f);
  sbri_gait_reset(&stage->rig, stage->state, &stage->input, sbri_vec3(0, 0, 0), TURNED);
  sbri_foot *foot = &stage->state->feet[0];
  foot->heading = FOOT_TURNED;
  return foot;
}

static void expect_near(sbf_vec3 a, sbf_vec3 b) {
  ck_assert_float_le(sbri_length(sbri_sub(a, b)), 1e-5f);
}

static sbf_vec3 beside_at(float yaw) {
  return sbri_rotate(sbri_quat_about(UP, yaw), sbri_vec3(0.02f * SCALE, 0, -0.05f * SCALE));
}

START_TEST(on_level_ground_only_the_heading_changes)
{
  gait_stage stage;
  sbri_foot *foot = begin(&stage);
  sbri_foot_update_orientation(&stage.rig, stage.state, &stage.input, 0);
  sbf_vec3 ahead = sbri_rotate(foot->frame.rotation, sbri_vec3(0, 0, 1));
  expect_near(ahead, sbri_vec3(foot->frame.sine, 0, foot->frame.cosine));
  expect_near(ahead, sbri_rotate(sbri_quat_about(UP, TURNED + FOOT_TURNED), sbri_vec3(0, 0, 1)));
  expect_near(foot->frame.ankle_offset, beside_at(TURNED + FOOT_TURNED));
  expect_near(foot->frame.home_ankle_offset, beside_at(TURNED));
  gait_stage_end(&stage);
}
END_TEST

START_TEST(on_a_slope_it_tilts_with_it)
{
  gait_stage stage;
  sbri_foot *foot = begin(&stage);
  foot->normal = sbri_normalize(sbri_vec3(-0.3f, 1, 0.2f), UP);
  sbri_foot_update_orientation(&stage.rig, stage.state, &stage.input, 0);
  expect_near(sbri_rotate(foot->frame.rotation, UP), foot->normal);
  ck_assert_float_eq_tol(sbri_dot(foot->frame.ankle_offset, foot->normal), 0, 1e-6f); /* along the ground */
  ck_assert_float_eq_tol(sbri_dot(foot->frame.home_ankle_offset, foot->normal), 0, 1e-6f);
  ck_assert_float_eq_tol(sbri_length(foot->frame.ankle_offset), sbri_length(beside_at(0)), 1e-6f);
  ck_assert_float_gt(sbri_length(sbri_sub(foot->frame.ankle_offset, foot->frame.home_ankle_offset)), 0.01f);
  gait_stage_end(&stage);
}
END_TEST

START_TEST(a_rotating_body_changes_only_the_heading_of_the_foot)
{
  gait_stage stage;
  sbri_foot *foot = begin(&stage);
  sbri_foot_update_orientation(&stage.rig, stage.state, &stage.input, 0);
  sbri_foot before = *foot;
  stage.state->motion.heading_sine = 1, stage.state->motion.heading_cosine = 0;
  sbri_foot_update_heading(&stage.rig, stage.state, &stage.input, 0);
  expect_near(foot->frame.home_ankle_offset, beside_at(1.57079633f));
  expect_near(foot->frame.ankle_offset, before.frame.ankle_offset);
  ck_assert(foot->frame.sine == before.frame.sine && foot->frame.rotation.y == before.frame.rotation.y);
  gait_stage_end(&stage);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("foot_faces");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, on_level_ground_only_the_heading_changes);
  tcase_add_test(tests, on_a_slope_it_tilts_with_it);
  tcase_add_test(tests, a_rotating_body_changes_only_the_heading_of_the_foot);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
