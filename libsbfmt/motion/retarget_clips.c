/* Retargets clips of another skeleton to the bones of an asset.
 *
 * A matched bone rotates in asset space as its source has rotated from its own rest pose: with rest
 * rotations T0 and S0 and the source's rotation S, T = S S0^-1 A T0. A is the identity except for thighs,
 * shins, upper and lower arms: there it aligns the bone with its source's rest direction, so that a figure
 * with lowered arms takes the pose of one with extended arms; a hand uses its arm's A. Bones in between
 * follow their parents. The hips move as the source's do, scaled by the ratio of the hips' heights above
 * the lowest point of the skeletons; a clip begins at the asset's position. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "model/unique_id.h"
#include "motion/retargeting.h"

enum { PIVOTS = 4 };

typedef struct motion {
  sbf_asset *to;
  const sbf_asset *from;
  const char *file; /* origin of the clips */
  sbfi_arena scratch;
  sbfi_bone_match *matches;
  sbfi_bone_frame *rest;                   /* of the asset */
  double (*aligned)[4];                    /* (bones) S0^-1 A T0 of each matched bone: S times this is T */
  double (*align)[4];                      /* (bones) A */
  int32_t translated_bone;                 /* the bone that also translates */
  int32_t leader;                          /* the source's bone that it follows */
  double ratio;                            /* scale of translations */
  int32_t pivots[PIVOTS], leaders[PIVOTS]; /* bones whose centre is moved, in the target and in the source */
  uint32_t pivot_count;
  double pivot[3], arm[3]; /* rest position of that centre, in asset space and in that bone's frame */
  float *times;            /* of the current clip */
  uint32_t time_count;
  sbfi_reporter *reporter;
  sbf_diagnostic *error;
} motion;

