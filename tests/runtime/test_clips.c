#include "gait_stage.h"
#include "harness.h"
#include "quadruped.h"
#include "sbfmt/asset.h"

#include <stdlib.h>

enum { BONES = 20, HEAD = 4, FOOT = 10 };

static const float times[2] = {0, 1};

/* A clip of a second that turns the head about X from 0 to 1 rad. */
static void begin(gait_stage *s, sbf_interpolation interpolation, const float *values, uint32_t count) {
  sbf_asset *asset = quadruped_asset();
  sbf_clip *clip = sbf_asset_allocate(asset, 1, sizeof *clip);
  sbf_track *track = sbf_asset_allocate(asset, 1, sizeof *track);
  sbf_clip_init(clip);
  sbf_track_init(track);
  track->bone = HEAD;
  track->property = SBF_TRACK_PROPERTY_ROTATION;
  track->interpolation = interpolation;
  track->times = (sbf_f32_list){times, 2};
  track->values = (sbf_f32_list){values, count};
  clip->duration = 1;
  clip->tracks = (sbf_track_list){track, 1};
  asset->clips = (sbf_clip_list){clip, 1};
  gait_stage_begin(s, asset);
}

static float head_angle(const gait_stage *s) {
  return sbri_quat_log(s->pose[HEAD].rotation).x;
}

static const float turning[8] = {0, 0, 0, 1, 0.479425539f, 0, 0, 0.877582562f};

START_TEST(a_clip_rotates_its_bone_and_no_other)
{
  gait_stage s;
  begin(&s, SBF_INTERPOLATION_LINEAR, turning, 8);
  gait_stage_play(&s);
  gait_stage_ticks(&s, 30);
  ck_assert_float_eq_tol(head_angle(&s), 0.5f, 1e-3f);
  ck_assert_float_le(sbri_length(sbri_sub(s.pose[FOOT].position, s.rig.bones.rest[FOOT].position)), 1e-4f);
  gait_stage_ticks(&s, 45);
  ck_assert_float_eq_tol(head_angle(&s), 0.25f, 2e-2f); /* it began again at its end */
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_clip_that_does_not_loop_stays_at_its_end)
{
  gait_stage s;
  begin(&s, SBF_INTERPOLATION_LINEAR, turning, 8);
  ((sbf_clip *)(uintptr_t)s.asset->clips.at)->loop = false;
  gait_stage_play(&s);
  gait_stage_ticks(&s, 61);
  for (int i = 0; i < 20; i++) {
    gait_stage_ticks(&s, 1);
    ck_assert_float_eq_tol(head_angle(&s), 1, 1e-3f);
  }
  s.state->clips[0].speed = -1;
  gait_stage_ticks(&s, 90);
  ck_assert_float_eq_tol(head_angle(&s), 0, 1e-3f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(weights_fade_and_masks_exclude)
{
  gait_stage s;
  begin(&s, SBF_INTERPOLATION_STEP, turning + 4, 4);
  sbf_track *track = (sbf_track *)(uintptr_t)&s.asset->clips.at[0].tracks.at[0];
  track->times.count = 1;
  s.state->clips[1] = (sbri_clip_layer){.clip_plus_1 = 1, .speed = 1, .target_weight = 1, .fade_s = 1};
  gait_stage_ticks(&s, 30);
  ck_assert_float_eq_tol(head_angle(&s), 0.5f, 0.03f);
  sbf_bone_mask *mask = sbf_asset_allocate(s.asset, 1, sizeof *mask);
  sbf_bone_mask_init(mask);
  static const uint32_t only[1] = {0};
  mask->bones = (sbf_u32_list){only, 1};
  s.asset->bone_masks = (sbf_bone_mask_list){mask, 1};
  s.state->clips[1].mask_plus_1 = 1;
  gait_stage_ticks(&s, 1);
  ck_assert_float_eq_tol(head_angle(&s), 0, 1e-4f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(feet_that_a_clip_moves_still_do_not_slide)
{
  gait_stage s;
  begin(&s, SBF_INTERPOLATION_LINEAR, turning, 8);
  ((sbf_track *)(uintptr_t)&s.asset->clips.at[0].tracks.at[0])->bone = 8; /* a thigh */
  gait_stage_play(&s);
  s.input.forward = 0.2f;
  sbf_vec3 stance = {0};
  bool was = false;
  for (int i = 0; i < 240; i++) {
    gait_stage_ticks(&s, 1);
    if (s.state->feet[0].planted && was)
      ck_assert_float_le(sbri_length(sbri_sub(s.pose[FOOT].position, stance)), 1e-4f);
    else
      stance = s.pose[FOOT].position;
    was = s.state->feet[0].planted;
  }
  gait_stage_end(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("clips");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_clip_rotates_its_bone_and_no_other);
  tcase_add_test(tests, a_clip_that_does_not_loop_stays_at_its_end);
  tcase_add_test(tests, weights_fade_and_masks_exclude);
  tcase_add_test(tests, feet_that_a_clip_moves_still_do_not_slide);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
