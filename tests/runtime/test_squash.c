/* Bones that squash: exact after a step of their position, for any tick length, with constant volume;
 * attached bones follow. */
#include <math.h>

#include "gait_stage.h"
#include "harness.h"
#include "model/delta.h"
#include "sbrun/animation.h"
#include "scenes.h"

enum { BONES = 3 };
static const float HZ = 2.1f, RATIO = 0.3f, LENGTH = 0.25f, STRENGTH = 0.7f, LIMIT = 0.6f, LIFT = 0.2f;

/* A body of two bones, one above the other, and one attached to neither. A clip lifts the lower one within a
 * tick. */
static void fill(sbf_asset *a) {
  static const float lifted[3] = {0, 0.1f + 0.2f, 0};
  sbf_bone *bones = sbf_asset_allocate(a, BONES, sizeof *bones);
  sbf_follower *follower = sbf_asset_allocate(a, 1, sizeof *follower);
  for (int i = 0; i < BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].parent = i == 1 ? 0 : -1;
    bones[i].head = sbri_vec3(i == 2 ? 1 : 0, i == 1 ? 0.4f : 0.1f, 0);
    bones[i].length = LENGTH;
  }
  sbf_follower_init(follower);
  follower->bone = 0;
  follower->channel = SBF_FOLLOWER_CHANNEL_SQUASH;
  follower->frequency = HZ;
  follower->damping_ratio = RATIO;
  follower->response = 2;
  follower->strength = STRENGTH;
  follower->limit = LIMIT;
  gait_stage_step_clip(a, 0, SBF_TRACK_PROPERTY_TRANSLATION, lifted, 3);
  a->bones = (sbf_bone_list){bones, BONES};
  a->followers = (sbf_follower_list){follower, 1};
}

static void begin(gait_stage *s, float tick_s, float scale) {
  sbf_asset *asset = sbf_asset_create(NULL);
  fill(asset);
  gait_stage_begin_scaled(s, asset, tick_s, scale);
  gait_stage_play(s);
}

static float tick(gait_stage *s) {
  gait_stage_ticks(s, 1);
  return sbri_gait_stretch(&s->rig, s->state, 0, 1);
}

/* With r = 2, e = y - x obeys e'' + 2 z w e' + w^2 e = -x''. A linear motion by 1 in h starts it with -1/h,
 * and its end adds the opposite. Double precision. */
static double kick(double t) {
  double w = 2 * 3.14159265358979 * (double)HZ, z = (double)RATIO, u = w * sqrt(1 - z * z);
  return t <= 0 ? 0 : exp(-z * w * t) * sin(u * t) / u;
}
static double expected(double t, double h) {
  double lag = (double)(STRENGTH * LIFT / LENGTH) * (kick(t - h) - kick(t)) / h, limit = (double)LIMIT;
  double eased = limit * lag / (limit + fabs(lag));
  return eased >= 0 ? 1 + eased : 1 / (1 - eased);
}

START_TEST(a_step_of_position_squashes_exactly_at_any_tick)
{
  static const int times_ms[] = {1, 4, 17, 33, 100, 250};
  for (size_t k = 0; k < sizeof times_ms / sizeof *times_ms; k++) {
    gait_stage s;
    double h = 0.001 * times_ms[k], min = 1, max = 1;
    begin(&s, (float)h, 1);
    for (int i = 1; i * h < 2.5; i++) {
      double is = (double)tick(&s);
      ck_assert_double_eq_tol(is, expected(i * h, h), 3e-4);
      min = is < min ? is : min, max = is > max ? is : max;
      ck_assert_double_gt(is, 1 / (1 + (double)LIMIT));
      ck_assert_double_lt(is, 1 + (double)LIMIT);
    }
    if (h < 0.05) { /* compressed, then stretched; in a step of a quarter of a second only weakly */
      ck_assert_double_lt(min, 0.8);
      ck_assert_double_gt(max, 1.1);
    }
    gait_stage_end(&s);
  }
}
END_TEST

START_TEST(only_children_of_the_bone_follow_it)
{
  gait_stage s;
  begin(&s, 1.0f / 60, 1);
  for (int i = 0; i < 60; i++) {
    float along = tick(&s);
    ck_assert_float_eq_tol(s.pose[1].position.y - s.pose[0].position.y, 0.3f * along, 1e-6f);
    ck_assert_float_eq(s.pose[2].position.x, 1);
    ck_assert_float_eq_tol(s.pose[2].position.y, 0.1f, 1e-6f);
  }
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_larger_copy_is_squashed_equally_and_a_teleported_one_is_not)
{
  gait_stage small, large;
  begin(&small, 1.0f / 60, 1), begin(&large, 1.0f / 60, 3);
  for (int i = 0; i < 40; i++) {
    float a = tick(&small), b = tick(&large);
    ck_assert_float_eq_tol(a, b, 1e-4f);
  }
  sbri_gait_pose(&small.rig, small.state, &small.input, true, small.pose);
  for (int i = 0; i < 20; i++) ck_assert_float_eq_tol(tick(&small), 1, 1e-5f);
  gait_stage_end(&small), gait_stage_end(&large);
}
END_TEST

