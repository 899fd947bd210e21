/* Followers of bones: exact after a step of their pose, at any tick, in turn and in place. */
#include "gait_stage.h"
#include "harness.h"
#include "sbfmt/asset.h"

enum { BONES = 2 };
static const float HZ = 1.3f, RATIO = 0.4f;

/* A post and an antenna on it, which a clip turns by 0.8 rad, or lifts by 0.3 m, from one tick to the next.
 */
static void begin(gait_stage *s, sbf_follower_channel channel, float tick_s, float scale) {
  static const float turned[4] = {0.389418342f, 0, 0, 0.921060994f}, lifted[3] = {0, 0.8f, 0};
  bool turns = channel == SBF_FOLLOWER_CHANNEL_ROTATION;
  sbf_asset *a = sbf_asset_create(NULL);
  sbf_bone *bones = sbf_asset_allocate(a, BONES, sizeof *bones);
  sbf_follower *follower = sbf_asset_allocate(a, 1, sizeof *follower);
  for (int i = 0; i < BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].parent = i - 1;
    bones[i].head = sbri_vec3(0, 0.5f * (float)i, 0);
  }
  sbf_follower_init(follower);
  follower->bone = 1;
  follower->channel = channel;
  follower->frequency = HZ;
  follower->damping_ratio = RATIO;
  follower->response = 0;
  a->bones = (sbf_bone_list){bones, BONES};
  a->followers = (sbf_follower_list){follower, 1};
  gait_stage_step_clip(a, 1, turns ? SBF_TRACK_PROPERTY_ROTATION : SBF_TRACK_PROPERTY_TRANSLATION,
      turns ? turned : lifted, turns ? 4 : 3);
  gait_stage_begin_scaled(s, a, tick_s, scale);
  gait_stage_play(s);
}

static void tick(gait_stage *s) {
  gait_stage_ticks(s, 1);
}

/* Solution of y + (2z/w) y' + y''/w^2 = x, where x rises linearly from 0 to 1 in h and then stays: the
 * response to a ramp minus the response to the same ramp started h later. Double precision. */
static double ramp(double t) {
  if (t <= 0) return 0;
  double w = 2 * 3.14159265358979 * (double)HZ, z = (double)RATIO, u = w * sqrt(1 - z * z);
  double decay = exp(-z * w * t), late = 2 * z / w;
  return t - late + decay * (late * cos(u * t) + (2 * z * z - 1) / u * sin(u * t));
}
static double response(double t, double h) {
  return (ramp(t) - ramp(t - h)) / h;
}

START_TEST(a_step_of_the_pose_is_followed_exactly_at_any_tick)
{
  static const int times_ms[] = {1, 4, 17, 33, 100, 250};
  for (size_t k = 0; k < sizeof times_ms / sizeof *times_ms; k++)
    for (int lifts = 0; lifts < 2; lifts++) {
      gait_stage s;
      double h = 0.001 * times_ms[k];
      begin(&s, lifts ? SBF_FOLLOWER_CHANNEL_POSITION : SBF_FOLLOWER_CHANNEL_ROTATION, (float)h, 1);
      double max = 0;
      for (int i = 1; (double)i * h < 2.5; i++) {
        tick(&s);
        double is = lifts ? (double)(s.pose[1].position.y - 0.5f) / 0.3
                          : (double)sbri_quat_log(s.pose[1].rotation).x / 0.8;
        ck_assert_double_eq_tol(is, response(i * h, h), 2e-4);
        max = is > max ? is : max;
      }
      ck_assert_double_gt(max, 1.1); /* it swings over */
      gait_stage_end(&s);
    }
}
END_TEST

START_TEST(a_teleported_character_does_not_swing)
{
  gait_stage s;
  begin(&s, SBF_FOLLOWER_CHANNEL_ROTATION, 1.0f / 60, 1);
  for (int i = 0; i < 10; i++) tick(&s);
  sbri_gait_pose(&s.rig, s.state, &s.input, true, s.pose);
  for (int i = 0; i < 30; i++) {
    tick(&s);
    ck_assert_float_eq_tol(sbri_quat_log(s.pose[1].rotation).x, 0.8f, 1e-4f);
  }
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_larger_copy_follows_equally)
{
  gait_stage small, large;
  begin(&small, SBF_FOLLOWER_CHANNEL_POSITION, 1.0f / 60, 1);
  begin(&large, SBF_FOLLOWER_CHANNEL_POSITION, 1.0f / 60, 3);
  for (int i = 0; i < 60; i++) {
    tick(&small), tick(&large);
    ck_assert_float_eq_tol(large.pose[1].position.y, 3 * small.pose[1].position.y, 1e-4f);
  }
  gait_stage_end(&small), gait_stage_end(&large);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("bone_follower");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_step_of_the_pose_is_followed_exactly_at_any_tick);
  tcase_add_test(tests, a_teleported_character_does_not_swing);
  tcase_add_test(tests, a_larger_copy_follows_equally);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
