#include <math.h>

#include "gait_stage.h"
#include "harness.h"
#include "math/quat.h"
#include "quadruped.h"

/* Three bones, the first of them hung on the root: (0, 0.30, -0.35) to (0, 0.30, -0.65) at rest. */
enum { TAIL_BONES = 3, FIRST = 5, LAST = 7, HIPS = 1, CHEST = 3 };
static const double PI = 3.14159265358979;

/* Level up to z = 0.8, from there on it rises by `parameters[0]`. */
static double ramp(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)x;
  double rise = z > 0.8 ? ground->parameters[0] : 0, length = sqrt(1 + rise * rise);
  *normal = (sbf_vec3){0, (float)(1 / length), (float)(-rise / length)};
  return rise * (z - 0.8);
}

static void begin(gait_stage *t, double rise, float z) {
  gait_stage_begin_on(t, quadruped_asset(), ramp, rise);
  sbri_gait_reset(&t->rig, t->state, &t->input, (sbf_vec3){0, 0, z}, 0);
}

/* Yaw (0) or pitch (1) of a bone of the tail, and the aim that it has. */
static float bent(const gait_stage *t, int bone, int about) {
  return sbri_tail_lags(t->state)[2 * bone + about].value;
}
static void aim(sbri_stance *stance, int about, float angle) {
  *(about ? &stance->hips_pitch : &stance->hips_yaw) = angle;
}

/* Slope between the heads of two bones, in the axes of the given rotation. */
static float rises(const gait_stage *t, uint32_t from, uint32_t to, sbf_quat axes) {
  sbf_vec3 direction = sbri_sub(t->pose[to].position, t->pose[from].position);
  direction = sbri_rotate(sbri_quat_conjugate(axes), direction);
  return atan2f(direction.y, hypotf(direction.x, direction.z));
}
/* Slope of the body in the world, and of the tail relative to the body. */
static float climbs(const gait_stage *t) {
  return rises(t, HIPS, CHEST, sbri_quat_identity());
}
static float raised(const gait_stage *t) {
  return rises(t, FIRST, LAST, t->state->posture.root.rotation);
}

/* y + (2z/w) y' + y''/w^2 = 1 from rest at 0. */
static double answer(double f, double z, double t) {
  double w = 2 * PI * f, u = w * sqrt(1 - z * z);
  return 1 - exp(-z * w * t) * (cos(u * t) + z * w / u * sin(u * t));
}

/* In the air, far from any ground. */
static void tick(gait_stage *t, sbri_stance *stance, float tick_s) {
  t->input.tick_s = tick_s;
  stance->root = (sbr_transform){{0, 10, 0}, sbri_quat_identity()};
  sbri_tails_tick(&t->rig, t->state, &t->input, stance, 0);
}

START_TEST(first_bone_follows_the_hips_at_any_frame_time)
{
  static const int frames[] = {120, 60, 30, 4};
  const sbri_tail *tail;
  for (int about = 0; about < 2; about++)
    for (int i = 0; i < 4; i++) {
      gait_stage t;
      begin(&t, 0, 0);
      tail = &t.rig.tails.at[0];
      sbri_stance stance = {.hips_yaw = 0};
      aim(&stance, about, 0.3f);
      for (int k = 0; k < frames[i] / 2; k++) tick(&t, &stance, 1.0f / (float)frames[i]);
      double expected = 0.3 * answer((double)tail->frequency, (double)tail->damping_ratio, 0.5);
      ck_assert_float_eq_tol(bent(&t, 0, about), (float)expected, 2e-5f);
      ck_assert_float_eq(bent(&t, 0, !about), 0);
      gait_stage_end(&t);
    }
}
END_TEST

START_TEST(bones_lag_one_after_the_other_and_swing_over)
{
  for (int about = 0; about < 2; about++) {
    gait_stage t;
    begin(&t, 0, 0);
    sbri_stance stance = {.hips_yaw = 0};
    aim(&stance, about, 0.2f);
    int half_way[TAIL_BONES] = {0};
    float max[TAIL_BONES] = {0};
    for (int k = 1; k <= 1200; k++) {
      tick(&t, &stance, 1.0f / 120);
      for (int b = 0; b < TAIL_BONES; b++) {
        if (!half_way[b] && bent(&t, b, about) >= 0.1f) half_way[b] = k;
        max[b] = fmaxf(max[b], bent(&t, b, about));
      }
    }
    for (int b = 0; b < TAIL_BONES; b++) {
      ck_assert_int_gt(half_way[b], b ? half_way[b - 1] + 6 : 6);
      ck_assert_float_gt(max[b], 0.26f);
      ck_assert_float_eq_tol(bent(&t, b, about), 0.2f, 1e-3f);
    }
    gait_stage_end(&t);
  }
}
END_TEST

