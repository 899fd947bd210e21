#include <stdlib.h>

#include "gait_stage.h"
#include "harness.h"
#include "quadruped.h"
#include "sbfmt/asset.h"

enum { BONES = 20, HEAD = 4, ARM_L = 14, ARM_R = 17 };

typedef struct key {
  float distance, speed, angle;
  bool mirrored;
  uint32_t bone;
  sbf_vec3 axis, translation;
} key;

/* One pose per key, the first the rest pose if its distance is 0; bones rotated at rest by `turned` about
 * different axes. */
static void begin(gait_stage *s, const key *keys, uint32_t count, float turned) {
  sbf_asset *asset = quadruped_asset();
  for (uint32_t b = 0; b < BONES && turned > 0; b++) {
    sbf_vec3 axis = sbri_normalize(sbri_vec3(1, (float)b - 7, 3), sbri_vec3(0, 1, 0));
    ((sbf_bone *)(uintptr_t)asset->bones.at)[b].rotation = sbri_quat_about(axis, turned * (float)b);
  }
  sbf_pose *poses = sbf_asset_allocate(asset, count, sizeof *poses);
  sbf_pose_key *pose_keys = sbf_asset_allocate(asset, count, sizeof *pose_keys);
  for (uint32_t i = 0; i < count; i++) {
    sbf_pose_init(&poses[i]);
    sbf_pose_key_init(&pose_keys[i]);
    pose_keys[i].bone = (int32_t)keys[i].bone;
    pose_keys[i].rotation = sbri_quat_about(sbri_normalize(keys[i].axis, sbri_vec3(1, 0, 0)), keys[i].angle);
    pose_keys[i].translation = keys[i].translation;
    poses[i].distance = keys[i].distance;
    poses[i].speed = keys[i].speed;
    poses[i].mirrored = keys[i].mirrored;
    poses[i].keys = (sbf_pose_key_list){&pose_keys[i], 1};
  }
  asset->poses = (sbf_pose_list){poses, count};
  if (keys[0].distance == 0) ((sbf_gait *)(uintptr_t)asset->gaits.at)->rest_pose = 0;
  gait_stage_begin(s, asset);
}

static float head_angle(const gait_stage *s) {
  return sbri_quat_log(s->pose[HEAD].rotation).x;
}

START_TEST(poses_advance_with_the_distance_walked)
{
  static const key keys[] = {{0.1f, 0, 0.4f, false, HEAD, {1, 0, 0}, {0, 0, 0}},
      {0.2f, 0, -0.4f, false, HEAD, {1, 0, 0}, {0, 0, 0}}};
  gait_stage s;
  begin(&s, keys, 2, 0);
  gait_stage_ticks(&s, 10);
  ck_assert_float_eq_tol(head_angle(&s), 0, 1e-4f); /* standing */
  s.input.forward = 0.3f;
  float max = 0, min = 0;
  for (int i = 0; i < 240; i++) {
    gait_stage_ticks(&s, 1);
    max = fmaxf(max, head_angle(&s)), min = fminf(min, head_angle(&s));
    if (i < 120) continue;
    double s_in_cycle = fmod(s.state->distance_m, 0.2);
    double fraction = s_in_cycle < 0.1 ? s_in_cycle / 0.1 : 2 - s_in_cycle / 0.1;
    double eased = fraction * fraction * (3 - 2 * fraction); /* both are turning points */
    ck_assert_float_eq_tol(head_angle(&s), (float)(-0.4 + 0.8 * eased), 0.02f);
  }
  ck_assert_float_gt(max, 0.3f);
  ck_assert_float_lt(min, -0.3f);
  gait_stage_end(&s);
}
END_TEST