START_TEST(another_origin_changes_nothing)
{
  gait_stage here, there;
  sbf_vec3 shift = {3, -2, 1};
  begin(&here, 1.0f / 60, 1), begin(&there, 1.0f / 60, 1);
  for (int i = 0; i < 40; i++) {
    if (i == 8) {
      sbri_gait_rebase(&there.rig, there.state, shift);
      there.input.origin = (sbr_double3){3, -2, 1};
    }
    ck_assert_float_eq_tol(tick(&here), tick(&there), 2e-5f);
  }
  gait_stage_end(&here), gait_stage_end(&there);
}
END_TEST

static float volume_of(const sbf_vec3 *p) {
  sbf_vec3 a = sbri_sub(p[1], p[0]), b = sbri_sub(p[2], p[0]), c = sbri_sub(p[3], p[0]);
  return sbri_dot(a, sbri_cross(b, c));
}

START_TEST(volume_is_preserved)
{
  for (float along = 0.4f; along < 2; along += 0.2f) {
    sbri_squash squash = {{0.1f, 0.2f, 0.3f}, {0, 0.6f, 0.8f}, along, 1 / sqrtf(along)};
    sbri_delta plain = {{1, 2, 3}, {0.5f, 0.5f, -0.5f, 0.5f}, NULL}, delta = plain;
    delta.squash = &squash;
    sbf_vec3 rest[4] = {{0, 0, 0}, {1, 0.2f, 0}, {0.3f, 1, 0.1f}, {0, 0.4f, 1}}, before[4], after[4];
    for (int i = 0; i < 4; i++)
      before[i] = sbri_delta_position(&plain, rest[i]), after[i] = sbri_delta_position(&delta, rest[i]);
    ck_assert_float_eq_tol(volume_of(after), volume_of(before), 1e-5f);
    sbf_vec3 tip = sbri_add(squash.head, squash.axis);
    sbf_vec3 displacement =
        sbri_sub(sbri_delta_position(&delta, tip), sbri_delta_position(&delta, squash.head));
    ck_assert_float_eq_tol(sbri_length(displacement), along, 1e-5f);
  }
}
END_TEST

/* A post that hangs on a bone which a clip throws up by 0.2 m. */
static scene post(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0.1f, 0});
  fill(s.asset);
  scene_body(&s, 0);
  scene_section(&s, 0, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){0.1f, 0.4f, 0.1f}, 2);
  scene_skin(&s, 0);
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  return s;
}

START_TEST(a_host_reads_scales_at_every_frame_rate)
{
  scene even = post(), fine = post();
  const sbr_clip_play whole = sbr_default_clip_play();
  sbr_character_play_clip(even.world, even.character, 0, 0, &whole);
  sbr_character_play_clip(fine.world, fine.character, 0, 0, &whole);
  float min = 1;
  for (int i = 0; i < 60; i++) {
    sbf_vec3 a[BONES], b[BONES];
    sbr_world_step(even.world, 1.0 / 60);
    for (int k = 0; k < 3; k++) sbr_world_step(fine.world, 1.0 / 180);
    ck_assert_uint_eq(sbr_character_get_bone_scales(even.world, even.character, a, BONES), BONES);
    sbr_character_get_bone_scales(fine.world, fine.character, b, BONES);
    for (int k = 0; k < BONES; k++) {
      ck_assert_float_eq_tol(a[k].x * a[k].y * a[k].z, 1, 1e-5f);
      ck_assert_float_eq_tol(a[k].y, b[k].y, 1e-5f);
      ck_assert_float_eq(a[k].x, a[k].z);
      if (k) ck_assert_float_eq(a[k].y, 1);
    }
    min = a[0].y < min ? a[0].y : min;
  }
  ck_assert_float_lt(min, 0.9f);
  ck_assert_uint_eq(sbr_world_get_state_hash(even.world), sbr_world_get_state_hash(fine.world));
  sbf_vec3 now[BONES];
  sbr_character_reset(even.world, even.character);
  sbr_character_get_bone_scales(even.world, even.character, now, BONES);
  ck_assert_float_eq(now[0].y, 1);
  ck_assert_uint_eq(sbr_character_get_bone_scales(even.world, (sbr_character_id){77}, NULL, 0), 0);
  scene_free(&even), scene_free(&fine);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("squash");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_step_of_position_squashes_exactly_at_any_tick);
  tcase_add_test(tests, only_children_of_the_bone_follow_it);
  tcase_add_test(tests, a_larger_copy_is_squashed_equally_and_a_teleported_one_is_not);
  tcase_add_test(tests, another_origin_changes_nothing);
  tcase_add_test(tests, volume_is_preserved);
  tcase_add_test(tests, a_host_reads_scales_at_every_frame_rate);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
