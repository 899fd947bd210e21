/* Converts animations of the rig's nodes to tracks of bones.
 *
 * A track holds a bone's frame relative to its parent bone's frame. Between the two there may be helper
 * nodes, a unit, a change of axes, mirrors, and the rotation that aligned the frame with its bone. Let H =
 * W D be the frame of a bone, where W is its node's transform to asset space and D is constant. Then the
 * track is D_parent^-1 (W_parent^-1 W) D. The middle product needs only the nodes between the two bones. */
#include <math.h>
#include <string.h>

#include "import/convert/conversion.h"
#include "import/scene/baked_keys.h"
#include "import/scene/trs.h"

/* Tolerances for equality with the rest pose or the first key, to absorb rounding: fraction of the
 * skeleton's size, quaternion component, scale factor. */
static const double SAME_POSITION = 1e-6, SAME_ROTATION = 5e-6, SAME_SCALE = 1e-4;
/* A clip loops if its last keys are this close to its first: rad, fraction of the size, multiple of the
 * largest step between keys. */
static const double LOOP_ROTATION = 0.2, LOOP_DISTANCE = 0.05, LOOP_STEPS = 1.5;

typedef struct clip_work {
  sbfi_conversion *c;
  const sbfi_scene *rig;
  const sbfi_scene_clip *clip;
  const sbfi_scene_channel **channel_of; /* (nodes) of the current clip */
  bool *used;                            /* (nodes) whether the channel moves a bone */
  uint32_t *path, *seen;                 /* (nodes) scratch */
  double size;                           /* m, of the skeleton */
  uint32_t lost_bones;                   /* bones whose keys cannot be converted */
} clip_work;

/* --- Which transforms lie between a bone and its parent ---------------------------------------------- */

typedef struct link_list {
  sbfi_link at[SBFI_LONGEST_CHAIN];
  uint32_t count, keyed;
  sbfi_matrix still; /* product of constant transforms since the last link */
  bool too_long;
} link_list;

static void push_link(link_list *links, const sbfi_link *link) {
  if (links->count == SBFI_LONGEST_CHAIN)
    links->too_long = true;
  else
    links->at[links->count++] = *link;
}

static void push_constant(link_list *links) {
  push_link(links, &(sbfi_link){.local = links->still});
  links->still = sbfi_matrix_identity();
}

static void add_constant(link_list *links, const sbfi_matrix *m) {
  links->still = sbfi_matrix_multiply(m, &links->still);
}

static bool moves(const sbfi_scene_channel *channel) {
  return channel && (channel->position_count || channel->rotation_count || channel->scale_count);
}

static bool add_node(clip_work *w, link_list *links, uint32_t node, bool undone) {
  const sbfi_scene_channel *channel = w->channel_of[node];
  sbfi_matrix local = w->rig->nodes[node].local;
  if (!moves(channel)) {
    if (undone && !sbfi_matrix_invert(&local, &local)) return false;
    add_constant(links, &local);
    return true;
  }
  push_constant(links);
  sbfi_link link = {.local = local, .undone = undone};
  link.keys.tracks[SBFI_RAW_POSITION] =
      (sbfi_track){channel->position_count, channel->position_times, (const float *)channel->positions};
  link.keys.tracks[SBFI_RAW_ROTATION] =
      (sbfi_track){channel->rotation_count, channel->rotation_times, (const float *)channel->rotations};
  link.keys.tracks[SBFI_RAW_SCALE] =
      (sbfi_track){channel->scale_count, channel->scale_times, (const float *)channel->scales};
  push_link(links, &link);
  links->keyed++;
  w->used[node] = true;
  return true;
}

static sbfi_matrix rotation_of(sbf_quat q) {
  sbfi_trs trs = {.rotation = {(double)q.x, (double)q.y, (double)q.z, (double)q.w}, .scale = {1, 1, 1}};
  return sbfi_trs_compose(&trs);
}

/* D, from the bone's frame to its node's space. False if the node's transform is singular. */
static bool frame_in_node(const clip_work *w, uint32_t bone, sbfi_matrix *to) {
  sbfi_matrix world =
      sbfi_matrix_multiply(&w->c->rig_to_asset, &w->rig->nodes[w->c->node_of_bone[bone]].world);
  for (int k = 0; k < 3; k++) world.at[k][3] = 0;
  if (!sbfi_matrix_invert(&world, &world)) return false;
  sbfi_matrix frame = rotation_of(w->c->asset->bones.at[bone].rotation);
  *to = sbfi_matrix_multiply(&world, &frame);
  return true;
}

