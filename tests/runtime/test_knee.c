#include <math.h>

#include "animation/gait/gait_state.h"
#include "gait_stage.h"
#include "harness.h"
#include "quadruped.h"

static const float TICK_S = 1.0f / 60, DEGREES = 57.2957795f;
/* Maximum change of a knee's rotation per tick from one tick to the next, degrees. */
static const float MAX = 4.6f;

/* Maximum change of a knee's rotation per tick while it follows `wanted` for the given number of ticks. The
 * knee stays as it ends. */
static float follow(sbri_foot *foot, float (*wanted)(int), int count) {
  float max = 0, before = foot->knee.rate;
  for (int i = 0; i < count; i++) {
    float to = wanted(i);
    sbri_knee_store(foot, sbri_knee_follow(foot, to, TICK_S), to, TICK_S);
    max = fmaxf(max, fabsf(foot->knee.rate - before) * TICK_S * DEGREES);
    before = foot->knee.rate;
  }
  return max;
}

static sbri_foot at_rest(float angle) {
  return (sbri_foot){.knee.angle = angle, .knee.wanted = angle, .knee.known_ticks = 2};
}

static float jumps(int tick) {
  return tick < 3 ? 1.0f : 1.6f;
}

static float swings(int tick) {
  return 1.5f + 0.5f * sinf(0.3f * (float)tick); /* by up to 2.6 degrees more in each tick */
}

static float snaps_straight(int tick) {
  float angle = 2 + 0.2f * (float)tick;
  return angle < 3.14159265f ? angle : 3.14159265f;
}

START_TEST(a_knee_reaches_its_target_smoothly_and_stays)
{
  sbri_foot foot = at_rest(1);
  ck_assert_float_le(follow(&foot, jumps, 60), MAX);
  ck_assert_float_eq(foot.knee.angle, 1.6f);
  ck_assert_float_le(fabsf(foot.knee.rate), 1e-3f);
}
END_TEST

START_TEST(a_knee_within_reach_follows_exactly)
{
  sbri_foot foot = at_rest(swings(0));
  (void)follow(&foot, swings, 20);
  for (int i = 20; i < 80; i++) {
    float angle = sbri_knee_follow(&foot, swings(i), TICK_S);
    ck_assert_float_eq(angle, swings(i));
    sbri_knee_store(&foot, angle, angle, TICK_S);
  }
}
END_TEST

START_TEST(a_knee_comes_to_rest_where_the_leg_is_straight)
{
  sbri_foot foot = at_rest(2);
  ck_assert_float_le(follow(&foot, snaps_straight, 60), MAX + 0.5f); /* the first tick has the same jump */
  ck_assert_float_eq_tol(foot.knee.angle, 3.14159265f, 1e-4f);
}
END_TEST

START_TEST(angle_and_distance_are_of_one_triangle)
{
  const sbri_leg leg = {.length.upper = 0.3f, .length.lower = 0.2f};
  for (float angle = 0.2f; angle < 3; angle += 0.1f) {
    float distance = sbri_knee_distance(&leg, 2, angle);
    ck_assert_float_eq_tol(sbri_knee_angle(&leg, 2, distance), angle, 1e-4f);
  }
  ck_assert_float_eq_tol(sbri_knee_distance(&leg, 2, 3.14159265f), 1, 1e-5f);
  ck_assert_float_eq_tol(sbri_knee_angle(&leg, 2, 1.5f), 3.14159265f, 1e-5f); /* beyond its reach */
}
END_TEST

