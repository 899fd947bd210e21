/* The pose below the gait: bones relative to their parents, from the rest pose, from poses keyed by the
 * distance walked, and from clips. */
#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"

static sbf_quat quat_at(const float *v) {
  return sbri_quat_normalize((sbf_quat){v[0], v[1], v[2], v[3]});
}

/* Spherical linear interpolation along the shorter arc. */
static sbf_quat slerp(sbf_quat a, sbf_quat b, float t) {
  sbf_vec3 turn = sbri_quat_log(sbri_quat_multiply(b, sbri_quat_conjugate(a)));
  return sbri_quat_normalize(sbri_quat_multiply(sbri_quat_exp(sbri_scale(turn, t)), a));
}

/* Samples a track at a time into `width` numbers; keys as in glTF. */
static void sample_track(const sbf_track *track, float time, uint32_t width, float *out) {
  bool cubic = track->interpolation == SBF_INTERPOLATION_CUBIC;
  uint32_t stride = width * (cubic ? 3 : 1), last = track->times.count - 1, low = 0, high = last;
  const float *times = track->times.at, *values = track->values.at + (cubic ? width : 0);
  if (time <= times[0]) high = 0;
  if (time >= times[last]) low = last;
  while (low + 1 < high) {
    uint32_t middle = (low + high) / 2;
    *(times[middle] <= time ? &low : &high) = middle;
  }
  if (high < low) high = low;
  const float *a = values + (size_t)low * stride, *b = values + (size_t)high * stride;
  float span = times[high] - times[low], t = span > 0 ? (time - times[low]) / span : 0;
  if (track->interpolation == SBF_INTERPOLATION_STEP) t = 0;
  if (low == high) t = 0;
  if (cubic) {
    float t2 = t * t, t3 = t2 * t;
    for (uint32_t i = 0; i < width; i++)
      out[i] = (2 * t3 - 3 * t2 + 1) * a[i] + span * (t3 - 2 * t2 + t) * a[i + width] +
               (3 * t2 - 2 * t3) * b[i] + span * (t3 - t2) * b[(ptrdiff_t)i - (ptrdiff_t)width];
  } else if (width == 4) {
    sbf_quat q = slerp(quat_at(a), quat_at(b), t);
    out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
  } else {
    for (uint32_t i = 0; i < width; i++) out[i] = a[i] + t * (b[i] - a[i]);
  }
}

static float weight_of(const sbf_asset *asset, int32_t mask, uint32_t bone) {
  if (mask < 0 || mask >= (int32_t)asset->bone_masks.count) return 1;
  const sbf_bone_mask *m = &asset->bone_masks.at[mask];
  for (uint32_t i = 0; i < m->bones.count; i++)
    if (m->bones.at[i] == bone) return m->weights.count ? m->weights.at[i] : 1;
  return 0;
}

static void play_clip(const sbri_rig *rig, const sbri_clip_layer *layer, sbr_transform *locals) {
  const sbf_asset *asset = rig->asset;
  const sbf_clip *clip = &asset->clips.at[layer->clip_plus_1 - 1];
  int32_t body = rig->gait ? rig->gait->body : -1;
  for (uint32_t i = 0; i < clip->tracks.count; i++) {
    const sbf_track *track = &clip->tracks.at[i];
    float weight = layer->weight * weight_of(asset, (int32_t)layer->mask_plus_1 - 1, (uint32_t)track->bone),
          v[4];
    if (weight <= 0 || track->times.count == 0 || track->property == SBF_TRACK_PROPERTY_SCALE) continue;
    sbr_transform *local = &locals[track->bone];
    if (track->property == SBF_TRACK_PROPERTY_ROTATION) {
      sample_track(track, layer->time_s, 4, v);
      local->rotation = sbri_quat_blend(local->rotation, quat_at(v), weight);
    } else {
      sample_track(track, layer->time_s, 3, v);
      sbf_vec3 to = {v[0], v[1], v[2]};
      if (track->bone == body)
        to.x = local->position.x, to.z = local->position.z; /* the gait moves it horizontally */
      local->position = sbri_lerp(local->position, to, weight);
    }
  }
}

/* The clips of the gait, weighted by its speed. */
static void play_gait_clips(
    const sbri_rig *rig, const sbri_gait_state *state, float scale, sbr_transform *locals) {
  if (!sbri_has_motion(rig)) return;
  const sbf_gait *gait = rig->gait;
  const sbri_motion_state *m = sbri_motion(rig, (sbri_gait_state *)(uintptr_t)state);
  float moves = sbri_clamp(2 * sbri_motion_speed(rig, state) / (gait->walk_speed * scale), 0, 1);
  sbri_clip_layer idle = {(uint32_t)gait->idle_clip + 1, 0, m->idle_time, 1, 1 - moves, 0, 0};
  sbri_clip_layer move = {(uint32_t)gait->move_clip + 1, 0, m->move_time, 1, moves, 0, 0};
  if (gait->idle_clip != SBF_NONE) play_clip(rig, &idle, locals);
  if (gait->move_clip != SBF_NONE) play_clip(rig, &move, locals);
}

void sbri_clips_tick(const sbri_rig *rig, sbri_gait_state *state, float tick_s) {
  for (uint32_t l = 0; l < SBRI_CLIP_LAYERS; l++) {
    sbri_clip_layer *layer = &state->clips[l];
    if (!layer->clip_plus_1) continue;
    const sbf_clip *clip = &rig->asset->clips.at[layer->clip_plus_1 - 1];
    float max = layer->fade_s > 0 ? tick_s / layer->fade_s : 1, off = layer->target_weight - layer->weight;
    layer->weight += sbri_clamp(off, -max, max);
    layer->time_s += tick_s * layer->speed;
    if (layer->weight <= 0 && layer->target_weight <= 0) layer->clip_plus_1 = 0;
    if (!(clip->duration > 0)) continue;
    if (!clip->loop) {
      layer->time_s = sbri_clamp(layer->time_s, 0, clip->duration);
      continue;
    }
    layer->time_s = sbri_wrap(layer->time_s, clip->duration);
  }
}

bool sbri_clips_play(const sbri_gait_state *state) {
  for (uint32_t l = 0; l < SBRI_CLIP_LAYERS; l++)
    if (state->clips[l].clip_plus_1 && state->clips[l].weight > 0) return true;
  return false;
}

void sbri_clips_pose(const sbri_rig *rig, const sbri_gait_state *state, float scale, sbr_transform *locals) {
  for (uint32_t i = 0; i < rig->bones.count; i++) locals[i] = rig->bones.base_local[i];
  sbri_walk_pose(rig, state, scale, locals);
  play_gait_clips(rig, state, scale, locals);
  for (uint32_t l = 0; l < SBRI_CLIP_LAYERS; l++)
    if (state->clips[l].clip_plus_1 && state->clips[l].weight > 0) play_clip(rig, &state->clips[l], locals);
}
