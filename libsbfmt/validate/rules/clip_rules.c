/* Checks clips and poses: ascending keys with the required number of values, no duplicate keys. */
#include "validate/validation.h"

typedef struct played {
  sbfi_validation *v;
  const sbf_clip *clip;
  const char *name;
} played;

static uint32_t components_of(const sbf_track *track) {
  return (track->property == SBF_TRACK_PROPERTY_ROTATION ? 4u : 3u) *
         (track->interpolation == SBF_INTERPOLATION_CUBIC ? 3u : 1u);
}

static void check_times(const played *p, const sbf_track *track, const char *path) {
  sbfi_path times = sbfi_path_of("%s/times", path);
  double end = (double)p->clip->duration * 1.0001 + 1e-4;
  uint32_t beyond = 0, first = 0;
  for (uint32_t i = 0; i < track->times.count; i++) {
    float time = track->times.at[i];
    if (i == 0 ? time < 0 : time <= track->times.at[i - 1])
      sbfi_found(p->v, SBF_CODE_CLIP_TIMES, times.text, i,
          "key %u of clip '%s' is at %.6g s, after one at %.6g s", i, p->name, (double)time,
          i ? (double)track->times.at[i - 1] : 0.0);
    if ((double)time > end && beyond++ == 0) first = i;
  }
  if (beyond)
    sbfi_found(p->v, SBF_CODE_CLIP_PAST_END, times.text, first,
        "%u key%s of clip '%s' lie%s after its end at %.6g s", beyond, sbfi_plural(beyond), p->name,
        beyond == 1 ? "s" : "", (double)p->clip->duration);
}

static void check_scales(const played *p, const sbf_track *track, const char *path) {
  bool cubic = track->interpolation == SBF_INTERPOLATION_CUBIC; /* each value has tangents around it */
  uint32_t stride = components_of(track), first = cubic ? 3 : 0;
  if (track->property != SBF_TRACK_PROPERTY_SCALE) return;
  for (uint32_t i = 0; i < track->values.count / stride; i++) {
    const float *at = track->values.at + i * stride + first;
    if (!(at[0] > 0 && at[1] > 0 && at[2] > 0))
      sbfi_found(p->v, SBF_CODE_CLIP_SCALE, sbfi_path_of("%s/values", path).text, i * stride + first,
          "key %u of clip '%s' has the scale %.4g, %.4g, %.4g", i, p->name, (double)at[0], (double)at[1],
          (double)at[2]);
  }
}

static void check_track(const played *p, const sbf_track *track, const char *path) {
  uint64_t wanted = (uint64_t)track->times.count * components_of(track);
  if (track->times.count == 0)
    sbfi_found(p->v, SBF_CODE_CLIP_EMPTY, path, -1, "a track of clip '%s' has no keys", p->name);
  if (track->values.count != wanted)
    sbfi_found(p->v, SBF_CODE_CLIP_VALUES, path, -1,
        "a track of clip '%s' with %u keys of %s has %u values instead of %llu", p->name, track->times.count,
        sbf_track_property_name(track->property), track->values.count, (unsigned long long)wanted);
  check_times(p, track, path);
  check_scales(p, track, path);
}

static void check_clips(sbfi_validation *v) {
  const size_t keyed_count = (size_t)v->asset->bones.count * SBF_TRACK_PROPERTY_COUNT;
  /* number from 1 of the clip that keyed it last */
  uint32_t *keyed = sbfi_scratch(v, keyed_count, sizeof *keyed);
  for (uint32_t c = 0; keyed && c < v->asset->clips.count; c++) {
    const sbf_clip *clip = &v->asset->clips.at[c];
    played p = {v, clip, sbfi_label(clip->name, clip->id)};
    if (clip->tracks.count == 0)
      sbfi_found(v, SBF_CODE_CLIP_EMPTY, sbfi_path_of("/sbf/clips/clip[%u]", c + 1).text, -1,
          "clip '%s' has no tracks", p.name);
    for (uint32_t t = 0; t < clip->tracks.count; t++) {
      const sbf_track *track = &clip->tracks.at[t];
      sbfi_path path = sbfi_path_of("/sbf/clips/clip[%u]/track[%u]", c + 1, t + 1);
      uint32_t *last = &keyed[(size_t)track->bone * SBF_TRACK_PROPERTY_COUNT + (size_t)track->property];
      if (*last == c + 1)
        sbfi_found(v, SBF_CODE_CLIP_TRACK_REPEATED, path.text, -1, "clip '%s' keys the %s of '%s' twice",
            p.name, sbf_track_property_name(track->property),
            sbfi_bone_label(v->asset, (uint32_t)track->bone));
      *last = c + 1;
      check_track(&p, track, path.text);
    }
  }
}

static void check_poses(sbfi_validation *v) {
  const sbf_pose_list poses = v->asset->poses;
  uint32_t *set = sbfi_scratch(
      v, v->asset->bones.count, sizeof *set); /* number from 1 of the pose that set the bone last */
  for (uint32_t i = 0; set && i < poses.count; i++) {
    const sbf_pose *pose = &poses.at[i];
    const char *name = sbfi_label(pose->name, pose->id);
    sbfi_path path = sbfi_path_of("/sbf/poses/pose[%u]", i + 1);
    if (pose->keys.count == 0)
      sbfi_found(v, SBF_CODE_POSE_EMPTY, path.text, -1, "pose '%s' sets no bone", name);
    if (pose->distance < 0)
      sbfi_found(v, SBF_CODE_POSE_DISTANCE, path.text, -1, "pose '%s' has the distance %.4g m", name,
          (double)pose->distance);
    for (uint32_t k = 0; k < i && pose->distance > 0; k++)
      if (poses.at[k].distance == pose->distance && poses.at[k].speed == pose->speed)
        sbfi_found(v, SBF_CODE_POSE_DISTANCE, path.text, -1,
            "poses '%s' and '%s' both have the distance %.4g m", sbfi_label(poses.at[k].name, poses.at[k].id),
            name, (double)pose->distance);
    for (uint32_t k = 0; k < pose->keys.count; k++) {
      if (set[pose->keys.at[k].bone] == i + 1)
        sbfi_found(v, SBF_CODE_POSE_REPEATED, sbfi_path_of("%s/pose_key[%u]", path.text, k + 1).text, -1,
            "pose '%s' sets '%s' twice", name, sbfi_bone_label(v->asset, (uint32_t)pose->keys.at[k].bone));
      set[pose->keys.at[k].bone] = i + 1;
    }
  }
}

void sbfi_check_clips(sbfi_validation *v) {
  check_clips(v);
  check_poses(v);
}