START_TEST(a_planted_leg_stops_before_it_is_straight)
{
  const sbri_leg leg = {.length.upper = 0.3f, .length.lower = 0.2f};
  const sbri_gait_input input = {.tick_s = TICK_S, .scale = 1};
  sbri_foot foot = at_rest(2.5f);
  float shortest, longest;
  ck_assert(!sbri_knee_range(&leg, &foot, &input, 0.5f, &shortest, &longest)); /* it does not turn */
  foot.knee.angle = foot.knee.wanted = 2.9f;
  foot.knee.rate = 0.12f / TICK_S; /* it would be straight in two ticks more */
  float before = foot.knee.rate, max = 0;
  for (int i = 0; i < 30; i++) {
    if (!sbri_knee_range(&leg, &foot, &input, 0.5f, &shortest, &longest)) break;
    ck_assert_float_le(shortest, longest);
    float angle = sbri_knee_angle(&leg, 1, longest);
    sbri_knee_store(&foot, angle, angle, TICK_S);
    max = fmaxf(max, fabsf(foot.knee.rate - before) * TICK_S * DEGREES);
    before = foot.knee.rate;
  }
  ck_assert_float_le(max, MAX + 0.2f); /* single precision is inaccurate for a leg that is nearly straight */
  ck_assert_float_eq_tol(foot.knee.angle, 3.14159265f, 0.02f);
  foot.knee.rate = 10, foot.knee.known_ticks = 1;
  ck_assert(!sbri_knee_range(&leg, &foot, &input, 0.5f, &shortest, &longest));
}
END_TEST

/* A kerb every 60 cm. */
static double kerbs(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)ground, (void)x;
  *normal = (sbf_vec3){0, 1, 0};
  return z > 0.5 ? 0.1 * floor((z - 0.5) / 0.6 + 1) : 0;
}

static const float speeds[] = {0.8f, 1.1f}; /* m/s: at the first, locked knees come up */
enum { SPEEDS = sizeof speeds / sizeof speeds[0] };

static void begin_over_kerbs(gait_stage *stage, float speed) {
  gait_stage_begin(stage, quadruped_asset());
  stage->ground.height = kerbs;
  stage->input.forward = speed;
}

START_TEST(knees_in_the_air_rotate_evenly_over_kerbs)
{
  uint32_t pinned = 0;
  for (int s = 0; s < SPEEDS; s++) {
    gait_stage stage;
    begin_over_kerbs(&stage, speeds[s]);
    float rates[4] = {0}, max = 0;
    uint32_t known[4] = {0};
    for (int i = 0; i < 600; i++) {
      gait_stage_ticks(&stage, 1);
      for (int l = 0; l < 4; l++) {
        const sbri_foot *foot = &stage.state->feet[l];
        float change = fabsf(foot->knee.rate - rates[l]) * TICK_S * DEGREES;
        if (!foot->planted && known[l] == 2) max = fmaxf(max, change);
        rates[l] = foot->knee.rate, known[l] = foot->knee.known_ticks;
        pinned += foot->knee.locked > 0;
      }
    }
    ck_assert_float_gt(stage.state->motion.position.z, 1.5f);
    ck_assert_float_le(max, MAX);
    gait_stage_end(&stage);
  }
  ck_assert_uint_gt(pinned, 0);
}
END_TEST

START_TEST(posing_a_state_twice_gives_the_same_pose)
{
  uint32_t pinned = 0;
  for (int s = 0; s < SPEEDS; s++) {
    gait_stage stage;
    begin_over_kerbs(&stage, speeds[s]);
    sbr_transform again[32];
    for (int i = 0; i < 600; i++) {
      gait_stage_ticks(&stage, 1);
      sbri_gait_pose(&stage.rig, stage.state, &stage.input, false, again);
      for (int l = 0; l < 4; l++) pinned += stage.state->feet[l].knee.locked > 0;
      for (uint32_t b = 0; b < stage.rig.bones.count; b++)
        ck_assert_float_le(sbri_length(sbri_sub(again[b].position, stage.pose[b].position)), 1e-5f);
    }
    gait_stage_end(&stage);
  }
  ck_assert_uint_gt(pinned, 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("knee");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_knee_reaches_its_target_smoothly_and_stays);
  tcase_add_test(tests, a_knee_within_reach_follows_exactly);
  tcase_add_test(tests, a_knee_comes_to_rest_where_the_leg_is_straight);
  tcase_add_test(tests, angle_and_distance_are_of_one_triangle);
  tcase_add_test(tests, a_planted_leg_stops_before_it_is_straight);
  tcase_add_test(tests, knees_in_the_air_rotate_evenly_over_kerbs);
  tcase_add_test(tests, posing_a_state_twice_gives_the_same_pose);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
