/* Writes clips, and a simulated motion: bones are joints, and the remaining soft deformation is one morph
 * target per frame, each with a triangular weight over its own frame, so that the mesh is interpolated
 * between frames. */
#include <math.h>
#include <string.h>

#include "export/glb.h"

typedef struct channels {
  sbfi_text channels, samplers;
  uint32_t count;
} channels;

static void begin(sbfi_glb *g, channels *c) {
  c->count = 0;
  sbfi_text_init(&c->channels, &g->e->allocator);
  sbfi_text_init(&c->samplers, &g->e->allocator);
}

static void add_channel(channels *c, uint32_t node, const char *path, const char *interpolation,
    uint32_t times, uint32_t values) {
  const char *comma = c->count ? "," : "";
  sbfi_export_print(&c->channels, "%s{\"sampler\":%u,\"target\":{\"node\":%u,\"path\":\"%s\"}}", comma,
      c->count, node, path);
  sbfi_export_print(&c->samplers, "%s{\"input\":%u,\"interpolation\":\"%s\",\"output\":%u}", comma, times,
      interpolation, values);
  c->count++;
}

static void end(sbfi_glb *g, channels *c, const char *name) {
  if (c->count) {
    sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_ANIMATIONS, NULL);
    sbfi_text_string(text, "{\"name\":");
    sbfi_glb_write_string(text, name);
    sbfi_text_string(text, ",\"channels\":[");
    sbfi_text_append(text, c->channels.at, c->channels.length);
    sbfi_text_string(text, "],\"samplers\":[");
    sbfi_text_append(text, c->samplers.at, c->samplers.length);
    sbfi_text_string(text, "]}");
  }
  g->failed = g->failed || c->channels.failed || c->samplers.failed;
  sbfi_text_free(&c->channels);
  sbfi_text_free(&c->samplers);
}

/* glTF requires keys at increasing times from 0 on, the right number of values, and no duplicate
 * properties. */
bool sbfi_glb_writes_track(const sbf_clip *clip, uint32_t index) {
  const sbf_track *t = &clip->tracks.at[index];
  uint32_t width = t->property == SBF_TRACK_PROPERTY_ROTATION ? 4 : 3;
  if (t->interpolation == SBF_INTERPOLATION_CUBIC) width *= 3;
  if (!t->times.count || t->values.count != t->times.count * width || t->times.at[0] < 0) return false;
  for (uint32_t i = 1; i < t->times.count; i++)
    if (!(t->times.at[i] > t->times.at[i - 1])) return false;
  for (uint32_t i = 0; i < index; i++)
    if (clip->tracks.at[i].bone == t->bone && clip->tracks.at[i].property == t->property) return false;
  return true;
}

enum { REMEMBERED_TIMES = 8 };

/* Times of keys that an accessor holds already. */
typedef struct written_times {
  const float *at;
  uint32_t count, accessor;
} written_times;

/* Tracks of a clip often have their keys at the same times. */
static uint32_t write_times(sbfi_glb *g, sbf_f32_list times, written_times *written, uint32_t *count) {
  uint32_t remembered = *count < REMEMBERED_TIMES ? *count : REMEMBERED_TIMES;
  for (uint32_t i = 0; i < remembered; i++)
    if (written[i].count == times.count &&
        memcmp(written[i].at, times.at, times.count * sizeof *times.at) == 0)
      return written[i].accessor;
  uint32_t accessor = sbfi_glb_accessor(g, times.at, times.count, SBFI_GLB_FLOAT, SBFI_GLB_NO_TARGET);
  written[(*count)++ % REMEMBERED_TIMES] = (written_times){times.at, times.count, accessor};
  return accessor;
}

static void write_track(sbfi_glb *g, const sbf_track *t, channels *c, uint32_t times) {
  static const char *const paths[] = {"translation", "rotation", "scale"};
  static const char *const directions[] = {"LINEAR", "STEP", "CUBICSPLINE"};
  bool is_rotation = t->property == SBF_TRACK_PROPERTY_ROTATION,
       cubic = t->interpolation == SBF_INTERPOLATION_CUBIC;
  uint32_t width = is_rotation ? 4 : 3, count = t->values.count / width;
  float *values = sbfi_glb_allocate(g, t->values.count, sizeof *values);
  if (!values) return;
  memcpy(values, t->values.at, t->values.count * sizeof *values);
  for (uint32_t i = 0; is_rotation && i < count; i++) {
    float *q = values + 4 * (size_t)i;
    double length = sqrt((double)q[0] * (double)q[0] + (double)q[1] * (double)q[1] +
                         (double)q[2] * (double)q[2] + (double)q[3] * (double)q[3]);
    bool is_tangent = cubic && i % 3 != 1;
    for (int k = 0; k < 4 && !is_tangent && length > 0; k++) q[k] = (float)((double)q[k] / length);
  }
  uint32_t numbers =
      sbfi_glb_accessor(g, values, count, is_rotation ? SBFI_GLB_VEC4 : SBFI_GLB_VEC3, SBFI_GLB_NO_TARGET);
  add_channel(c, (uint32_t)t->bone, paths[t->property], directions[t->interpolation], times, numbers);
}

