/* Bones with weight: exact after a step of their position, for any tick length, in the world's axes for any
 * heading; attached bones follow; feet stay. */
#include <math.h>

#include "gait_stage.h"
#include "harness.h"
#include "math/quat.h"
#include "math/trig.h"
#include "quadruped.h"
#include "sbrun/animation.h"
#include "scenes.h"

enum { BONES = 3 };
static const float HZ = 1.7f, RATIO = 0.35f, LENGTH = 0.3f, STRENGTH = 0.8f, LIMIT = 0.4f, WAY = 0.25f;

static sbf_follower weight_of(uint32_t bone) {
  sbf_follower follower;
  sbf_follower_init(&follower);
  follower.bone = (int32_t)bone;
  follower.channel = SBF_FOLLOWER_CHANNEL_WEIGHT;
  follower.frequency = HZ;
  follower.damping_ratio = RATIO;
  follower.response = 2;
  follower.strength = STRENGTH;
  follower.limit = LIMIT;
  return follower;
}

/* A body of two bones, one above the other and slightly ahead of it, and one attached to neither. A clip
 * moves the lower one by WAY along `direction` within a tick. */
static void fill(sbf_asset *a, sbf_vec3 direction) {
  float *thrown = sbf_asset_allocate(a, 3, sizeof *thrown);
  sbf_bone *bones = sbf_asset_allocate(a, BONES, sizeof *bones);
  sbf_follower *follower = sbf_asset_allocate(a, 1, sizeof *follower);
  for (int i = 0; i < BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].parent = i == 1 ? 0 : -1;
    bones[i].head = sbri_vec3(i == 2 ? 1 : 0, i == 1 ? 0.4f : 0.1f, i == 1 ? 0.1f : 0);
    bones[i].length = LENGTH;
  }
  thrown[0] = WAY * direction.x, thrown[1] = 0.1f + WAY * direction.y, thrown[2] = WAY * direction.z;
  *follower = weight_of(0);
  gait_stage_step_clip(a, 0, SBF_TRACK_PROPERTY_TRANSLATION, thrown, 3);
  a->bones = (sbf_bone_list){bones, BONES};
  a->followers = (sbf_follower_list){follower, 1};
}

static void begin(gait_stage *s, sbf_vec3 direction, float tick_s, float scale) {
  sbf_asset *asset = sbf_asset_create(NULL);
  fill(asset, direction);
  gait_stage_begin_scaled(s, asset, tick_s, scale);
  gait_stage_play(s);
}

/* With r = 2, e = y - x obeys e'' + 2 z w e' + w^2 e = -x''. A linear motion by 1 in h starts it with -1/h,
 * and its end adds the opposite. Double precision; in lengths, soft-limited. */
static double kick(double t) {
  double w = 2 * 3.14159265358979 * (double)HZ, z = (double)RATIO, u = w * sqrt(1 - z * z);
  return t <= 0 ? 0 : exp(-z * w * t) * sin(u * t) / u;
}
static double expected(double t, double h) {
  double lag = (double)(STRENGTH * WAY / LENGTH) * (kick(t - h) - kick(t)) / h, limit = (double)LIMIT;
  return limit * lag / (limit + fabs(lag));
}

START_TEST(a_step_of_position_sinks_and_leans_it_exactly_at_any_tick)
{
  static const int times_ms[] = {1, 4, 17, 33, 100, 250};
  static const sbf_vec3 directions[] = {{0, 1, 0}, {0, 0, 1}, {0.6f, 0, -0.8f}};
  for (size_t k = 0; k < sizeof times_ms / sizeof *times_ms; k++)
    for (size_t w = 0; w < sizeof directions / sizeof *directions; w++) {
      gait_stage s;
      double h = 0.001 * times_ms[k], min = 0, max = 0;
      begin(&s, directions[w], (float)h, 1);
      for (int i = 1; i * h < 2.5; i++) {
        gait_stage_ticks(&s, 1);
        double should = expected(i * h, h);
        sbf_vec3 turn = sbri_quat_log(s.pose[0].rotation);
        sbf_vec3 leans = sbri_vec3(-turn.z, 0, turn.x); /* where +Y goes */
        double up = (double)(s.pose[0].position.y - 0.1f - WAY * directions[w].y);
        ck_assert_double_eq_tol(up, (double)(LENGTH * directions[w].y) * should, 1e-4);
        ck_assert_double_eq_tol((double)leans.x, (double)directions[w].x * should, 3e-4);
        ck_assert_double_eq_tol((double)leans.z, (double)directions[w].z * should, 3e-4);
        ck_assert_float_eq_tol(turn.y, 0, 1e-6f);
        ck_assert_double_lt(fabs(should), (double)LIMIT);
        min = should < min ? should : min, max = should > max ? should : max;
      }
      if (h < 0.05) { /* it lags behind, then swings past */
        ck_assert_double_lt(min, -0.2);
        ck_assert_double_gt(max, 0.05);
      }
      gait_stage_end(&s);
    }
}
END_TEST