/* Lowest common ancestor of two nodes. It is usually `other`. */
static int32_t common_node(clip_work *w, uint32_t node, uint32_t other, uint32_t mark) {
  const sbfi_scene_node *nodes = w->rig->nodes;
  for (int32_t n = (int32_t)node; n != SBF_NONE; n = nodes[n].parent)
    if (n == (int32_t)other) return n;
  for (int32_t n = (int32_t)other; n != SBF_NONE; n = nodes[n].parent) w->seen[n] = mark;
  for (int32_t n = (int32_t)node; n != SBF_NONE; n = nodes[n].parent)
    if (w->seen[n] == mark) return n;
  return SBF_NONE;
}

/* Collects the transforms whose product is the bone's frame in its parent's frame, innermost first. */
static bool gather_links(clip_work *w, uint32_t bone, link_list *links) {
  const sbfi_conversion *c = w->c;
  int32_t parent = c->asset->bones.at[bone].parent, top = SBF_NONE;
  uint32_t node = c->node_of_bone[bone], depth = 0;
  links->count = links->keyed = 0;
  links->too_long = false;
  if (!frame_in_node(w, bone, &links->still)) return false;
  if (parent != SBF_NONE) top = common_node(w, node, c->node_of_bone[parent], bone + 1);
  for (int32_t n = (int32_t)node; n != top; n = w->rig->nodes[n].parent)
    if (!add_node(w, links, (uint32_t)n, false)) return false;
  if (parent == SBF_NONE) {
    add_constant(links, &c->rig_to_asset);
  } else {
    sbfi_matrix frame;
    for (int32_t n = (int32_t)c->node_of_bone[parent]; n != top; n = w->rig->nodes[n].parent)
      w->path[depth++] = (uint32_t)n;
    while (depth)
      if (!add_node(w, links, w->path[--depth], true)) return false;
    if (!frame_in_node(w, (uint32_t)parent, &frame) || !sbfi_matrix_invert(&frame, &frame)) return false;
    add_constant(links, &frame);
  }
  push_constant(links);
  return !links->too_long;
}

/* --- Tracks ------------------------------------------------------------------------------------------ */

static bool is_finite(const sbfi_track *track, uint32_t width) {
  for (size_t i = 0; i < (size_t)track->count * width; i++)
    if (!isfinite(track->values[i])) return false;
  return true;
}

/* Whether all keys equal `rest`, or the first key if that is NULL. Quaternions of opposite sign are equal. */
static bool all_are(const sbfi_track *track, uint32_t width, const double *rest, double tolerance) {
  for (uint32_t i = 0; i < track->count; i++) {
    const float *value = track->values + (size_t)i * width;
    double dot = 0;
    for (uint32_t k = 0; k < width; k++) dot += (double)value[k] * rest[k];
    double sign = width == 4 && dot < 0 ? -1 : 1;
    for (uint32_t k = 0; k < width; k++)
      if (!(fabs(sign * (double)value[k] - rest[k]) <= tolerance)) return false;
  }
  return true;
}

/* Adds a track unless it equals the rest pose. False if memory runs out. */
static bool add_track(clip_work *w, uint32_t bone, sbf_track_property property, const sbfi_track *from,
    const double *rest, double tolerance, sbf_track *to, uint32_t *count) {
  uint32_t width = property == SBF_TRACK_PROPERTY_ROTATION ? 4 : 3, keys = from->count;
  if (keys == 0 || all_are(from, width, rest, tolerance)) return true;
  const double first[4] = {(double)from->values[0], (double)from->values[1], (double)from->values[2],
      width == 4 ? (double)from->values[3] : 0};
  if (all_are(from, width, first, tolerance)) keys = 1;
  float *times = sbfi_convert_allocate(w->c, keys, sizeof *times);
  float *values = sbfi_convert_allocate(w->c, keys, width * sizeof *values);
  if (!times || !values) return false;
  memcpy(times, from->times, keys * sizeof *times);
  memcpy(values, from->values, (size_t)keys * width * sizeof *values);
  sbf_track *track = &to[(*count)++];
  sbf_track_init(track);
  track->bone = (int32_t)bone;
  track->property = property;
  track->times = (sbf_f32_list){times, keys};
  track->values = (sbf_f32_list){values, keys * width};
  return true;
}

