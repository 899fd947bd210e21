#include "clip_player.h"

#include <math.h>
#include <string.h>

#include "sbrun/animation.h"
#include "turns.h"

/* s of the clip in one tick at speed 1. */
static double tick_of(const soft_character *one) {
  double tick = one->model->asset->environment.control_tick;
  return (tick > 0 ? tick : 1.0 / 60) / sqrt((double)one->scale);
}

static const sbf_clip *clip_of(const soft_character *one, int32_t clip) {
  return clip >= 0 && (uint32_t)clip < one->model->asset->clips.count ? &one->model->asset->clips.at[clip]
                                                                      : NULL;
}

static void send(soft_character *one, uint32_t layer, float speed, float blend_s) {
  clip_layer *l = &one->clip_player->layers[layer];
  sbr_clip_play how = sbr_default_clip_play();
  how.weight = l->now.weight;
  how.fade_s = blend_s;
  how.speed = l->speed = speed;
  how.start_s = (float)l->time_s;
  how.bone_mask = l->now.mask;
  sbr_character_play_clip(one->world, one->id, layer, l->now.clip, &how);
}

static void start(soft_character *one, uint32_t layer, const clip_request *request) {
  clip_layer *l = &one->clip_player->layers[layer];
  bool same = l->now.clip == request->clip && request->clip != SBF_NONE;
  const sbf_clip *clip = clip_of(one, request->clip);
  if (same && !l->plays) l->rewinds = true; /* the runtime goes on where it is */
  if (!same) l->time_s = clip && request->speed < 0 ? (double)clip->duration : 0, l->rewinds = false;
  l->now = *request;
  l->plays = clip != NULL;
  send(one, layer, request->speed, request->blend_s);
}

void clip_player_play(soft_character *one, uint32_t layer, const clip_request *request) {
  one->clip_player->layers[layer].queued = 0;
  start(one, layer, request);
}

bool clip_player_queue(soft_character *one, uint32_t layer, const clip_request *request) {
  clip_layer *l = &one->clip_player->layers[layer];
  if (!l->plays) return start(one, layer, request), true;
  if (l->queued == CLIP_QUEUE) return false;
  l->queue[l->queued++] = *request;
  return true;
}

/* Seconds of the clip until its end at its speed. */
static double left_of(const clip_layer *l, const sbf_clip *clip) {
  return l->now.speed < 0 ? l->time_s : (double)clip->duration - l->time_s;
}

/* ---- Root motion ---- */

/* Track of the body bone's translation; NULL: none. */
static const sbf_track *body_track(const soft_character *one, const sbf_clip *clip) {
  const sbf_asset *asset = one->model->asset;
  for (uint32_t i = 0; asset->gaits.count && i < clip->tracks.count; i++) {
    const sbf_track *track = &clip->tracks.at[i];
    if (track->bone == asset->gaits.at[0].body && track->property == SBF_TRACK_PROPERTY_TRANSLATION &&
        track->times.count)
      return track;
  }
  return NULL;
}