START_TEST(only_children_of_the_bone_follow_it)
{
  gait_stage s;
  begin(&s, sbri_vec3(0, 0.6f, 0.8f), 1.0f / 60, 1);
  for (int i = 0; i < 60; i++) {
    gait_stage_ticks(&s, 1);
    sbf_vec3 arm = sbri_rotate(s.pose[0].rotation, sbri_vec3(0, 0.3f, 0.1f));
    sbf_vec3 off = sbri_sub(s.pose[1].position, sbri_add(s.pose[0].position, arm));
    ck_assert_float_lt(sbri_length(off), 1e-6f);
    ck_assert_float_eq_tol(sbri_quat_log(s.pose[1].rotation).x, sbri_quat_log(s.pose[0].rotation).x, 1e-6f);
    ck_assert_float_eq(s.pose[2].position.x, 1);
    ck_assert_float_eq_tol(s.pose[2].position.y, 0.1f, 1e-6f);
  }
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_larger_copy_moves_equally_and_a_teleported_one_does_not)
{
  gait_stage small, large;
  sbf_vec3 direction = {0, 0.8f, 0.6f};
  begin(&small, direction, 1.0f / 60, 1), begin(&large, direction, 1.0f / 60, 3);
  for (int i = 0; i < 40; i++) {
    gait_stage_ticks(&small, 1), gait_stage_ticks(&large, 1);
    ck_assert_float_eq_tol(3 * small.pose[0].position.y, large.pose[0].position.y, 3e-4f);
    ck_assert_float_eq_tol(
        sbri_quat_log(small.pose[0].rotation).x, sbri_quat_log(large.pose[0].rotation).x, 1e-4f);
  }
  sbri_gait_pose(&small.rig, small.state, &small.input, true, small.pose);
  for (int i = 0; i < 20; i++) {
    gait_stage_ticks(&small, 1);
    ck_assert_float_eq_tol(small.pose[0].position.y, 0.1f + WAY * direction.y, 1e-6f);
    ck_assert_float_eq(small.pose[0].rotation.x, 0);
  }
  gait_stage_end(&small), gait_stage_end(&large);
}
END_TEST

START_TEST(another_origin_changes_nothing)
{
  gait_stage here, there;
  sbf_vec3 shift = {3, -2, 1}, direction = {0, 0.8f, 0.6f};
  begin(&here, direction, 1.0f / 60, 1), begin(&there, direction, 1.0f / 60, 1);
  for (int i = 0; i < 40; i++) {
    if (i == 8) {
      sbri_gait_rebase(&there.rig, there.state, shift);
      there.input.origin = (sbr_double3){3, -2, 1};
    }
    gait_stage_ticks(&here, 1), gait_stage_ticks(&there, 1);
    ck_assert_float_eq_tol(
        sbri_quat_log(here.pose[0].rotation).x, sbri_quat_log(there.pose[0].rotation).x, 2e-5f);
  }
  gait_stage_end(&here), gait_stage_end(&there);
}
END_TEST

static sbf_asset *heavy_quadruped(void) {
  sbf_asset *asset = quadruped_asset();
  sbf_follower *follower = sbf_asset_allocate(asset, 1, sizeof *follower);
  *follower = weight_of((uint32_t)asset->gaits.at[0].body);
  asset->followers = (sbf_follower_list){follower, 1};
  ((sbf_bone *)(uintptr_t)asset->bones.at)[asset->gaits.at[0].body].length = LENGTH;
  return asset;
}

/* A quadruped whose body weighs, or does not. */
static void begin_walk(gait_stage *s, bool weighs) {
  gait_stage_begin(s, weighs ? heavy_quadruped() : quadruped_asset());
}

/* How far the body's up leans ahead, as it faces. */
static float leans_ahead(const gait_stage *s, uint32_t body) {
  sbf_quat rotation =
      sbri_quat_multiply(s->pose[body].rotation, sbri_quat_conjugate(s->rig.bones.rest[body].rotation));
  return sbri_world_to_body(s->state, sbri_rotate(rotation, sbri_vec3(0, 1, 0))).z;
}

