/* Assembles clips: finds nodes of channels by name, converts ticks to seconds, and bakes the motion of FBX
 * helper nodes into keys of the original node. */
#include <math.h>
#include <string.h>

#include "import/scene/assembly.h"
#include "import/scene/baked_keys.h"

/* Default rate of assimp's own tools for files without one. */
static const double default_ticks_per_second = 25;

typedef struct clipping {
  sbfi_assembly *a;
  const sbfi_raw_clip *clip;
  sbfi_name_table helper_names;
  uint32_t *helper_of_name;            /* (helper names) raw node */
  uint32_t *dependent_starts;          /* (raw nodes + 1) into dependents */
  uint32_t *dependents;                /* scene nodes that each helper was folded into */
  const sbfi_raw_channel **channel_of; /* (raw nodes) of the current clip */
  uint32_t *seen;                      /* (scene nodes) clip + 1 if the channel exists already */
  double ticks_per_second, shift_ticks;
  uint64_t dropped_keys;
  double longest_s;
} clipping;

/* --- Which nodes a channel moves ------------------------------------------------------------------- */

static bool name_helpers(clipping *c) {
  const sbfi_raw_scene *raw = c->a->raw;
  uint32_t helper_count = 0;
  for (uint32_t i = 0; i < raw->node_count; i++) helper_count += sbfi_is_folded(c->a, i);
  if (!helper_count) return true;
  c->helper_of_name = sbfi_arena_allocate(&c->a->scratch, helper_count, sizeof *c->helper_of_name);
  if (!c->helper_of_name) return false;
  for (uint32_t i = 0; i < raw->node_count; i++) {
    if (!sbfi_is_folded(c->a, i)) continue;
    int64_t name = sbfi_name_table_add(&c->helper_names, raw->nodes[i].name);
    if (name < 0) return false;
    c->helper_of_name[name] = i;
  }
  return true;
}

static int32_t helper_above(const sbfi_assembly *a, int32_t raw_node) {
  int32_t parent = a->raw->nodes[raw_node].parent;
  return parent != SBF_NONE && sbfi_is_folded(a, (uint32_t)parent) ? parent : SBF_NONE;
}

static bool list_dependents(clipping *c) {
  const sbfi_assembly *a = c->a;
  uint32_t count = a->raw->node_count, *starts, *cursors;
  c->dependent_starts = starts = sbfi_arena_allocate(&c->a->scratch, (size_t)count + 1, sizeof *starts);
  if (!starts) return false;
  for (uint32_t i = 0; i < a->scene->node_count; i++)
    for (int32_t h = (int32_t)a->old_from_new[i]; (h = helper_above(a, h)) != SBF_NONE;) starts[h + 1]++;
  for (uint32_t i = 0; i < count; i++) starts[i + 1] += starts[i];
  c->dependents = sbfi_arena_allocate(&c->a->scratch, starts[count] ? starts[count] : 1, sizeof(uint32_t));
  cursors = sbfi_arena_copy(&c->a->scratch, starts, count, sizeof *cursors);
  if (!c->dependents || !cursors) return false;
  for (uint32_t i = 0; i < a->scene->node_count; i++)
    for (int32_t h = (int32_t)a->old_from_new[i]; (h = helper_above(a, h)) != SBF_NONE;)
      c->dependents[cursors[h]++] = i;
  return true;
}

/* Raw node of a channel; SBF_NONE if no node has the name. */
static int32_t find_raw(clipping *c, sbfi_span name, bool *good) {
  int64_t helper = sbfi_name_table_find(&c->helper_names, name);
  if (helper >= 0) return (int32_t)c->helper_of_name[helper];
  int32_t node = sbfi_assembly_find(c->a, name, good);
  return node == SBF_NONE ? SBF_NONE : (int32_t)c->a->old_from_new[node];
}

/* --- Keys ------------------------------------------------------------------------------------------ */

/* Reads keys in seconds, strictly ascending from 0; drops and counts others. Allocates times and values
 * from `arena`. */
