#include <math.h>

#include "animation/gait/gait_state.h"
#include "harness.h"
#include "math/quat.h"

static const float TICK_S = 1.0f / 60, MAX = 4.6f * 3.14159265f / 180; /* of rad per tick, in a tick */

/* A leg of two bones of 1 m, its hip 1 m up, and a foot 0.8 m high that stands upright before it on its toe.
 */
static sbri_leg long_legged(void) {
  sbri_leg leg = {.length = {.upper = 1, .lower = 1, .rest_span = 1.4f, .reach = 1.7f}, .has_toe = true};
  leg.home.ankle = sbri_vec3(0, 0.9f, 0);
  leg.home.toe = sbri_vec3(0, 0.1f, 0);
  return leg;
}

static sbri_foot standing(void) {
  return (sbri_foot){.planted = 1, .frame = {.rotation = {0, 0, 0, 1}}, .normal = {0, 1, 0}};
}

/* Ankle position of a foot that stands `ahead` of the hip; its `tilt` receives the foot's pitch. */
static sbf_vec3 lean_ahead(
    const sbri_leg *leg, sbri_foot *foot, float ahead, float scale, sbri_advance advance) {
  const sbri_gait_input input = {.tick_s = TICK_S, .scale = scale};
  sbf_vec3 sole = sbri_scale(sbri_vec3(0, 0, ahead), scale);
  sbf_vec3 ankle = sbri_add(sole, sbri_scale(leg->home.ankle, scale)), hip = sbri_vec3(0, scale, 0);
  return sbri_long_foot_tilt(leg, foot, hip, sole, ankle, &input, advance, &foot->frame.tilt);
}

static float from_hip(sbf_vec3 ankle, float scale) {
  return sbri_length(sbri_sub(ankle, sbri_vec3(0, scale, 0)));
}

START_TEST(the_foot_stands_upright_as_at_rest)
{
  sbri_leg leg = long_legged();
  sbri_foot foot = standing();
  float ahead = sqrtf(1.4f * 1.4f - 0.01f); /* the ankle 0.1 m below the hip */
  sbf_vec3 ankle = lean_ahead(&leg, &foot, ahead, 1, SBRI_ADVANCE_RESET);
  ck_assert_float_le(sbri_length(sbri_sub(ankle, sbri_vec3(0, 0.9f, ahead))), 1e-5f);
  ck_assert_float_eq_tol(foot.frame.tilt.w, 1, 1e-6f);
}
END_TEST

START_TEST(the_foot_takes_half_of_the_leg_s_stretch_or_bend)
{
  sbri_leg leg = long_legged();
  for (float scale = 1; scale < 4; scale += 2)
    for (float ahead = 1.1f; ahead < 1.65f; ahead += 0.1f) {
      sbri_foot foot = standing();
      sbf_vec3 ankle = lean_ahead(&leg, &foot, ahead, scale, SBRI_ADVANCE_RESET);
      float upright = from_hip(sbri_vec3(0, 0.9f * scale, ahead * scale), scale);
      ck_assert_float_eq_tol(from_hip(ankle, scale), 0.5f * (upright + 1.4f * scale), 1e-4f);
      /* It stands on its toe at its own length, rotated with its ankle. */
      sbf_vec3 toe = sbri_scale(sbri_vec3(0, 0.1f, ahead), scale), is = sbri_sub(ankle, toe);
      ck_assert_float_eq_tol(sbri_length(is), 0.8f * scale, 1e-4f);
      sbf_vec3 turned = sbri_rotate(foot.frame.tilt, sbri_vec3(0, 0.8f * scale, 0));
      ck_assert_float_le(sbri_length(sbri_sub(turned, is)), 1e-4f);
    }
}
END_TEST

START_TEST(beyond_its_lean_limit_the_foot_stays_and_the_knee_straightens)
{
  sbri_leg leg = long_legged();
  sbri_foot foot = standing();
  for (float ahead = 1.7f; ahead < 2.5f; ahead += 0.1f) {
    sbf_vec3 toe = {0, 0.1f, ahead}, ankle = lean_ahead(&leg, &foot, ahead, 1, SBRI_ADVANCE_RESET);
    ck_assert_float_eq_tol(sbri_length(sbri_sub(ankle, toe)), 0.8f, 1e-4f);
    ck_assert_float_le(from_hip(ankle, 1), 2); /* as far as thigh and shin reach */
    ck_assert_float_gt(from_hip(ankle, 1), sbri_length(sbri_sub(toe, sbri_vec3(0, 1, 0))) - 0.8f);
  }
}
END_TEST

START_TEST(a_planted_knee_rotates_evenly_and_the_foot_leans)
{
  sbri_leg leg = long_legged();
  sbri_foot foot = standing();
  float before = 0, max = 0;
  for (int i = 0; i < 60; i++) {
    float ahead = i < 20 ? 1.2f : 1.6f; /* the body is thrown back in one tick */
    sbf_vec3 ankle = lean_ahead(&leg, &foot, ahead, 1, SBRI_ADVANCE_TICK);
    ck_assert_float_eq_tol(sbri_length(sbri_sub(ankle, sbri_vec3(0, 0.1f, ahead))), 0.8f, 1e-4f);
    ck_assert_float_eq_tol(sbri_knee_angle(&leg, 1, from_hip(ankle, 1)), foot.knee.angle, 2e-3f);
    if (i > 2) max = fmaxf(max, fabsf(foot.knee.rate - before) * TICK_S);
    before = foot.knee.rate;
    sbf_vec3 again = lean_ahead(&leg, &foot, ahead, 1, SBRI_ADVANCE_NOT); /* the same pose once more */
    ck_assert_float_le(sbri_length(sbri_sub(again, ankle)), 1e-5f);
  }
  ck_assert_float_le(max, MAX);
  ck_assert_float_gt(max, 0.5f * MAX);
  ck_assert_float_eq(foot.knee.angle, foot.knee.wanted); /* caught up */
}
END_TEST

int main(void) {
  Suite *suite = suite_create("long_foot");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, the_foot_stands_upright_as_at_rest);
  tcase_add_test(tests, the_foot_takes_half_of_the_leg_s_stretch_or_bend);
  tcase_add_test(tests, beyond_its_lean_limit_the_foot_stays_and_the_knee_straightens);
  tcase_add_test(tests, a_planted_knee_rotates_evenly_and_the_foot_leans);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