/* Arms that hang in the rest pose swing about that pose, not about the one they were bound in. */
START_TEST(a_walk_adds_to_the_rest_pose)
{
  static const key keys[] = {{0, 0, 0.5f, false, HEAD, {1, 0, 0}, {0, 0, 0}},
      {0.1f, 0, 0.1f, false, HEAD, {1, 0, 0}, {0, 0, 0}},
      {0.2f, 0, -0.1f, false, HEAD, {1, 0, 0}, {0, 0, 0}}};
  gait_stage s;
  begin(&s, keys, 3, 0);
  gait_stage_ticks(&s, 10);
  ck_assert_float_eq_tol(head_angle(&s), 0.5f, 1e-4f);
  s.input.forward = 0.3f;
  float max = 0, min = 1;
  for (int i = 0; i < 240; i++) {
    gait_stage_ticks(&s, 1);
    max = fmaxf(max, head_angle(&s)), min = fminf(min, head_angle(&s));
  }
  ck_assert_float_eq_tol(max, 0.6f, 0.02f);
  ck_assert_float_eq_tol(min, 0.4f, 0.02f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(walking_backward_plays_the_walk_in_reverse)
{
  static const key keys[] = {{0.1f, 0, 0.4f, false, HEAD, {1, 0, 0}, {0, 0, 0}},
      {0.3f, 0, -0.4f, false, HEAD, {1, 0, 0}, {0, 0, 0}}};
  gait_stage s;
  begin(&s, keys, 2, 0);
  s.input.forward = -0.2f;
  gait_stage_ticks(&s, 60);
  for (int i = 0; i < 100; i++) {
    float before = s.state->walk.phase;
    gait_stage_ticks(&s, 1);
    float gone = s.state->walk.phase - before;
    ck_assert(gone < 0 || gone > 0.9f);
  }
  gait_stage_end(&s);
}
END_TEST

/* Heads of all bones in asset space, of a body that is at rest but for its walk. */
static void show(gait_stage *s, float phase, sbf_vec3 *heads) {
  sbr_transform frames[BONES];
  const sbri_rig *rig = &s->rig;
  for (uint32_t b = 0; b < BONES; b++) s->pose[b] = rig->bones.rest_local[b];
  s->state->motion.forward = 1, s->state->stepping.speed_fraction = 1, s->state->walk.phase = phase;
  sbri_walk_pose(rig, s->state, 1, s->pose);
  for (uint32_t b = 0; b < BONES; b++) {
    frames[b] = s->pose[b];
    if (rig->bones.parents[b] >= 0) {
      const sbr_transform *above = &frames[rig->bones.parents[b]];
      frames[b].position = sbri_add(above->position, sbri_rotate(above->rotation, frames[b].position));
      frames[b].rotation = sbri_quat_multiply(above->rotation, frames[b].rotation);
    }
    heads[b] = frames[b].position;
  }
}

START_TEST(the_second_half_is_the_mirror_image_of_the_first)
{
  static const uint32_t across[BONES] = {
      0, 1, 2, 3, 4, 5, 6, 7, 11, 12, 13, 8, 9, 10, 17, 18, 19, 14, 15, 16};
  static const key keys[] = {{0.1f, 0, 0.7f, true, ARM_L, {1, 0.4f, 0.2f}, {0.01f, 0.02f, 0.03f}},
      {0.2f, 0, 0.3f, false, 2, {0.2f, 1, 0.3f}, {0, 0.01f, 0}}, /* one property applies to all */
      {0.25f, 0, -0.5f, false, ARM_R, {1, 0, 0.1f}, {0, 0, 0}}};
  gait_stage s;
  begin(&s, keys, 3, 0.3f);
  ck_assert_float_eq_tol(s.rig.walks.walks[0].cycle_m, 0.5f, 1e-6f);
  ck_assert_uint_eq(s.rig.walks.walks[0].frame_count, 6);
  ck_assert_uint_eq(s.rig.walks.bone_count, 3);
  float moved = 0;
  for (float phase = 0.02f; phase < 0.5f; phase += 0.06f) {
    sbf_vec3 first[BONES], second[BONES];
    show(&s, phase, first), show(&s, phase + 0.5f, second);
    for (uint32_t b = 0; b < BONES; b++) {
      sbf_vec3 there = second[across[b]];
      there.x = -there.x;
      ck_assert_float_le(sbri_length(sbri_sub(first[b], there)), 1e-5f);
      moved = fmaxf(moved, sbri_length(sbri_sub(first[b], s.rig.bones.rest[b].position)));
    }
  }
  ck_assert_float_gt(moved, 0.05f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_walk_becomes_a_run)
{
  static const key keys[] = {{0.1f, 0.2f, 0.4f, false, HEAD, {1, 0, 0}, {0, 0, 0}},
      {0.2f, 0.2f, 0, false, HEAD, {1, 0, 0}, {0, 0, 0}},
      {0.3f, 0.6f, 0.8f, false, HEAD, {1, 0, 0}, {0, 0, 0}},
      {0.6f, 0.6f, 0, false, HEAD, {1, 0, 0}, {0, 0, 0}}};
  static const float speeds[] = {0.2f, 0.4f, 0.6f}, cycles[] = {0.2f, 0.4f, 0.6f},
                     tops[] = {0.4f, 0.6f, 0.8f};
  gait_stage s;
  begin(&s, keys, 4, 0);
  ck_assert_uint_eq(s.rig.walks.walk_count, 2);
  for (int i = 0; i < 3; i++) {
    sbri_gait_state state = {
        .motion = {.forward = speeds[i]}, .stepping = {.speed_fraction = 1}, .walk = {.phase = 0.5f}};
    for (uint32_t b = 0; b < BONES; b++) s.pose[b] = s.rig.bones.rest_local[b];
    float weight = fminf(1, speeds[i] / 0.25f); /* half of the gait's walking speed */
    sbri_walk_pose(&s.rig, &state, 1, s.pose);
    ck_assert_float_eq_tol(sbri_quat_log(s.pose[HEAD].rotation).x, weight * tops[i], 0.01f);
    sbri_walk_tick(&s.rig, &state, 0.05f, 1);
    ck_assert_float_eq_tol(state.walk.phase, 0.5f + 0.05f / cycles[i], 1e-5f);
    sbri_gait_state tall = {
        .motion = {.forward = 2 * speeds[i]}, .stepping = {.speed_fraction = 1}, .walk = {.phase = 0.5f}};
    sbri_walk_tick(&s.rig, &tall, 0.1f, 2); /* twice as large, all lengths are */
    ck_assert_float_eq_tol(tall.walk.phase, state.walk.phase, 1e-5f);
  }
  gait_stage_end(&s);
}
END_TEST

/* The poses' strides are a third longer than the feet's. Both stay in phase, and no foot slides. */
START_TEST(a_mirrored_walk_keeps_step_with_the_feet)
{
  key keys[] = {
      {0.1f, 0, 0.3f, true, HEAD, {0, 1, 0}, {0, 0, 0}}, {0.2f, 0, 0.1f, true, 8, {1, 0, 0}, {0, 0, 0}}};
  gait_stage s;
  begin(&s, keys, 2, 0);
  ck_assert_int_eq(s.rig.walks.first_leg, QUADRUPED_HIND_L);
  ck_assert_int_eq(s.rig.walks.other_leg, QUADRUPED_HIND_R);
  s.input.forward = 0.6f;
  gait_stage_ticks(&s, 300);
  double from = s.state->distance_m;
  uint32_t steps = s.state->feet[0].steps_taken;
  while (s.state->feet[0].steps_taken < steps + 4) gait_stage_ticks(&s, 1);
  float stride = (float)(s.state->distance_m - from) / 4;
  gait_stage_end(&s);
  keys[0].distance = 0.33f * stride, keys[1].distance = 0.66f * stride;
  begin(&s, keys, 2, 0);
  s.input.forward = 0.6f;
  gait_stage_ticks(&s, 240);
  sbf_vec3 stance[2] = {{0, 0, 0}, {0, 0, 0}};
  int landings = 0;
  for (int i = 0; i < 360; i++) {
    gait_stage_ticks(&s, 1);
    for (int l = 0; l < 2; l++) {
      const sbri_foot *foot = &s.state->feet[l];
      sbf_vec3 ankle = s.pose[l ? 13 : 10].position;
      if (i > 0 && foot->planted && foot->was_planted)
        ck_assert_float_le(sbri_length(sbri_sub(ankle, stance[l])), 2e-3f);
      stance[l] = ankle;
      if (!foot->planted || foot->was_planted) continue;
      float off = fabsf(s.state->walk.phase - 0.5f * (float)l);
      ck_assert_float_le(fminf(off, 1 - off), 0.25f);
      landings++;
    }
  }
  ck_assert_int_ge(landings, 6);
  gait_stage_end(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("walk_poses");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, poses_advance_with_the_distance_walked);
  tcase_add_test(tests, a_walk_adds_to_the_rest_pose);
  tcase_add_test(tests, walking_backward_plays_the_walk_in_reverse);
  tcase_add_test(tests, the_second_half_is_the_mirror_image_of_the_first);
  tcase_add_test(tests, a_walk_becomes_a_run);
  tcase_add_test(tests, a_mirrored_walk_keeps_step_with_the_feet);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