static bool read_track(
    clipping *c, sbfi_arena *arena, const sbfi_raw_keys *raw, uint32_t width, sbfi_track *to) {
  *to = (sbfi_track){0};
  if (!raw->count) return true;
  float *times = sbfi_arena_allocate(arena, raw->count, sizeof *times);
  float *values = sbfi_arena_allocate(arena, raw->count, width * sizeof *values);
  if (!times || !values) return false;
  uint32_t count = 0;
  for (uint32_t i = 0; i < raw->count; i++) {
    float *value = values + (size_t)count * width;
    float time = (float)((sbfi_raw_key(raw, width, i, value) + c->shift_ticks) / c->ticks_per_second);
    bool good = isfinite(time) && time >= 0; /* the clip begins at its first keys, whose times may be NaN */
    if (width == 4) {
      double length = sqrt((double)value[0] * value[0] + (double)value[1] * value[1] +
                           (double)value[2] * value[2] + (double)value[3] * value[3]);
      good = good && length > 1e-6;
      for (int k = 0; k < 4; k++) value[k] = good ? (float)(value[k] / length) : 0;
    }
    if (good && count && time == times[count - 1]) continue;
    if (!good || (count && time < times[count - 1])) {
      c->dropped_keys++;
      continue;
    }
    times[count++] = time;
  }
  if (count && times[count - 1] > c->longest_s) c->longest_s = times[count - 1];
  *to = (sbfi_track){count, count ? times : NULL, count ? values : NULL};
  return true;
}

static bool read_channel(clipping *c, sbfi_arena *arena, const sbfi_raw_channel *raw, sbfi_keys *to) {
  for (int track = 0; track < SBFI_RAW_TRACKS; track++)
    if (!read_track(c, arena, &raw->keys[track], track == SBFI_RAW_ROTATION ? 4 : 3, &to->tracks[track]))
      return false;
  return true;
}

/* Bakes keys of a node whose transform was split into helpers. */
static bool bake_channel(clipping *c, uint32_t node, sbfi_keys *to) {
  sbfi_assembly *a = c->a;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, a->allocator, 0);
  sbfi_link links[SBFI_LONGEST_CHAIN];
  uint32_t count = 0;
  bool good = true;
  for (int32_t raw = (int32_t)a->old_from_new[node]; good && raw != SBF_NONE && count < SBFI_LONGEST_CHAIN;
       raw = helper_above(a, raw)) {
    sbfi_link *link = &links[count++];
    *link = (sbfi_link){.local = a->raw->nodes[raw].local};
    if (c->channel_of[raw]) good = read_channel(c, &scratch, c->channel_of[raw], &link->keys);
  }
  good = good && sbfi_bake_keys(links, count, &a->scene->arena, &scratch, to);
  sbfi_arena_free(&scratch);
  return good;
}

static bool make_channel(clipping *c, uint32_t node, sbfi_scene_channel *to) {
  sbfi_assembly *a = c->a;
  int32_t raw = (int32_t)a->old_from_new[node];
  sbfi_keys keys;
  bool good = helper_above(a, raw) == SBF_NONE ? read_channel(c, &a->scene->arena, c->channel_of[raw], &keys)
                                               : bake_channel(c, node, &keys);
  if (!good) return false;
  const sbfi_track *t = keys.tracks;
  *to = (sbfi_scene_channel){.node = (int32_t)node,
      .position_count = t[SBFI_RAW_POSITION].count,
      .position_times = t[SBFI_RAW_POSITION].times,
      .positions = (const sbf_vec3 *)t[SBFI_RAW_POSITION].values,
      .rotation_count = t[SBFI_RAW_ROTATION].count,
      .rotation_times = t[SBFI_RAW_ROTATION].times,
      .rotations = (const sbf_quat *)t[SBFI_RAW_ROTATION].values,
      .scale_count = t[SBFI_RAW_SCALE].count,
      .scale_times = t[SBFI_RAW_SCALE].times,
      .scales = (const sbf_vec3 *)t[SBFI_RAW_SCALE].values};
  for (int k = 0; k < SBFI_RAW_TRACKS; k++)
    for (uint32_t i = 0; i < t[k].count * (k == SBFI_RAW_ROTATION ? 4 : 3); i++)
      if (!isfinite(t[k].values[i]))
        return sbfi_assembly_refuse(a, SBF_CODE_IMPORT_NOT_FINITE,
            "the keys of node \"%s\" exceed single precision: export the file again", a->nodes[node].name);
  return true;
}

/* --- Clips ----------------------------------------------------------------------------------------- */

static void begin_clip(clipping *c) {
  const sbfi_raw_clip *clip = c->clip;
  float value[4];
  c->ticks_per_second = clip->ticks_per_second > 0 ? clip->ticks_per_second : default_ticks_per_second;
  c->longest_s = 0;
  double first = 0;
  for (uint32_t i = 0; i < clip->channel_count; i++)
    for (int track = 0; track < SBFI_RAW_TRACKS; track++) {
      const sbfi_raw_keys *keys = &clip->channels[i].keys[track];
      if (!keys->count) continue;
      double time = sbfi_raw_key(keys, track == SBFI_RAW_ROTATION ? 4 : 3, 0, value);
      if (time < first) first = time;
    }
  c->shift_ticks = -first;
}

