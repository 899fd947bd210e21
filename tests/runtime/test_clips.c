#include "gait/gait_state.h"
#include "harness.h"
#include "quadruped.h"
#include "sbfmt/asset.h"

#include <stdlib.h>

enum { BONES = 20, HEAD = 4, FOOT = 10 };

typedef struct stage {
  quadruped q;
  sbri_gait_input input;
  sbr_ground ground;
  sbri_gait_state *state;
  sbr_transform pose[BONES];
} stage;

static const float times[2] = {0, 1};

/* A clip of a second that turns the head about X from 0 to 1 rad. */
static void begin(stage *s, sbf_interpolation interpolation, const float *values, uint32_t count) {
  quadruped_create(&s->q);
  sbf_clip *clip = sbf_asset_allocate(s->q.asset, 1, sizeof *clip);
  sbf_track *track = sbf_asset_allocate(s->q.asset, 1, sizeof *track);
  sbf_clip_init(clip);
  sbf_track_init(track);
  track->bone = HEAD;
  track->property = SBF_TRACK_PROPERTY_ROTATION;
  track->interpolation = interpolation;
  track->times = (sbf_f32_list){times, 2};
  track->values = (sbf_f32_list){values, count};
  clip->duration = 1;
  clip->tracks = (sbf_track_list){track, 1};
  s->q.asset->clips = (sbf_clip_list){clip, 1};
  s->ground = sbr_ground_flat(0);
  s->input = (sbri_gait_input){.tick_s = 1.0f / 60, .scale = 1, .ground = &s->ground};
  s->state = malloc(sbri_gait_state_size(&s->q.rig));
  sbri_gait_place(&s->q.rig, s->state, &s->input, sbri_vec3(0, 0, 0), 0);
}

static void end(stage *s) {
  free(s->state);
  quadruped_destroy(&s->q);
}

static void ticks(stage *s, int count) {
  for (int i = 0; i < count; i++) sbri_gait_tick(&s->q.rig, s->state, &s->input, s->pose, NULL, 0);
}

static float head_angle(const stage *s) {
  return sbri_quat_log(s->pose[HEAD].rotation).x;
}

static const float turning[8] = {0, 0, 0, 1, 0.479425539f, 0, 0, 0.877582562f};

START_TEST(a_clip_turns_its_bone_and_no_other)
{
  stage s;
  begin(&s, SBF_INTERPOLATION_LINEAR, turning, 8);
  s.state->clips[0] = (sbri_clip_layer){.clip_plus_1 = 1, .speed = 1, .weight = 1, .wanted = 1};
  ticks(&s, 30);
  ck_assert_float_eq_tol(head_angle(&s), 0.5f, 1e-3f);
  ck_assert_float_le(sbri_length(sbri_sub(s.pose[FOOT].position, s.q.rig.rest[FOOT].position)), 1e-4f);
  ticks(&s, 45);
  ck_assert_float_eq_tol(head_angle(&s), 0.25f, 2e-2f); /* it began again at its end */
  end(&s);
}
END_TEST

START_TEST(a_clip_that_does_not_loop_stays_at_its_end)
{
  stage s;
  begin(&s, SBF_INTERPOLATION_LINEAR, turning, 8);
  ((sbf_clip *)(uintptr_t)s.q.asset->clips.at)->loop = false;
  s.state->clips[0] = (sbri_clip_layer){.clip_plus_1 = 1, .speed = 1, .weight = 1, .wanted = 1};
  ticks(&s, 61);
  for (int i = 0; i < 20; i++) {
    ticks(&s, 1);
    ck_assert_float_eq_tol(head_angle(&s), 1, 1e-3f);
  }
  s.state->clips[0].speed = -1;
  ticks(&s, 90);
  ck_assert_float_eq_tol(head_angle(&s), 0, 1e-3f);
  end(&s);
}
END_TEST

START_TEST(weights_fade_and_masks_hold_back)
{
  stage s;
  begin(&s, SBF_INTERPOLATION_STEP, turning + 4, 4);
  sbf_track *track = (sbf_track *)(uintptr_t)&s.q.asset->clips.at[0].tracks.at[0];
  track->times.count = 1;
  s.state->clips[1] = (sbri_clip_layer){.clip_plus_1 = 1, .speed = 1, .wanted = 1, .fade_s = 1};
  ticks(&s, 30);
  ck_assert_float_eq_tol(head_angle(&s), 0.5f, 0.03f);
  sbf_bone_mask *mask = sbf_asset_allocate(s.q.asset, 1, sizeof *mask);
  sbf_bone_mask_init(mask);
  static const uint32_t only[1] = {0};
  mask->bones = (sbf_u32_list){only, 1};
  s.q.asset->bone_masks = (sbf_bone_mask_list){mask, 1};
  s.state->clips[1].mask_plus_1 = 1;
  ticks(&s, 1);
  ck_assert_float_eq_tol(head_angle(&s), 0, 1e-4f);
  end(&s);
}
END_TEST

START_TEST(feet_that_a_clip_moves_still_do_not_slide)
{
  stage s;
  begin(&s, SBF_INTERPOLATION_LINEAR, turning, 8);
  ((sbf_track *)(uintptr_t)&s.q.asset->clips.at[0].tracks.at[0])->bone = 8; /* a thigh */
  s.state->clips[0] = (sbri_clip_layer){.clip_plus_1 = 1, .speed = 1, .weight = 1, .wanted = 1};
  s.input.forward = 0.2f;
  sbf_vec3 stance = {0};
  bool was = false;
  for (int i = 0; i < 240; i++) {
    ticks(&s, 1);
    if (s.state->feet[0].planted && was)
      ck_assert_float_le(sbri_length(sbri_sub(s.pose[FOOT].position, stance)), 1e-4f);
    else
      stance = s.pose[FOOT].position;
    was = s.state->feet[0].planted;
  }
  end(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("clips");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_clip_turns_its_bone_and_no_other);
  tcase_add_test(tests, a_clip_that_does_not_loop_stays_at_its_end);
  tcase_add_test(tests, weights_fade_and_masks_hold_back);
  tcase_add_test(tests, feet_that_a_clip_moves_still_do_not_slide);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