void sbfi_glb_write_clips(sbfi_glb *g) {
  const sbf_asset *asset = g->e->asset;
  written_times written[REMEMBERED_TIMES];
  uint32_t count = 0;
  for (uint32_t i = 0; i < asset->clips.count && !g->failed; i++) {
    const sbf_clip *clip = &asset->clips.at[i];
    channels c;
    begin(g, &c);
    for (uint32_t k = 0; k < clip->tracks.count; k++)
      if (sbfi_glb_writes_track(clip, k))
        write_track(g, &clip->tracks.at[k], &c, write_times(g, clip->tracks.at[k].times, written, &count));
      else
        g->omitted_tracks++;
    end(g, &c, *clip->name ? clip->name : clip->id);
  }
}

static sbfi_glb_transform write_position_at(const sbfi_glb *g, uint32_t frame, uint32_t bone) {
  size_t at = (size_t)frame * g->e->asset->bones.count + bone;
  return (sbfi_glb_transform){g->e->motion->bone_positions[at], g->e->motion->bone_rotations[at]};
}

static void write_bone(
    sbfi_glb *g, uint32_t bone, uint32_t times, float *translations, float *rotations, channels *c) {
  const sbf_asset *asset = g->e->asset;
  uint32_t frames = g->e->motion->frame_count;
  int32_t up = asset->bones.at[bone].parent;
  for (uint32_t f = 0; f < frames; f++) {
    float *q = rotations + 4 * (size_t)f;
    sbfi_glb_transform parent = up >= 0 ? write_position_at(g, f, (uint32_t)up) : (sbfi_glb_transform){0};
    sbfi_glb_compute_local(
        write_position_at(g, f, bone), up >= 0 ? &parent : NULL, translations + 3 * (size_t)f, q);
    /* Chooses the nearer sign, for players that interpolate without a check. */
    const float *last = q - 4;
    if (f && q[0] * last[0] + q[1] * last[1] + q[2] * last[2] + q[3] * last[3] < 0)
      for (int k = 0; k < 4; k++) q[k] = -q[k];
  }
  uint32_t values = sbfi_glb_accessor(g, translations, frames, SBFI_GLB_VEC3, SBFI_GLB_NO_TARGET);
  add_channel(c, bone, "translation", "LINEAR", times, values);
  values = sbfi_glb_accessor(g, rotations, frames, SBFI_GLB_VEC4, SBFI_GLB_NO_TARGET);
  add_channel(c, bone, "rotation", "LINEAR", times, values);
}

/* Meshes with equal numbers of shape keys share one list. */
static uint32_t write_weights(sbfi_glb *g, uint32_t keys) {
  uint32_t frames = g->e->motion->frame_count, count = keys + frames;
  float *weights = sbfi_glb_allocate(g, (size_t)frames * count, sizeof *weights);
  if (!weights) return 0;
  for (uint32_t f = 0; f < frames; f++) weights[(size_t)f * count + keys + f] = 1;
  return sbfi_glb_accessor(g, weights, frames * count, SBFI_GLB_FLOAT, SBFI_GLB_NO_TARGET);
}

void sbfi_glb_write_motion(sbfi_glb *g) {
  const sbf_asset *asset = g->e->asset;
  const sbf_export_motion *motion = g->e->motion;
  if (!motion) return;
  channels c;
  begin(g, &c);
  uint32_t frames = motion->frame_count;
  float *times = sbfi_glb_allocate(g, frames, sizeof *times);
  float *translations = sbfi_glb_allocate(g, 3 * (size_t)frames, sizeof *translations);
  float *rotations = sbfi_glb_allocate(g, 4 * (size_t)frames, sizeof *rotations);
  for (uint32_t f = 0; f < frames && !g->failed; f++) times[f] = (float)(f * motion->frame_s);
  if (!g->failed) {
    uint32_t input = sbfi_glb_accessor(g, times, frames, SBFI_GLB_FLOAT, SBFI_GLB_NO_TARGET);
    for (uint32_t b = 0; b < asset->bones.count; b++) write_bone(g, b, input, translations, rotations, &c);
    uint32_t shared = UINT32_MAX, shared_keys = 0;
    for (uint32_t i = 0; i < asset->render_meshes.count && !g->failed; i++) {
      uint32_t keys = asset->render_meshes.at[i].shape_keys.count;
      if (g->meshes[i].node == UINT32_MAX) continue;
      if (shared == UINT32_MAX || keys != shared_keys) shared = write_weights(g, keys);
      shared_keys = keys;
      add_channel(&c, g->meshes[i].node, "weights", "LINEAR", input, shared);
    }
  }
  end(g, &c, "motion");
}