static bool make_clip(clipping *c, uint32_t number, sbfi_scene_clip *to) {
  sbfi_assembly *a = c->a;
  uint32_t unknown = 0, limit = 0;
  bool good = true;
  begin_clip(c);
  int32_t *raw_of = sbfi_arena_allocate(&a->scratch, c->clip->channel_count + 1, sizeof *raw_of);
  if (!raw_of) return false;
  for (uint32_t i = 0; good && i < c->clip->channel_count; i++) {
    int32_t raw = raw_of[i] = find_raw(c, c->clip->channels[i].node_name, &good);
    if (raw == SBF_NONE || c->channel_of[raw]) {
      raw_of[i] = SBF_NONE;
      unknown++;
      continue;
    }
    c->channel_of[raw] = &c->clip->channels[i];
    limit += sbfi_is_folded(a, (uint32_t)raw) ? c->dependent_starts[raw + 1] - c->dependent_starts[raw] : 1;
  }
  sbfi_scene_channel *channels = sbfi_arena_allocate(&a->scene->arena, limit ? limit : 1, sizeof *channels);
  uint32_t count = 0;
  good = good && channels;
  for (uint32_t i = 0; good && i < c->clip->channel_count; i++) {
    int32_t raw = raw_of[i];
    if (raw == SBF_NONE) continue;
    bool helper = sbfi_is_folded(a, (uint32_t)raw);
    uint32_t own = helper ? 0 : (uint32_t)a->new_from_old[raw];
    const uint32_t *nodes = helper ? c->dependents + c->dependent_starts[raw] : &own;
    uint32_t node_count = helper ? c->dependent_starts[raw + 1] - c->dependent_starts[raw] : 1;
    for (uint32_t k = 0; good && k < node_count; k++) {
      if (c->seen[nodes[k]] == number + 1) continue;
      c->seen[nodes[k]] = number + 1;
      good = make_channel(c, nodes[k], &channels[count]);
      count++;
    }
  }
  for (uint32_t i = 0; i < c->clip->channel_count; i++)
    if (raw_of[i] != SBF_NONE) c->channel_of[raw_of[i]] = NULL;
  if (!good) return false;
  double stated_s = c->clip->duration_ticks / c->ticks_per_second;
  double duration_s = stated_s > c->longest_s ? stated_s : c->longest_s;
  *to = (sbfi_scene_clip){.name = sbfi_scene_string(a->scene, c->clip->name),
      .duration_s = duration_s < 1e9 ? (float)duration_s : (float)c->longest_s,
      .channel_count = count,
      .channels = count ? channels : NULL};
  if (!to->name) return false;
  return !unknown || sbfi_scene_warn(a->scene, SBF_CODE_IMPORT_KEYS, 0,
                         "%u channels of clip \"%s\" are left out, because no node has their name, or a node "
                         "has two of them",
                         unknown, to->name);
}

static bool make_clips(clipping *c) {
  sbfi_assembly *a = c->a;
  uint32_t count = a->raw->clip_count;
  size_t raw_count = a->raw->node_count, node_count = a->scene->node_count;
  sbfi_scene_clip *clips = sbfi_arena_allocate(&a->scene->arena, count, sizeof *clips);
  c->channel_of = sbfi_arena_allocate(&a->scratch, raw_count + 1, sizeof *c->channel_of);
  c->seen = sbfi_arena_allocate(&a->scratch, node_count + 1, sizeof *c->seen);
  if (!clips || !c->channel_of || !c->seen || !name_helpers(c) || !list_dependents(c)) return false;
  for (uint32_t i = 0; i < count; i++) {
    c->clip = &a->raw->clips[i];
    if (!make_clip(c, i, &clips[i])) return false;
  }
  a->scene->clips = clips;
  a->scene->clip_count = count;
  return !c->dropped_keys ||
         sbfi_scene_warn(a->scene, SBF_CODE_IMPORT_KEYS, 0,
             "%llu keys are left out, because their times do not increase, or their rotation is invalid",
             (unsigned long long)c->dropped_keys);
}

bool sbfi_assemble_clips(sbfi_assembly *a) {
  if (!a->raw->clip_count) return true;
  clipping c = {.a = a};
  sbfi_name_table_init(&c.helper_names, a->allocator);
  bool good = make_clips(&c);
  sbfi_name_table_free(&c.helper_names);
  return good;
}
