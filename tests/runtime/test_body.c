/* Tests how hips and chest rotate with the lines between the feet. Walks test the rest of the body. */
#include <math.h>

#include "gait_stage.h"
#include "harness.h"
#include "math/quat.h"
#include "quadruped.h"

enum { HIPS = 1, SPINE = 2, CHEST = 3 };
static const float AHEAD = 0.06f, ACROSS = 0.24f; /* m: a foot, of the other; between them, at rest */

static sbf_gait *gait_of(gait_stage *s) {
  return (sbf_gait *)(uintptr_t)&s->asset->gaits.at[0];
}

/* Places one foot the given distance ahead of its rest position. The body may face any direction. */
static sbri_stance stance_with(gait_stage *s, uint32_t leg, float ahead, float heading) {
  sbri_gait_reset(&s->rig, s->state, &s->input, sbri_vec3(0, 0, 0), heading);
  sbf_vec3 *foot = &s->state->feet[leg].ground;
  *foot = sbri_add(*foot, sbri_vec3(ahead * sinf(heading), 0, ahead * cosf(heading)));
  return sbri_body_stance(&s->rig, s->state, &s->input);
}

/* The hips rotate by `fraction` of the line's angle. The feet are wide enough apart for almost the full
 * effect. */
static void expect_turn(float yaw, float fraction, float side) {
  float angle = fraction * atan2f(AHEAD, ACROSS), turn = 0.8f * angle / (0.8f + angle);
  ck_assert_float_le(side * yaw, turn);
  ck_assert_float_ge(side * yaw, 0.9f * turn);
}

START_TEST(hips_rotate_with_the_line_between_the_feet)
{
  static const float headings[3] = {0, 1.1f, -2.7f}, fractions[3] = {0.5f, 1, 0};
  gait_stage s;
  gait_stage_begin(&s, quadruped_asset());
  gait_of(&s)->hip_tilt = fractions[_i];
  for (int h = 0; h < 3; h++) {
    ck_assert_float_le(fabsf(stance_with(&s, QUADRUPED_HIND_L, 0, headings[h]).hips_yaw), 1e-5f);
    /* About +Y, the side whose foot is ahead goes ahead. */
    expect_turn(stance_with(&s, QUADRUPED_HIND_L, AHEAD, headings[h]).hips_yaw, fractions[_i], -1);
    expect_turn(stance_with(&s, QUADRUPED_HIND_R, AHEAD, headings[h]).hips_yaw, fractions[_i], 1);
    expect_turn(stance_with(&s, QUADRUPED_HIND_R, -AHEAD, headings[h]).hips_yaw, fractions[_i], -1);
    ck_assert_float_le(fabsf(stance_with(&s, QUADRUPED_HIND_R, AHEAD, headings[h]).chest_yaw), 1e-5f);
  }
  gait_stage_end(&s);
}
END_TEST

START_TEST(the_chest_rotates_with_the_fore_feet_or_the_hips)
{
  gait_stage s;
  gait_stage_begin(&s, quadruped_asset());
  sbri_stance stance = stance_with(&s, QUADRUPED_FORE_L, AHEAD, 0);
  expect_turn(stance.chest_yaw, gait_of(&s)->hip_tilt, -1);
  ck_assert_float_le(fabsf(stance.hips_yaw), 1e-5f);
  gait_of(&s)->chest = -1;
  gait_stage_remake(&s);
  stance = stance_with(&s, QUADRUPED_HIND_L, AHEAD, 0);
  ck_assert_float_lt(stance.hips_yaw, -0.05f);
  ck_assert_float_eq(stance.chest_yaw, stance.hips_yaw);
  gait_stage_end(&s);
}
END_TEST

START_TEST(crossed_feet_do_not_reverse_the_hips)
{
  gait_stage s;
  gait_stage_begin(&s, quadruped_asset());
  gait_of(&s)->hip_tilt = 1;
  sbri_gait_reset(&s.rig, s.state, &s.input, sbri_vec3(0, 0, 0), 0);
  s.state->feet[QUADRUPED_HIND_L].ground = sbri_vec3(-0.3f, 0, 0.3f);
  s.state->feet[QUADRUPED_HIND_R].ground = sbri_vec3(0.3f, 0, -0.3f);
  float yaw = sbri_body_stance(&s.rig, s.state, &s.input).hips_yaw;
  ck_assert_float_lt(yaw, -0.3f);
  ck_assert_float_gt(yaw, -0.8f);
  gait_stage_end(&s);
}
END_TEST

/* Rotation of a posed bone about +Y, relative to its rest pose and the body's heading, rad. */
static float posed_yaw(const gait_stage *s, uint32_t bone) {
  sbf_quat turned =
      sbri_quat_multiply(s->pose[bone].rotation, sbri_quat_conjugate(s->rig.bones.rest[bone].rotation));
  sbf_vec3 faces = sbri_rotate(turned, sbri_vec3(0, 0, 1));
  return remainderf(atan2f(faces.x, faces.z) - s->state->motion.heading, 6.2831853f);
}

/* Raised for its belly, which nothing is below any more. */
START_TEST(a_raised_body_comes_down_smoothly)
{
  gait_stage s;
  gait_stage_begin(&s, quadruped_asset());
  s.input.forward = 0.2f;
  gait_stage_ticks(&s, 120);
  float raised = -0.1f * s.rig.stand.reach, was[2] = {0, 0}, worst = 0;
  s.state->balance.clearance = s.state->balance.crouch = (sbri_lag){raised, 0};
  for (int t = 0; t < 60; t++) {
    gait_stage_ticks(&s, 1);
    float height = s.state->posture.root.position.y;
    if (t > 1) worst = fmaxf(worst, fabsf(height - 2 * was[0] + was[1]));
    was[1] = was[0], was[0] = height;
  }
  ck_assert_float_lt(worst, -0.25f * raised);
  ck_assert_float_ge(s.state->posture.lowered, -1e-3f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(bones_rotate_so_as_it_walks)
{
  gait_stage s;
  gait_stage_begin(&s, quadruped_asset());
  gait_of(&s)->hip_tilt = _i ? 0.5f : 0;
  s.input.forward = 0.3f;
  float widest = 0;
  for (int i = 0; i < 300; i++) {
    gait_stage_ticks(&s, 1);
    sbf_vec3 left = s.state->feet[QUADRUPED_HIND_L].ground, right = s.state->feet[QUADRUPED_HIND_R].ground;
    float hips = posed_yaw(&s, HIPS), chest = posed_yaw(&s, CHEST), spine = posed_yaw(&s, SPINE);
    widest = fmaxf(widest, fabsf(hips));
    if (_i && fabsf(left.z - right.z) > 0.02f) ck_assert_float_lt(hips * (left.z - right.z), 0);
    ck_assert_float_ge(spine, fminf(hips, chest) - 1e-4f);
    ck_assert_float_le(spine, fmaxf(hips, chest) + 1e-4f);
  }
  if (_i)
    ck_assert_float_gt(widest, 0.05f);
  else
    ck_assert_float_le(widest, 1e-3f);
  gait_stage_end(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("body");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, hips_rotate_with_the_line_between_the_feet, 0, 3);
  tcase_add_test(tests, the_chest_rotates_with_the_fore_feet_or_the_hips);
  tcase_add_test(tests, crossed_feet_do_not_reverse_the_hips);
  tcase_add_test(tests, a_raised_body_comes_down_smoothly);
  tcase_add_loop_test(tests, bones_rotate_so_as_it_walks, 0, 2);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
