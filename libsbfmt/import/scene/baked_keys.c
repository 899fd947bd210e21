#include "import/scene/baked_keys.h"

#include <math.h>
#include <string.h>

#include "import/scene/trs.h"
#include "motion/quatd.h"

typedef struct location {
  uint32_t next[SBFI_LONGEST_CHAIN][SBFI_RAW_TRACKS]; /* first key of each track after the current time */
} location;

/* Next time at which any track has a key; tracks are ascending. False at the end. */
static bool next_time(const sbfi_link *links, uint32_t count, location *p, float *time) {
  bool found = false;
  for (uint32_t i = 0; i < count; i++)
    for (int k = 0; k < SBFI_RAW_TRACKS; k++) {
      const sbfi_track *track = &links[i].keys.tracks[k];
      uint32_t next = p->next[i][k];
      if (next == track->count || (found && track->times[next] >= *time)) continue;
      *time = track->times[next];
      found = true;
    }
  for (uint32_t i = 0; i < count; i++)
    for (int k = 0; found && k < SBFI_RAW_TRACKS; k++) {
      const sbfi_track *track = &links[i].keys.tracks[k];
      if (p->next[i][k] < track->count && track->times[p->next[i][k]] == *time) p->next[i][k]++;
    }
  return found;
}

/* Value of the track at `time`; `next` is its first later key. Leaves `to` unchanged if the track has no
 * keys. */
static void sample(const sbfi_track *track, uint32_t next, float time, uint32_t width, double *to) {
  if (!track->count) return;
  uint32_t a = next ? next - 1 : 0, b = next < track->count ? next : track->count - 1;
  const float *from = track->values + (size_t)a * width, *until = track->values + (size_t)b * width;
  double span = (double)track->times[b] - track->times[a];
  double t = span > 0 ? ((double)time - track->times[a]) / span : 0;
  if (width == 4) {
    double qa[4] = {from[0], from[1], from[2], from[3]}, qb[4] = {until[0], until[1], until[2], until[3]};
    sbfi_quatd_slerp(qa, qb, t, to);
  } else {
    for (int k = 0; k < 3; k++) to[k] = from[k] + t * ((double)until[k] - from[k]);
  }
}

static sbfi_matrix transform_at(
    const sbfi_link *link, const sbfi_trs *rest, const uint32_t *next, float time) {
  const sbfi_track *tracks = link->keys.tracks;
  if (!tracks[0].count && !tracks[1].count && !tracks[2].count) return link->local;
  sbfi_trs trs = *rest;
  sample(&tracks[SBFI_RAW_POSITION], next[SBFI_RAW_POSITION], time, 3, trs.position);
  sample(&tracks[SBFI_RAW_ROTATION], next[SBFI_RAW_ROTATION], time, 4, trs.rotation);
  sample(&tracks[SBFI_RAW_SCALE], next[SBFI_RAW_SCALE], time, 3, trs.scale);
  return sbfi_trs_compose(&trs);
}

static sbfi_matrix link_at(const sbfi_link *link, const sbfi_trs *rest, const uint32_t *next, float time) {
  sbfi_matrix m = transform_at(link, rest, next, time);
  if (link->undone && !sbfi_matrix_invert(&m, &m)) return sbfi_matrix_identity();
  return m;
}

static bool is_constant(const float *values, uint32_t count, uint32_t width) {
  for (uint32_t i = 1; i < count; i++)
    if (memcmp(values, values + (size_t)i * width, width * sizeof *values) != 0) return false;
  return true;
}

static bool copy_track(sbfi_arena *arena, uint32_t count, const float *times, const float *values,
    uint32_t width, sbfi_track *to) {
  if (is_constant(values, count, width)) count = 1;
  to->count = count;
  to->times = sbfi_arena_copy(arena, times, count, sizeof *times);
  to->values = sbfi_arena_copy(arena, values, count, width * sizeof *values);
  return to->times && to->values;
}

bool sbfi_bake_keys(
    const sbfi_link *links, uint32_t count, sbfi_arena *arena, sbfi_arena *scratch, sbfi_keys *to) {
  *to = (sbfi_keys){0};
  location p = {{{0}}};
  uint32_t key_count = 0;
  float time;
  sbfi_trs rest[SBFI_LONGEST_CHAIN];
  for (uint32_t i = 0; i < count; i++) rest[i] = sbfi_trs_decompose(&links[i].local);
  while (next_time(links, count, &p, &time)) key_count++;
  if (!key_count) return true;

  float *times = sbfi_arena_allocate(scratch, key_count, sizeof *times);
  float *positions = sbfi_arena_allocate(scratch, key_count, 3 * sizeof *positions);
  float *rotations = sbfi_arena_allocate(scratch, key_count, 4 * sizeof *rotations);
  float *scales = sbfi_arena_allocate(scratch, key_count, 3 * sizeof *scales);
  if (!times || !positions || !rotations || !scales) return false;
  p = (location){{{0}}};
  for (uint32_t key = 0; next_time(links, count, &p, &time); key++) {
    sbfi_matrix product = link_at(&links[0], &rest[0], p.next[0], time);
    for (uint32_t i = 1; i < count; i++) {
      sbfi_matrix above = link_at(&links[i], &rest[i], p.next[i], time);
      product = sbfi_matrix_multiply(&above, &product);
    }
    sbfi_trs trs = sbfi_trs_decompose(&product);
    float *q = rotations + (size_t)key * 4;
    double dot = 0;
    for (int k = 0; k < 4; k++) dot += key ? trs.rotation[k] * q[k - 4] : 0;
    for (int k = 0; k < 4; k++) q[k] = (float)(dot < 0 ? -trs.rotation[k] : trs.rotation[k]);
    for (int k = 0; k < 3; k++) {
      positions[(size_t)key * 3 + k] = (float)trs.position[k];
      scales[(size_t)key * 3 + k] = (float)trs.scale[k];
    }
    times[key] = time;
  }
  return copy_track(arena, key_count, times, positions, 3, &to->tracks[SBFI_RAW_POSITION]) &&
         copy_track(arena, key_count, times, rotations, 4, &to->tracks[SBFI_RAW_ROTATION]) &&
         copy_track(arena, key_count, times, scales, 3, &to->tracks[SBFI_RAW_SCALE]);
}
