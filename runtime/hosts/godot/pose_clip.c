#include "pose_clip.h"

#include <string.h>

bool pose_clip_make(pose_clip *made, const sbf_asset *asset) {
  uint32_t bones = asset->bones.count, count = asset->clips.count;
  *made = (pose_clip){.asset = sbf_asset_clone(asset, NULL), .clip = (int32_t)count};
  if (!made->asset) return false;
  sbf_clip *clips = sbf_asset_allocate(made->asset, (size_t)count + 1, sizeof *clips);
  made->tracks = sbf_asset_allocate(made->asset, 2 * (size_t)bones + 1, sizeof *made->tracks);
  made->keys = sbf_asset_allocate(made->asset, (size_t)bones + 1, sizeof *made->keys);
  made->before = sbf_asset_allocate(made->asset, (size_t)bones + 1, sizeof *made->before);
  if (!clips || !made->tracks || !made->keys || !made->before) return pose_clip_free(made), false;
  if (count) memcpy(clips, made->asset->clips.at, count * sizeof *clips);
  for (uint32_t i = 0; i < bones; i++) {
    pose_key *key = &made->keys[i];
    key->rotation = (sbf_quat){0, 0, 0, 1};
    made->tracks[2 * i] = (sbf_track){.bone = (int32_t)i,
        .property = SBF_TRACK_PROPERTY_ROTATION,
        .times = {&key->time, 1},
        .values = {&key->rotation.x, 4}};
    made->tracks[2 * i + 1] = (sbf_track){.bone = (int32_t)i,
        .property = SBF_TRACK_PROPERTY_TRANSLATION,
        .times = {&key->time, 1},
        .values = {&key->translation.x, 3}};
  }
  clips[count] = (sbf_clip){.id = "sbfmt.pose", .name = "sbfmt.pose", .tracks = {made->tracks, 2 * bones}};
  made->asset->clips = (sbf_clip_list){clips, count + 1};
  return true;
}

void pose_clip_free(pose_clip *made) {
  sbf_asset_free(made->asset);
  *made = (pose_clip){0};
}

void pose_clip_enable(pose_clip *made, uint32_t bone, bool enabled) {
  made->keys[bone].enabled = enabled;
  made->tracks[2 * bone].times.count = made->tracks[2 * bone + 1].times.count = enabled;
}

bool pose_clip_changes(pose_clip *made) {
  size_t size = made->asset->bones.count * sizeof *made->keys;
  if (!memcmp(made->keys, made->before, size)) return false;
  memcpy(made->before, made->keys, size);
  return true;
}
