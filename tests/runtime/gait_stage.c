#include "gait_stage.h"

#include <stdlib.h>

#include "animation/skeleton/rig_make.h"
#include "sbfmt/asset.h"

/* Rig, state and pose, of the asset and the input. */
static void make(gait_stage *s) {
  s->memory = malloc(sbri_rig_size(s->asset));
  sbri_rig_init(&s->rig, s->asset, s->memory);
  s->state = malloc(sbri_gait_state_size(&s->rig));
  s->pose = calloc(s->rig.bones.count, sizeof *s->pose);
  sbri_gait_reset(&s->rig, s->state, &s->input, sbri_vec3(0, 0, 0), 0);
  sbri_gait_pose(&s->rig, s->state, &s->input, true, s->pose);
}

static void drop(gait_stage *s) {
  free(s->pose);
  free(s->state);
  free(s->memory);
}

static void begin(gait_stage *s, sbf_asset *asset, float tick_s, float scale, sbr_ground ground) {
  s->asset = asset;
  s->ground = ground;
  s->input = (sbri_gait_input){.tick_s = tick_s, .scale = scale, .ground = &s->ground};
  make(s);
}

void gait_stage_begin_scaled(gait_stage *s, sbf_asset *asset, float tick_s, float scale) {
  begin(s, asset, tick_s, scale, sbr_ground_flat(0));
}

void gait_stage_begin(gait_stage *s, sbf_asset *asset) {
  gait_stage_begin_scaled(s, asset, 1.0f / 60, 1);
}

void gait_stage_begin_on(gait_stage *s, sbf_asset *asset,
    double (*height)(const sbr_ground *, double, double, sbf_vec3 *), double parameter) {
  begin(s, asset, 1.0f / 60, 1, (sbr_ground){height, NULL, {parameter, 0, 0, 0}});
}

void gait_stage_end(gait_stage *s) {
  drop(s);
  sbf_asset_free(s->asset);
}

void gait_stage_remake(gait_stage *s) {
  drop(s);
  make(s);
}

void gait_stage_ticks(gait_stage *s, int count) {
  for (int i = 0; i < count; i++) {
    sbri_gait_begin_tick(&s->rig, s->state);
    sbri_gait_tick(&s->rig, s->state, &s->input, s->pose, NULL, 0);
  }
}

void gait_stage_play(gait_stage *s) {
  s->state->clips[0] = (sbri_clip_layer){.clip_plus_1 = 1, .speed = 1, .weight = 1, .target_weight = 1};
}

void gait_stage_step_clip(
    sbf_asset *asset, uint32_t bone, sbf_track_property property, const float *values, uint32_t count) {
  static const float times[1] = {0};
  sbf_clip *clip = sbf_asset_allocate(asset, 1, sizeof *clip);
  sbf_track *track = sbf_asset_allocate(asset, 1, sizeof *track);
  sbf_clip_init(clip);
  sbf_track_init(track);
  track->bone = (int32_t)bone;
  track->property = property;
  track->interpolation = SBF_INTERPOLATION_STEP;
  track->times = (sbf_f32_list){times, 1};
  track->values = (sbf_f32_list){values, count};
  clip->tracks = (sbf_track_list){track, 1};
  asset->clips = (sbf_clip_list){clip, 1};
}