static void rest_of(const sbf_bone *bones, uint32_t bone, sbfi_trs *rest) {
  sbfi_matrix own = rotation_of(bones[bone].rotation), parent;
  own.at[0][3] = (double)bones[bone].head.x;
  own.at[1][3] = (double)bones[bone].head.y;
  own.at[2][3] = (double)bones[bone].head.z;
  if (bones[bone].parent != SBF_NONE) {
    const sbf_bone *above = &bones[bones[bone].parent];
    parent = rotation_of(above->rotation);
    parent.at[0][3] = (double)above->head.x;
    parent.at[1][3] = (double)above->head.y;
    parent.at[2][3] = (double)above->head.z;
    if (sbfi_matrix_invert(&parent, &parent)) own = sbfi_matrix_multiply(&parent, &own);
  }
  *rest = sbfi_trs_decompose(&own);
}

/* Raises the clip as far as the character was raised onto the ground. Skips clips that already stand at
 * that height, such as motions recorded on the ground for a skin drawn around the hips. */
static void lift_root(const sbfi_track *track, double lift, const double *rest) {
  float *values = (float *)(uintptr_t)track->values; /* no other bone uses them */
  if (track->count == 0) return;
  double y = (double)values[1];
  if (fabs(y + lift - rest[1]) > fabs(y - rest[1])) return;
  for (uint32_t i = 0; i < track->count; i++) values[3 * i + 1] = (float)((double)values[3 * i + 1] + lift);
}

static bool convert_bone(clip_work *w, uint32_t bone, sbf_track *tracks, uint32_t *count) {
  link_list links;
  sbfi_keys keys;
  sbfi_trs rest;
  sbfi_arena scratch;
  if (!gather_links(w, bone, &links)) {
    w->lost_bones += moves(w->channel_of[w->c->node_of_bone[bone]]);
    w->used[w->c->node_of_bone[bone]] = true;
    return true;
  }
  if (links.keyed == 0) return true;
  sbfi_arena_init(&scratch, &w->c->scratch.allocator, 0);
  bool good = sbfi_bake_keys(links.at, links.count, &scratch, &scratch, &keys);
  const sbfi_track *t = keys.tracks;
  if (good && is_finite(&t[SBFI_RAW_POSITION], 3) && is_finite(&t[SBFI_RAW_SCALE], 3)) {
    static const double no_scale[3] = {1, 1, 1};
    rest_of(w->c->asset->bones.at, bone, &rest);
    if (w->c->asset->bones.at[bone].parent == SBF_NONE)
      lift_root(&t[SBFI_RAW_POSITION], w->c->lift_m, rest.position);
    good =
        add_track(w, bone, SBF_TRACK_PROPERTY_TRANSLATION, &t[SBFI_RAW_POSITION], rest.position,
            SAME_POSITION * w->size, tracks, count) &&
        add_track(w, bone, SBF_TRACK_PROPERTY_ROTATION, &t[SBFI_RAW_ROTATION], rest.rotation, SAME_ROTATION,
            tracks, count) &&
        add_track(w, bone, SBF_TRACK_PROPERTY_SCALE, &t[SBFI_RAW_SCALE], no_scale, SAME_SCALE, tracks, count);
  } else if (good) {
    w->lost_bones++;
  }
  sbfi_arena_free(&scratch);
  return good;
}

/* --- Clips ------------------------------------------------------------------------------------------- */

static void warn_of_losses(clip_work *w) {
  uint32_t idle = 0;
  for (uint32_t i = 0; i < w->clip->channel_count; i++) {
    const sbfi_scene_channel *channel = &w->clip->channels[i];
    idle += moves(channel) && !w->used[channel->node];
  }
  if (idle)
    sbfi_convert_warn(w->c, SBF_CODE_IMPORT_KEYS,
        "clip '%s': %u of %u channels are left out, because their nodes do not move a bone", w->clip->name,
        (unsigned)idle, (unsigned)w->clip->channel_count);
  if (w->lost_bones)
    sbfi_convert_warn(w->c, SBF_CODE_IMPORT_KEYS,
        "clip '%s': keys of %u bones are left out, because their transforms are flat, too large or too "
        "deeply nested",
        w->clip->name, (unsigned)w->lost_bones);
}

/* Distance between two keys: an angle or a length. */
static double step_between(const sbf_track *track, uint32_t a, uint32_t b) {
  uint32_t width = track->property == SBF_TRACK_PROPERTY_ROTATION ? 4 : 3;
  const float *from = track->values.at + (size_t)width * a, *to = track->values.at + (size_t)width * b;
  double squared = 0, dot = 0;
  for (uint32_t k = 0; k < width; k++) {
    squared += pow((double)to[k] - (double)from[k], 2);
    dot += (double)to[k] * (double)from[k];
  }
  return track->property == SBF_TRACK_PROPERTY_ROTATION ? 2 * acos(fmin(fabs(dot), 1)) : sqrt(squared);
}