START_TEST(a_body_lags_at_start_and_dives_at_stop_over_planted_feet)
{
  gait_stage heavy, light;
  begin_walk(&heavy, true), begin_walk(&light, false);
  const sbf_gait *gait = &heavy.asset->gaits.at[0];
  uint32_t body = (uint32_t)gait->body;
  float back = 0, ahead = 0;
  for (int i = 0; i < 360; i++) {
    heavy.input.forward = light.input.forward = i < 180 ? 0.5f : 0;
    gait_stage_ticks(&heavy, 1), gait_stage_ticks(&light, 1);
    float leans = leans_ahead(&heavy, body) - leans_ahead(&light, body);
    back = i < 180 && leans < back ? leans : back;
    ahead = i >= 180 && leans > ahead ? leans : ahead;
    for (uint32_t l = 0; l < heavy.rig.leg_count; l++) { /* its steps are unchanged */
      const sbf_vec3 a = heavy.pose[heavy.rig.legs[l].foot].position;
      const sbf_vec3 b = light.pose[light.rig.legs[l].foot].position;
      if (heavy.state->feet[l].planted && light.state->feet[l].planted)
        ck_assert_float_lt(sbri_length(sbri_sub(a, b)), 5e-4f);
    }
  }
  ck_assert_float_lt(back, -0.02f);
  ck_assert_float_gt(ahead, 0.02f);
  ck_assert_float_eq_tol(leans_ahead(&heavy, body), leans_ahead(&light, body), 1e-3f); /* at rest again */
  gait_stage_end(&heavy), gait_stage_end(&light);
}
END_TEST

/* Through four turns and more, so that headings wrap. A body without legs moves as it is driven. */
START_TEST(it_leans_equally_in_every_heading)
{
  gait_stage stages[2];
  float max = 0;
  for (int k = 0; k < 2; k++) {
    gait_stage *s = &stages[k];
    begin(s, sbri_vec3(0, 0, 0), 1.0f / 60, 1);
    sbri_gait_reset(&s->rig, s->state, &s->input, sbri_vec3(0, 0, 0), k ? 2.9f : 0);
    sbri_gait_pose(&s->rig, s->state, &s->input, true, s->pose);
    s->input.turn = 1.7f;
  }
  for (int i = 0; i < 900; i++) {
    float leans[2];
    for (int k = 0; k < 2; k++) {
      stages[k].input.forward = i % 300 < 200 ? 0.8f : 0;
      gait_stage_ticks(&stages[k], 1);
      leans[k] = leans_ahead(&stages[k], 0);
    }
    ck_assert_float_eq_tol(leans[0], leans[1], 1e-4f);
    max = leans[0] > max ? leans[0] : max;
  }
  ck_assert_float_gt(max, 0.05f);
  gait_stage_end(&stages[0]), gait_stage_end(&stages[1]);
}
END_TEST

START_TEST(every_frame_rate_shows_the_same_motion)
{
  static const int rates[] = {30, 60, 144};
  sbr_transform bones[3][64];
  uint64_t hashes[3];
  for (int r = 0; r < 3; r++) {
    sbf_asset *asset = heavy_quadruped();
    sbr_world_definition definition = sbr_default_world_definition();
    sbr_character_definition standing = sbr_default_character_definition();
    sbr_world *world;
    sbr_model *model;
    sbr_character_id character;
    sbf_diagnostic error;
    definition.ground = sbr_ground_flat(0);
    ck_assert_int_eq(sbr_model_create(asset, NULL, &model, &error), SBF_OK);
    ck_assert_int_eq(sbr_world_create(&definition, &world, &error), SBF_OK);
    ck_assert_int_eq(sbr_character_create(world, model, &standing, &character, &error), SBF_OK);
    sbr_character_set_drive(world, character, 0.5f, 0, 0.2f);
    for (int i = 0; i < rates[r] / 2; i++) sbr_world_step(world, 1.0 / rates[r]);
    hashes[r] = sbr_world_get_state_hash(world);
    sbr_character_get_bones(world, character, bones[r], 64);
    for (uint32_t b = 0; b < asset->bones.count; b++)
      ck_assert_float_lt(sbri_length(sbri_sub(bones[r][b].position, bones[0][b].position)), 1e-5f);
    ck_assert_uint_eq(hashes[r], hashes[0]);
    sbr_world_destroy(world);
    sbr_model_destroy(model);
    sbf_asset_free(asset);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("weight");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_step_of_position_sinks_and_leans_it_exactly_at_any_tick);
  tcase_add_test(tests, only_children_of_the_bone_follow_it);
  tcase_add_test(tests, a_larger_copy_moves_equally_and_a_teleported_one_does_not);
  tcase_add_test(tests, another_origin_changes_nothing);
  tcase_add_test(tests, a_body_lags_at_start_and_dives_at_stop_over_planted_feet);
  tcase_add_test(tests, it_leans_equally_in_every_heading);
  tcase_add_test(tests, every_frame_rate_shows_the_same_motion);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