static sbf_status no_memory(motion *m) {
  return sbfi_diagnose(m->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for the motion of %s", m->file);
}

static void report_finding(motion *m, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static void report_finding(motion *m, sbf_code code, const char *format, ...) {
  sbf_diagnostic diagnostic;
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(&diagnostic, code, format, arguments);
  va_end(arguments);
  sbfi_copy_text(diagnostic.file, sizeof diagnostic.file, m->file);
  sbfi_report(m->reporter, &diagnostic);
}

/* --- Setup common to all clips ------------------------------------------------------------------------ */

/* Minimum cosine between rest directions for two limbs to correspond. */
static const double MIN_ALIKE = -0.2;

static void align_bones(motion *m, const sbfi_bone_frame *from_rest) {
  static const double along[3] = {0, 1, 0}, none[4] = {0, 0, 0, 1};
  for (uint32_t i = 0; i < m->to->bones.count; i++) {
    const sbfi_bone_match *match = &m->matches[i];
    int32_t parent = m->to->bones.at[i].parent;
    memcpy(m->align[i], none, sizeof none);
    if (match->source == SBF_NONE) continue;
    const double *source = from_rest[match->source].rotation;
    double inverse[4];
    if (match->part == SBFI_PART_LIMB || match->part == SBFI_PART_THIGH) {
      double here[3], there[3];
      sbfi_quatd_rotate(m->rest[i].rotation, along, here);
      sbfi_quatd_rotate(source, along, there);
      double dot = here[0] * there[0] + here[1] * there[1] + here[2] * there[2];
      if (dot > MIN_ALIKE) sbfi_quatd_between(here, there, m->align[i]);
    } else if (match->part == SBFI_PART_HAND && parent != SBF_NONE &&
               m->matches[parent].part == SBFI_PART_LIMB) {
      memcpy(m->align[i], m->align[parent], sizeof none);
    }
    sbfi_quatd_conjugate(source, inverse);
    sbfi_quatd_multiply(m->align[i], m->rest[i].rotation, m->aligned[i]);
    sbfi_quatd_multiply(inverse, m->aligned[i], m->aligned[i]);
  }
}

static double lowest(const sbf_asset *asset, const sbfi_bone_frame *rest) {
  static const double along[3] = {0, 1, 0};
  double low = INFINITY;
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    double tail[3];
    sbfi_quatd_rotate(rest[i].rotation, along, tail);
    low = fmin(low, rest[i].position[1]);
    low = fmin(low, rest[i].position[1] + tail[1] * (double)asset->bones.at[i].length);
  }
  return low;
}

/* Centre of the heads of some bones. */
static void middle_of(const sbfi_bone_frame *frames, const int32_t *bones, uint32_t count, double *to) {
  for (int k = 0; k < 3; k++) {
    to[k] = 0;
    for (uint32_t i = 0; i < count; i++) to[k] += frames[bones[i]].position[k] / count;
  }
}

/* The hips translate, or else the root above matched bones. The tracked point is the centre between the
 * thighs if they exist, because the head of the translating bone may be anywhere. */
static void find_translated_bone(motion *m, const sbfi_bone_frame *from_rest) {
  double here = lowest(m->to, m->rest), there = lowest(m->from, from_rest), own[3], other[3];
  m->translated_bone = SBF_NONE;
  for (int32_t i = (int32_t)m->to->bones.count; i-- > 0;) {
    const sbfi_bone_match *match = &m->matches[i];
    if (match->source == SBF_NONE) continue;
    if (match->part == SBFI_PART_THIGH && m->pivot_count < PIVOTS) {
      m->pivots[m->pivot_count] = i;
      m->leaders[m->pivot_count++] = match->source;
    }
    if (m->translated_bone == SBF_NONE || m->matches[m->translated_bone].part != SBFI_PART_HIPS ||
        match->part == SBFI_PART_HIPS)
      m->translated_bone = i;
  }
  m->leader = m->matches[m->translated_bone].source;
  if (m->matches[m->translated_bone].part != SBFI_PART_HIPS) {
    while (m->to->bones.at[m->translated_bone].parent != SBF_NONE)
      m->translated_bone = m->to->bones.at[m->translated_bone].parent;
    while (m->from->bones.at[m->leader].parent != SBF_NONE) m->leader = m->from->bones.at[m->leader].parent;
  }
  if (m->pivot_count == 0) {
    m->pivots[0] = m->translated_bone;
    m->leaders[m->pivot_count++] = m->leader;
  }
  middle_of(m->rest, m->pivots, m->pivot_count, own);
  middle_of(from_rest, m->leaders, m->pivot_count, other);
  m->ratio = own[1] > here && other[1] > there ? (own[1] - here) / (other[1] - there) : 1;
  double inverse[4];
  for (int k = 0; k < 3; k++) {
    m->pivot[k] = own[k];
    m->arm[k] = own[k] - m->rest[m->translated_bone].position[k];
  }
  sbfi_quatd_conjugate(m->rest[m->translated_bone].rotation, inverse);
  sbfi_quatd_rotate(inverse, m->arm, m->arm);
}

static sbf_status prepare(motion *m) {
  size_t count = m->to->bones.count + 1;
  sbfi_bone_frame *from_rest = sbfi_arena_allocate(&m->scratch, m->from->bones.count + 1, sizeof *from_rest);
  m->matches = sbfi_arena_allocate(&m->scratch, count, sizeof *m->matches);
  m->rest = sbfi_arena_allocate(&m->scratch, count, sizeof *m->rest);
  m->aligned = sbfi_arena_allocate(&m->scratch, count, sizeof *m->aligned);
  m->align = sbfi_arena_allocate(&m->scratch, count, sizeof *m->align);
  if (!from_rest || !m->matches || !m->rest || !m->aligned || !m->align) return no_memory(m);
  int64_t matched = sbfi_match_bones(m->from, m->to, &m->scratch, m->matches);
  if (matched < 0) return no_memory(m);
  if (matched == 0)
    return sbfi_diagnose(m->error, SBF_CODE_IMPORT_MOTION_NONE,
        "none of its %u bones corresponds to one of the skeleton's %u bones: use equal bone names "
        "(LeftUpLeg, thigh.L ...), or add retarget chains to both bundles",
        m->from->bones.count, m->to->bones.count);
  sbfi_compute_rest_frames(m->to, m->rest);
  sbfi_compute_rest_frames(m->from, from_rest);
  align_bones(m, from_rest);
  find_translated_bone(m, from_rest);
  return SBF_OK;
}

/* --- Bones without a counterpart ---------------------------------------------------------------------- */

enum { NAMES_SHOWN = 8, NAMES_CAPACITY = 240 };

static void add_name(char *list, uint32_t *count, const char *name) {
  size_t length = strlen(list);
  if ((*count)++ < NAMES_SHOWN && length + strlen(name) + 4 < NAMES_CAPACITY)
    snprintf(list + length, NAMES_CAPACITY - length, "%s%s", length ? ", " : "", name);
}

static sbf_status report_unmatched(motion *m) {
  char here[NAMES_CAPACITY] = "", there[NAMES_CAPACITY] = "";
  uint32_t here_count = 0, there_count = 0;
  bool *taken = sbfi_arena_allocate(&m->scratch, m->from->bones.count + 1, sizeof *taken);
  if (!taken) return no_memory(m);
  for (uint32_t i = 0; i < m->to->bones.count; i++)
    if (m->matches[i].source == SBF_NONE)
      add_name(here, &here_count, m->to->bones.at[i].name);
    else
      taken[m->matches[i].source] = true;
  for (uint32_t i = 0; i < m->from->bones.count; i++)
    if (!taken[i]) add_name(there, &there_count, m->from->bones.at[i].name);
  if (here_count)
    report_finding(m, SBF_CODE_IMPORT_MOTION_UNMATCHED,
        "%u of the skeleton's %u bones have no counterpart and follow their parents: %s%s", here_count,
        m->to->bones.count, here, here_count > NAMES_SHOWN ? ", ..." : "");
  if (there_count)
    report_finding(m, SBF_CODE_IMPORT_MOTION_UNMATCHED, "%u of the file's %u bones have no counterpart: %s%s",
        there_count, m->from->bones.count, there, there_count > NAMES_SHOWN ? ", ..." : "");
  return SBF_OK;
}

/* --- One clip ----------------------------------------------------------------------------------------- */

static int compare_times(const void *a, const void *b) {
  float x = *(const float *)a, y = *(const float *)b;
  return x < y ? -1 : x > y;
}

/* Collects all distinct key times; there may be none. */
static bool gather_times(motion *m, const sbf_clip *clip, sbfi_arena *scratch) {
  size_t count = 1, kept = 1;
  for (uint32_t i = 0; i < clip->tracks.count; i++) count += clip->tracks.at[i].times.count;
  m->times = sbfi_arena_allocate(scratch, count, sizeof *m->times);
  if (!m->times) return false;
  count = 0;
  for (uint32_t i = 0; i < clip->tracks.count; i++) {
    const sbf_f32_list *times = &clip->tracks.at[i].times;
    if (times->count) memcpy(m->times + count, times->at, times->count * sizeof *times->at);
    count += times->count;
  }
  if (count == 0) m->times[count++] = 0;
  qsort(m->times, count, sizeof *m->times, compare_times);
  for (size_t i = 1; i < count; i++)
    if (m->times[i] > m->times[kept - 1]) m->times[kept++] = m->times[i];
  m->time_count = (uint32_t)kept;
  return kept <= INT32_MAX / 4;
}

typedef struct bone_keys {
  float *rotations, *positions; /* NULL if the bone has none */
} bone_keys;

/* Chooses the sign for the shorter arc from the previous key. */
static void put_rotation(float *to, const double *q, bool first) {
  double dot = 1;
  if (!first) {
    dot = 0;
    for (int k = 0; k < 4; k++) dot += q[k] * (double)to[k - 4];
  }
  for (int k = 0; k < 4; k++) to[k] = (float)(dot < 0 ? -q[k] : q[k]);
}

/* Poses the asset in one frame of the source. `start`: initial position of the source's hips. */
static void put_pose(motion *m, const sbfi_clip_poses *rest, const sbfi_bone_frame *source,
    const double *start, uint32_t key, sbfi_bone_frame *frames, const bone_keys *keys) {
  for (uint32_t i = 0; i < m->to->bones.count; i++) {
    int32_t parent = m->to->bones.at[i].parent;
    static const sbfi_bone_frame root = {.rotation = {0, 0, 0, 1}};
    const sbfi_bone_frame *above = parent == SBF_NONE ? &root : &frames[parent];
    double inverse[4], local[4];
    sbfi_bone_frame *f = &frames[i];
    sbfi_quatd_multiply(above->rotation, rest->rest_local[i].rotation, f->rotation);
    sbfi_quatd_rotate(above->rotation, rest->rest_local[i].position, f->position);
    for (int k = 0; k < 3; k++) f->position[k] += above->position[k];
    sbfi_quatd_conjugate(above->rotation, inverse);
    if (m->matches[i].source != SBF_NONE) {
      sbfi_quatd_multiply(source[m->matches[i].source].rotation, m->aligned[i], f->rotation);
      sbfi_quatd_multiply(inverse, f->rotation, local);
      put_rotation(keys[i].rotations + 4 * (size_t)key, local, key == 0);
    }
    if ((int32_t)i != m->translated_bone) continue;
    double direction[3], arm[3], within[3];
    middle_of(source, m->leaders, m->pivot_count, direction);
    sbfi_quatd_rotate(f->rotation, m->arm, arm);
    for (int k = 0; k < 3; k++) {
      f->position[k] = m->pivot[k] + m->ratio * (direction[k] - start[k]) - arm[k];
      within[k] = f->position[k] - above->position[k];
    }
    sbfi_quatd_rotate(inverse, within, within);
    for (int k = 0; k < 3; k++) keys[i].positions[3 * (size_t)key + (size_t)k] = (float)within[k];
  }
}

/* Position of the source's pivot at rest on the ground of its clip. A file may have its skeleton around
 * the hips and its motion on the ground. */
static void find_start(
    const motion *m, const sbfi_clip_poses *poses, const sbfi_bone_frame *first, double *start) {
  double rest[3];
  middle_of(poses->rest, m->leaders, m->pivot_count, rest);
  middle_of(first, m->leaders, m->pivot_count, start);
  double height = rest[1] - lowest(m->from, poses->rest);
  start[1] = fabs(start[1] - height) < fabs(start[1] - rest[1]) ? height : rest[1];
}

static bool add_track(sbf_asset *asset, uint32_t bone, sbf_track_property property, const motion *m,
    const float *values, const float *times, sbf_track *tracks, uint32_t *count) {
  uint32_t width = property == SBF_TRACK_PROPERTY_ROTATION ? 4 : 3;
  float *kept = sbf_asset_allocate(asset, m->time_count, width * sizeof *kept);
  if (!kept) return false;
  memcpy(kept, values, (size_t)m->time_count * width * sizeof *kept);
  sbf_track *track = &tracks[(*count)++];
  sbf_track_init(track);
  track->bone = (int32_t)bone;
  track->property = property;
  track->times = (sbf_f32_list){times, m->time_count};
  track->values = (sbf_f32_list){kept, m->time_count * width};
  return true;
}

static bool fill_clip(motion *m, const sbf_clip *from, sbf_clip *to, sbfi_arena *scratch) {
  sbfi_clip_poses poses, here;
  static const sbf_clip still = {.tracks = {NULL, 0}};
  uint32_t bone_count = m->to->bones.count, count = 0, matched = 0;
  double start[3];
  sbfi_bone_frame *source = sbfi_arena_allocate(scratch, m->from->bones.count + 1, sizeof *source);
  sbfi_bone_frame *frames = sbfi_arena_allocate(scratch, bone_count + 1, sizeof *frames);
  bone_keys *keys = sbfi_arena_allocate(scratch, bone_count + 1, sizeof *keys);
  if (!source || !frames || !keys || !gather_times(m, from, scratch) ||
      !sbfi_clip_poses_init(&poses, m->from, from, scratch) ||
      !sbfi_clip_poses_init(&here, m->to, &still, scratch))
    return false;
  for (uint32_t i = 0; i < bone_count; i++) {
    bool follows = m->matches[i].source != SBF_NONE, travels = (int32_t)i == m->translated_bone;
    matched += follows;
    if (follows) keys[i].rotations = sbfi_arena_allocate(scratch, m->time_count, 4 * sizeof(float));
    if (travels) keys[i].positions = sbfi_arena_allocate(scratch, m->time_count, 3 * sizeof(float));
    if ((follows && !keys[i].rotations) || (travels && !keys[i].positions)) return false;
  }
  for (uint32_t k = 0; k < m->time_count; k++) {
    sbfi_clip_pose(&poses, m->times[k], source);
    if (k == 0) find_start(m, &poses, source, start);
    put_pose(m, &here, source, start, k, frames, keys);
  }
  float *times = sbf_asset_allocate(m->to, m->time_count, sizeof *times);
  sbf_track *tracks = sbf_asset_allocate(m->to, matched + 1, sizeof *tracks);
  if (!times || !tracks) return false;
  memcpy(times, m->times, m->time_count * sizeof *times);
  for (uint32_t i = 0; i < bone_count; i++) {
    if (keys[i].positions &&
        !add_track(m->to, i, SBF_TRACK_PROPERTY_TRANSLATION, m, keys[i].positions, times, tracks, &count))
      return false;
    if (keys[i].rotations &&
        !add_track(m->to, i, SBF_TRACK_PROPERTY_ROTATION, m, keys[i].rotations, times, tracks, &count))
      return false;
  }
  to->duration = fmaxf(from->duration, m->times[m->time_count - 1]);
  to->loop = from->loop;
  to->tracks = (sbf_track_list){tracks, count};
  report_finding(m, SBF_CODE_IMPORT_MOTION,
      "clip '%s', %.2f s: %u bones were transferred, '%s' travels %.3g times as far as '%s'", to->name,
      (double)to->duration, matched, m->to->bones.at[m->translated_bone].name, m->ratio,
      m->from->bones.at[m->leader].name);
  return true;
}

/* The file's name without folders and extension, for a clip without a name. */
static const char *name_clip(motion *m, const sbf_clip *from) {
  if (from->name && from->name[0]) return sbf_asset_copy_text(m->to, from->name);
  const char *name = sbfi_path_name(m->file), *dot = strrchr(name, '.');
  char *copy = (char *)(uintptr_t)sbf_asset_copy_text(m->to, name);
  if (copy && dot && dot != name) copy[dot - name] = 0;
  return copy;
}

/* Ids contain no white space. */
static const char *clip_id(motion *m, sbfi_ids *ids, const char *name, uint32_t index) {
  char *word = sbfi_arena_string(&m->scratch, *name ? name : "motion", strlen(*name ? name : "motion"));
  for (char *c = word; c && *c; c++)
    if ((unsigned char)*c <= ' ') *c = '_';
  return word ? sbfi_unique_id(ids, "clip.", word, index, m->to) : NULL;
}

static bool make_clips(motion *m, sbfi_ids *ids, sbf_clip *clips) {
  uint32_t before = m->to->clips.count;
  if (!sbfi_ids_add_collections(ids, m->to)) return false;
  if (before) memcpy(clips, m->to->clips.at, before * sizeof *clips);
  for (uint32_t i = 0; i < m->from->clips.count; i++) {
    sbf_clip *to = &clips[before + i];
    sbfi_arena scratch;
    sbf_clip_init(to);
    sbfi_arena_init(&scratch, &m->scratch.allocator, 0);
    to->name = name_clip(m, &m->from->clips.at[i]);
    to->id = to->name ? clip_id(m, ids, to->name, before + i) : NULL;
    bool good = to->id && fill_clip(m, &m->from->clips.at[i], to, &scratch);
    sbfi_arena_free(&scratch);
    if (!good) return false;
  }
  return true;
}

static sbf_status add_clips(motion *m) {
  uint32_t count = m->to->clips.count + m->from->clips.count;
  sbf_clip *clips = sbf_asset_allocate(m->to, count, sizeof *clips);
  sbfi_ids ids;
  sbfi_ids_init(&ids, &m->scratch.allocator);
  bool good = clips && make_clips(m, &ids, clips);
  sbfi_ids_free(&ids);
  if (!good) return no_memory(m);
  m->to->clips = (sbf_clip_list){clips, count};
  return SBF_OK;
}

/* --- The call ----------------------------------------------------------------------------------------- */

sbf_status sbfi_retarget_clips(sbf_asset *asset, const sbf_asset *from, const char *file,
    const sbf_allocator *allocator, sbfi_reporter *reporter, sbf_diagnostic *error) {
  sbf_diagnostic unseen;
  motion m = {
      .to = asset, .from = from, .file = file, .reporter = reporter, .error = error ? error : &unseen};
  sbf_status status = SBF_OK;
  sbfi_arena_init(&m.scratch, allocator, 0);
  if (asset->bones.count == 0)
    status = sbfi_diagnose(
        m.error, SBF_CODE_IMPORT_MOTION_NONE, "there is no skeleton to move: add one with --rig");
  else if (from->clips.count == 0 || from->bones.count == 0)
    status = sbfi_diagnose(m.error, SBF_CODE_IMPORT_MOTION_NONE, "the file has no motion of bones");
  if (status == SBF_OK) status = prepare(&m);
  if (status == SBF_OK) status = report_unmatched(&m);
  if (status == SBF_OK) status = add_clips(&m);
  if (status != SBF_OK) sbfi_copy_text(m.error->file, sizeof m.error->file, file);
  sbfi_arena_free(&m.scratch);
  return status;
}
