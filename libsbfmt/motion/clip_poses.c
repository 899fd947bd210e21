/* Evaluates poses of a clip at any time, in double precision. */
#include <math.h>

#include "motion/retargeting.h"

void sbfi_compute_rest_frames(const sbf_asset *asset, sbfi_bone_frame *frames) {
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_bone *b = &asset->bones.at[i];
    frames[i] = (sbfi_bone_frame){.position = {(double)b->head.x, (double)b->head.y, (double)b->head.z},
        .rotation = {
            (double)b->rotation.x, (double)b->rotation.y, (double)b->rotation.z, (double)b->rotation.w}};
  }
}

bool sbfi_clip_poses_init(
    sbfi_clip_poses *p, const sbf_asset *asset, const sbf_clip *clip, sbfi_arena *scratch) {
  size_t count = asset->bones.count + 1;
  *p = (sbfi_clip_poses){.asset = asset,
      .translations = sbfi_arena_allocate(scratch, count, sizeof *p->translations),
      .rotations = sbfi_arena_allocate(scratch, count, sizeof *p->rotations),
      .rest = sbfi_arena_allocate(scratch, count, sizeof *p->rest),
      .rest_local = sbfi_arena_allocate(scratch, count, sizeof *p->rest_local)};
  if (!p->translations || !p->rotations || !p->rest || !p->rest_local) return false;
  for (uint32_t i = 0; i < clip->tracks.count; i++) {
    const sbf_track *track = &clip->tracks.at[i];
    if (track->bone == SBF_NONE || track->times.count == 0) continue;
    if (track->property == SBF_TRACK_PROPERTY_TRANSLATION) p->translations[track->bone] = track;
    if (track->property == SBF_TRACK_PROPERTY_ROTATION) p->rotations[track->bone] = track;
  }
  sbfi_compute_rest_frames(asset, p->rest);
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    int32_t parent = asset->bones.at[i].parent;
    p->rest_local[i] = p->rest[i];
    if (parent == SBF_NONE) continue;
    double back[4], from[3];
    sbfi_quatd_conjugate(p->rest[parent].rotation, back);
    for (int k = 0; k < 3; k++) from[k] = p->rest[i].position[k] - p->rest[parent].position[k];
    sbfi_quatd_multiply(back, p->rest[i].rotation, p->rest_local[i].rotation);
    sbfi_quatd_rotate(back, from, p->rest_local[i].position);
  }
  return true;
}

/* Last key at or before a time; the first if all are later. */
static uint32_t key_before(const sbf_track *track, float time_s) {
  uint32_t low = 0, high = track->times.count;
  while (high - low > 1) {
    uint32_t middle = (low + high) / 2;
    if (track->times.at[middle] <= time_s)
      low = middle;
    else
      high = middle;
  }
  return low;
}

static void cubic(const sbf_track *track, uint32_t key, uint32_t width, double t, double span, double *to) {
  const float *a = track->values.at + (size_t)3 * width * key, *b = a + (size_t)3 * width;
  double t2 = t * t, t3 = t2 * t;
  for (uint32_t k = 0; k < width; k++)
    to[k] = (2 * t3 - 3 * t2 + 1) * (double)a[width + k] +
            (t3 - 2 * t2 + t) * span * (double)a[2 * width + k] + (3 * t2 - 2 * t3) * (double)b[width + k] +
            (t3 - t2) * span * (double)b[k];
}

/* Value of a track as defined in the specification (14.1): three numbers, or four of unit length. */
static void value_at(const sbf_track *track, float time_s, uint32_t width, double *to) {
  bool is_cubic = track->interpolation == SBF_INTERPOLATION_CUBIC;
  uint32_t key = key_before(track, time_s), stride = is_cubic ? 3 * width : width;
  const float *a = track->values.at + (size_t)stride * key + (is_cubic ? width : 0);
  double before[4], after[4], length = 0;
  bool between = key + 1 < track->times.count && time_s > track->times.at[key];
  for (uint32_t k = 0; k < width; k++) to[k] = before[k] = (double)a[k];
  if (between && track->interpolation != SBF_INTERPOLATION_STEP) {
    double span = (double)track->times.at[key + 1] - (double)track->times.at[key];
    double t = ((double)time_s - (double)track->times.at[key]) / span;
    for (uint32_t k = 0; k < width; k++) after[k] = (double)a[stride + k];
    if (is_cubic)
      cubic(track, key, width, t, span, to);
    else if (width == 4)
      sbfi_quatd_slerp(before, after, t, to);
    else
      for (uint32_t k = 0; k < width; k++) to[k] = before[k] + (after[k] - before[k]) * t;
  }
  if (width != 4) return;
  for (int k = 0; k < 4; k++) length += to[k] * to[k];
  for (int k = 0; k < 4; k++) to[k] = length > 0 ? to[k] / sqrt(length) : k == 3;
}

void sbfi_clip_pose(const sbfi_clip_poses *p, float time_s, sbfi_bone_frame *frames) {
  for (uint32_t i = 0; i < p->asset->bones.count; i++) {
    int32_t parent = p->asset->bones.at[i].parent;
    sbfi_bone_frame own = p->rest_local[i];
    if (p->translations[i]) value_at(p->translations[i], time_s, 3, own.position);
    if (p->rotations[i]) value_at(p->rotations[i], time_s, 4, own.rotation);
    frames[i] = own;
    if (parent == SBF_NONE) continue;
    sbfi_quatd_multiply(frames[parent].rotation, own.rotation, frames[i].rotation);
    sbfi_quatd_rotate(frames[parent].rotation, own.position, frames[i].position);
    for (int k = 0; k < 3; k++) frames[i].position[k] += frames[parent].position[k];
  }
}