/* A clip loops if the step from its last keys to its first is no longer than a step between keys. A larger
 * jump would throw soft bodies around. */
static bool is_loop(const clip_work *w, const sbf_track_list *tracks) {
  for (uint32_t i = 0; i < tracks->count; i++) {
    const sbf_track *track = &tracks->at[i];
    uint32_t last = track->times.count ? track->times.count - 1 : 0;
    if (last == 0 || track->property == SBF_TRACK_PROPERTY_SCALE) continue;
    double max = track->property == SBF_TRACK_PROPERTY_ROTATION ? LOOP_ROTATION : LOOP_DISTANCE * w->size;
    for (uint32_t k = 0; k < last; k++) max = fmax(max, LOOP_STEPS * step_between(track, k, k + 1));
    if (step_between(track, last, 0) > max) return false;
  }
  return true;
}

static sbf_status convert_clip(clip_work *w, sbf_clip *to) {
  uint32_t bone_count = w->c->asset->bones.count, count = 0;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &w->c->scratch.allocator, 0);
  sbf_track *tracks = sbfi_arena_allocate(&scratch, bone_count, 3 * sizeof *tracks);
  memset(w->channel_of, 0, w->rig->node_count * sizeof *w->channel_of);
  memset(w->used, 0, w->rig->node_count * sizeof *w->used);
  w->lost_bones = 0;
  for (uint32_t i = 0; i < w->clip->channel_count; i++)
    w->channel_of[w->clip->channels[i].node] = &w->clip->channels[i];
  bool good = tracks != NULL;
  for (uint32_t b = 0; good && b < bone_count; b++) good = convert_bone(w, b, tracks, &count);
  sbf_clip_init(to);
  to->id = sbfi_new_id(w->c, "clip", w->clip->name);
  to->name = sbf_asset_copy_text(w->c->asset, w->clip->name);
  to->duration = w->clip->duration_s;
  sbf_track *kept = good && count ? sbfi_convert_allocate(w->c, count, sizeof *kept) : NULL;
  if (kept) memcpy(kept, tracks, count * sizeof *kept);
  to->tracks = (sbf_track_list){kept, kept ? count : 0};
  to->loop = is_loop(w, &to->tracks);
  sbfi_arena_free(&scratch);
  if (!good || (count && !kept) || !to->id || !to->name) return sbfi_convert_no_memory(w->c);
  warn_of_losses(w);
  return SBF_OK;
}

static double size_of(const sbf_bone_list bones) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, squared = 0;
  for (uint32_t i = 0; i < bones.count; i++) {
    const double head[3] = {
        (double)bones.at[i].head.x, (double)bones.at[i].head.y, (double)bones.at[i].head.z};
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], head[k]);
      high[k] = fmax(high[k], head[k]);
    }
  }
  for (int k = 0; k < 3; k++) squared += (high[k] - low[k]) * (high[k] - low[k]);
  return sqrt(squared);
}

sbf_status sbfi_convert_clips(sbfi_conversion *c) {
  const sbfi_scene *rig = c->rig ? c->rig : c->scene;
  if (rig->clip_count == 0) return SBF_OK;
  if (c->asset->bones.count == 0) {
    sbfi_convert_warn(c, SBF_CODE_IMPORT_IGNORED,
        "%u animations of the file do not move bones and are left out", (unsigned)rig->clip_count);
    return SBF_OK;
  }
  clip_work w = {.c = c, .rig = rig, .size = size_of(c->asset->bones)};
  sbf_clip *clips = sbfi_convert_allocate(c, rig->clip_count, sizeof *clips);
  w.channel_of = sbfi_arena_allocate(&c->scratch, rig->node_count, sizeof *w.channel_of);
  w.used = sbfi_arena_allocate(&c->scratch, rig->node_count, sizeof *w.used);
  w.path = sbfi_arena_allocate(&c->scratch, rig->node_count, sizeof *w.path);
  w.seen = sbfi_arena_allocate(&c->scratch, rig->node_count, sizeof *w.seen);
  if (!clips || !w.channel_of || !w.used || !w.path || !w.seen) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < rig->clip_count; i++) {
    w.clip = &rig->clips[i];
    sbf_status status = convert_clip(&w, &clips[i]);
    if (status != SBF_OK) return status;
  }
  c->asset->clips = (sbf_clip_list){clips, rig->clip_count};
  return SBF_OK;
}