START_TEST(no_bone_bends_beyond_its_limit)
{
  for (int about = 0; about < 2; about++) {
    gait_stage t;
    begin(&t, 0, 0);
    float limit = t.rig.tails.at[0].limit;
    bool cut = false;
    for (int k = 0; k < 600; k++) {
      sbri_stance stance = {.hips_yaw = 0};
      aim(&stance, about, k / 50 % 2 ? 1.2f : -1.2f); /* to and fro near the frequency of the tail */
      tick(&t, &stance, 1.0f / 120);
      for (int b = 0; b < TAIL_BONES; b++) {
        float leader = b ? bent(&t, b - 1, about) : about ? stance.hips_pitch : stance.hips_yaw;
        float bend = fabsf(bent(&t, b, about) - leader);
        ck_assert_float_le(bend, limit + 1e-6f);
        bool stopped = sbri_tail_lags(t.state)[2 * b + about].rate == 0;
        cut = cut || (stopped && bend > limit - 1e-6f);
      }
    }
    ck_assert(cut);
    gait_stage_end(&t);
  }
}
END_TEST

START_TEST(tail_stays_behind_where_the_ground_rises_and_swings_over)
{
  gait_stage t;
  begin(&t, 0.35, 0);
  t.input.forward = 1;
  float above = 0, below = 0, steepest = 0;
  for (int k = 0; k < 240; k++) {
    gait_stage_ticks(&t, 1);
    above = fmaxf(above, raised(&t));
    below = fminf(below, raised(&t));
    steepest = fmaxf(steepest, climbs(&t));
  }
  ck_assert_float_gt(steepest, 0.2f);
  ck_assert_float_gt(above, 0.04f);   /* the body is on the rise, the tail still level */
  ck_assert_float_lt(below, -0.008f); /* the body's pitch has come to its end, the tail goes beyond it */
  t.input.forward = 0;
  gait_stage_ticks(&t, 480);
  ck_assert_float_eq_tol(raised(&t), 0, 0.005f);
  gait_stage_end(&t);
}
END_TEST

START_TEST(placed_on_a_slope_it_is_straight_at_once)
{
  gait_stage t;
  begin(&t, 0.35, 3);
  for (int k = 0; k < 60; k++) {
    gait_stage_ticks(&t, 1);
    ck_assert_float_gt(climbs(&t), 0.2f);
    ck_assert_float_eq_tol(raised(&t), 0, 1e-4f);
  }
  gait_stage_end(&t);
}
END_TEST

/* The body is on a rise, the tail still over the level before it. The tail's end stays above the ground, for
 * a character that starts there and for one that walks there. */
START_TEST(tail_stays_over_the_ground_where_it_bends)
{
  static const float starts[] = {1.1f, -0.3f};
  for (int i = 0; i < 2; i++) {
    gait_stage t;
    begin(&t, 0.9, starts[i]);
    for (int b = 0; b < TAIL_BONES; b++)
      ((sbri_tail_bone *)(uintptr_t)t.rig.tails.at[0].bones)[b].clearance = 0.25f;
    sbri_gait_reset(&t.rig, t.state, &t.input, (sbf_vec3){0, 0, starts[i]}, 0);
    t.input.forward = 0.5f;
    float lowest = INFINITY;
    for (int k = 0; k < 480; k++) {
      gait_stage_ticks(&t, 1);
      sbf_vec3 end = t.pose[LAST].position;
      float ground = (float)ramp(t.input.ground, 0, (double)end.z, &(sbf_vec3){0});
      lowest = fminf(lowest, end.y - ground);
    }
    ck_assert_float_gt(lowest, i ? 0.2f : 0.22f); /* m of 0.25 */
    gait_stage_end(&t);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("tail");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, first_bone_follows_the_hips_at_any_frame_time);
  tcase_add_test(tests, bones_lag_one_after_the_other_and_swing_over);
  tcase_add_test(tests, no_bone_bends_beyond_its_limit);
  tcase_add_test(tests, tail_stays_behind_where_the_ground_rises_and_swings_over);
  tcase_add_test(tests, placed_on_a_slope_it_is_straight_at_once);
  tcase_add_test(tests, tail_stays_over_the_ground_where_it_bends);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