/* Linear between keys. */
static sbf_vec3 sampled(const sbf_track *track, float time) {
  uint32_t wide = track->interpolation == SBF_INTERPOLATION_CUBIC ? 9 : 3, first = wide == 9 ? 3 : 0, i = 0;
  const float *times = track->times.at;
  while (i + 1 < track->times.count && times[i + 1] <= time) i++;
  const float *a = track->values.at + (size_t)i * wide + first;
  bool last =
      i + 1 == track->times.count || track->interpolation == SBF_INTERPOLATION_STEP || time <= times[i];
  float t = last ? 0 : (time - times[i]) / (times[i + 1] - times[i]);
  const float *b = last ? a : a + wide;
  return (sbf_vec3){a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

static sbf_vec3 between(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){b.x - a.x, b.y - a.y, b.z - a.z};
}

/* Moves the character as its body bone moves in the step's part of the clip. */
static void move_root(soft_character *one, const clip_layer *l, const sbf_clip *clip, double step) {
  const sbf_track *track = l->now.root_motion ? body_track(one, clip) : NULL;
  if (!track || l->rewinds) return;
  double end = l->time_s + step * (double)l->speed, duration = (double)clip->duration;
  sbf_vec3 first = sampled(track, 0), last = sampled(track, clip->duration), moved,
           whole = between(first, last);
  if (l->now.loops && clip->loop) {
    double rounds = floor(end / duration);
    moved = between(sampled(track, (float)l->time_s), sampled(track, (float)(end - rounds * duration)));
    float n = (float)rounds;
    moved = (sbf_vec3){moved.x + n * whole.x, moved.y + n * whole.y, moved.z + n * whole.z};
  } else
    moved = between(sampled(track, (float)l->time_s), sampled(track, (float)fmin(fmax(end, 0), duration)));
  const sbf_bone *body = &one->model->asset->bones.at[track->bone];
  if (body->parent >= 0) moved = turned(one->model->asset->bones.at[body->parent].rotation, moved);
  gd_transform at = upright((sbf_vec3){0, 0, 0}, transform_heading(&one->placement.shown_at), one->scale);
  moved = placed_vector(&at, moved);
  sbr_character_displace(one->world, one->id, (sbf_vec3){moved.x, 0, moved.z}, 0);
}

/* ---- A frame ---- */

/* A clip that the file loops would begin again, so it is slowed down to stop at its end; one that it does not
 * loop stays at its end, and is taken back to its beginning. */
void clip_player_prepare(soft_character *one, float frame_s) {
  if (!one->clip_player) return;
  double tick = tick_of(one), world_tick = tick * sqrt((double)one->scale);
  double step = fmax(ceil((double)frame_s / world_tick - 0.01), 1) * tick;
  for (uint32_t i = 0; i < CLIP_LAYERS; i++) {
    clip_layer *l = &one->clip_player->layers[i];
    const sbf_clip *clip = clip_of(one, l->now.clip);
    if (!clip || !l->plays || !(clip->duration > 0)) continue;
    double left = left_of(l, clip), end = l->now.speed < 0 ? (double)clip->duration : 0;
    if (l->rewinds || (l->now.loops && !clip->loop && !(left > 0)))
      l->rewinds = true, send(one, i, (float)((end - l->time_s) / step), 0);
    else if (clip->loop && !l->now.loops && left < step * fabs((double)l->now.speed))
      send(one, i, copysignf((float)(fmax(left - 1e-4 * (double)clip->duration, 0) / step), l->now.speed), 0);
    else if (l->speed != l->now.speed)
      send(one, i, l->now.speed, 0);
    if (!one->placement.is_still) move_root(one, l, clip, step);
  }
}

static void end(soft_character *one, uint32_t layer) {
  clip_player *player = one->clip_player;
  clip_layer *l = &player->layers[layer];
  l->plays = false;
  if (player->ended_count < CLIP_LAYERS * 2) player->ended[player->ended_count++] = l->now.clip;
  send(one, layer, 0, 0);
  if (!l->queued) return;
  clip_request next = l->queue[0];
  memmove(&l->queue[0], &l->queue[1], --l->queued * sizeof l->queue[0]);
  start(one, layer, &next);
}

void clip_player_advance(soft_character *one) {
  clip_player *player = one->clip_player;
  if (!player) return;
  uint64_t tick = sbr_world_get_tick_count(one->world);
  double passed = (double)(tick - player->tick) * tick_of(one);
  player->tick = tick;
  for (uint32_t i = 0; i < CLIP_LAYERS && passed > 0 && !one->placement.is_still; i++) {
    clip_layer *l = &player->layers[i];
    const sbf_clip *clip = clip_of(one, l->now.clip);
    if (!clip || !l->plays) continue;
    double duration = (double)clip->duration;
    l->time_s += passed * (double)l->speed;
    if (l->rewinds) {
      l->rewinds = false;
      l->time_s = l->now.speed < 0 ? duration : 0;
    } else if (l->now.loops && clip->loop) {
      l->time_s = duration > 0 ? l->time_s - duration * floor(l->time_s / duration) : 0;
    } else {
      l->time_s = fmin(fmax(l->time_s, 0), duration);
      if (!l->now.loops && !(left_of(l, clip) > 2e-4 * duration) && l->now.speed != 0) end(one, i);
    }
  }
}

int32_t clip_player_take_ended(soft_character *one) {
  clip_player *player = one->clip_player;
  if (!player || !player->ended_count) return SBF_NONE;
  int32_t first = player->ended[0];
  memmove(&player->ended[0], &player->ended[1], --player->ended_count * sizeof player->ended[0]);
  return first;
}

void clip_player_remade(soft_character *one) {
  clip_player *player = one->clip_player;
  if (!player) return;
  player->tick = sbr_world_get_tick_count(one->world);
  player->ended_count = 0;
  for (uint32_t i = 0; i < CLIP_LAYERS; i++)
    if (!clip_of(one, player->layers[i].now.clip))
      player->layers[i] = (clip_layer){.now = {.clip = SBF_NONE}};
}
