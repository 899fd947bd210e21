#include "build/springs/springs_matched.h"

#include <string.h>

#include "mechanics/vector.h"

enum { MAX_MATCHED = 64, STEPS = 200 };
static const double short_fraction = 0.5, min_fraction = 0.05;

typedef struct work {
  const sbf_vec3 *positions;
  const sbf_uint2 *ends;
  uint32_t point_count, spring_count;
  uint32_t *begins;  /* (point_count + 1) first spring of each point */
  uint32_t *springs; /* (2 * spring_count) in the order of the list */
  double *lengths;   /* (spring_count) */
  double *sums;      /* (point_count) sum of the lengths of its springs */
} work;

static bool index_springs(work *w, sbfi_arena *arena) {
  w->begins = sbfi_arena_allocate(arena, (size_t)w->point_count + 2, sizeof *w->begins);
  w->springs = sbfi_arena_allocate(arena, 2 * (size_t)w->spring_count + 1, sizeof *w->springs);
  w->lengths = sbfi_arena_allocate(arena, (size_t)w->spring_count + 1, sizeof *w->lengths);
  w->sums = sbfi_arena_allocate(arena, (size_t)w->point_count + 1, sizeof *w->sums);
  if (!w->begins || !w->springs || !w->lengths || !w->sums) return false;
  for (uint32_t s = 0; s < w->spring_count; s++) {
    const uint32_t *ends = w->ends[s].at;
    w->lengths[s] =
        sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(w->positions[ends[1]]), sbfi_d3_of(w->positions[ends[0]])));
    for (int end = 0; end < 2; end++) {
      w->begins[ends[end] + 2]++;
      w->sums[ends[end]] += w->lengths[s];
    }
  }
  for (uint32_t i = 0; i < w->point_count; i++) w->begins[i + 2] += w->begins[i + 1];
  for (uint32_t s = 0; s < w->spring_count; s++)
    for (int end = 0; end < 2; end++) w->springs[w->begins[w->ends[s].at[end] + 1]++] = s;
  return true;
}

/* Distributes 6 E V over the springs of one point, with 15 mu = 6 E: parts by length, then fitted. */
static void match(const work *w, uint32_t point, double energy, double *parts) {
  const uint32_t *springs = w->springs + w->begins[point];
  uint32_t count = w->begins[point + 1] - w->begins[point];
  double fractions[MAX_MATCHED], fitted[MAX_MATCHED], intersect[MAX_MATCHED][MAX_MATCHED];
  sbfi_d3 directions[MAX_MATCHED];
  if (!(w->sums[point] > 0)) return;
  if (count > MAX_MATCHED) {
    for (uint32_t i = 0; i < count; i++)
      parts[springs[i]] += energy * w->lengths[springs[i]] / w->sums[point];
    return;
  }
  for (uint32_t i = 0; i < count; i++) {
    const uint32_t *ends = w->ends[springs[i]].at;
    directions[i] =
        sbfi_d3_normal(sbfi_d3_sub(sbfi_d3_of(w->positions[ends[1]]), sbfi_d3_of(w->positions[ends[0]])));
    fitted[i] = fractions[i] = w->lengths[springs[i]] / w->sums[point];
    for (uint32_t k = 0; k < i; k++) {
      double cosine = sbfi_d3_dot(directions[i], directions[k]);
      intersect[i][k] = intersect[k][i] = cosine * cosine * cosine * cosine;
    }
  }
  /* In units of 15 mu V: the diagonal of isotropic material is 3 mu V in every direction. All springs step at
   * once, so the result does not depend on their order. */
  double steepest = 1, next[MAX_MATCHED];
  for (uint32_t i = 0; i < count; i++) {
    double row = 1;
    for (uint32_t k = 0; k < count; k++) row += k != i ? intersect[i][k] : 0;
    steepest = fmax(steepest, row);
  }
  for (int step = 0; step < STEPS; step++) {
    double moved = 0;
    for (uint32_t i = 0; i < count; i++) {
      double missing = 3.0 / 15 - fitted[i];
      for (uint32_t k = 0; k < count; k++) missing -= k != i ? intersect[i][k] * fitted[k] : 0;
      next[i] = fmax(fitted[i] + missing / steepest, min_fraction * fractions[i]);
      if (!(fractions[i] > 0)) next[i] = 0;
      moved = fmax(moved, fabs(next[i] - fitted[i]));
    }
    memcpy(fitted, next, count * sizeof *fitted);
    if (moved < 1e-5) break;
  }
  double sum = 0;
  for (uint32_t i = 0; i < count; i++) sum += fitted[i];
  for (uint32_t i = 0; i < count; i++) parts[springs[i]] += energy * fitted[i] / sum;
}

bool sbfi_springs_matched(double modulus, const sbf_vec3 *positions, uint32_t point_count,
    const float *volumes, const sbf_uint2 *ends, uint32_t spring_count, float *stiffness,
    sbfi_progress progress, sbfi_arena *arena) {
  work w = {.positions = positions, .ends = ends, .point_count = point_count, .spring_count = spring_count};
  double *parts = sbfi_arena_allocate(arena, (size_t)spring_count + 1, sizeof *parts);
  if (!parts || !index_springs(&w, arena)) return false;
  for (uint32_t i = 0; i < point_count; i++) {
    if (!sbfi_progress_step(progress, i, point_count)) return false;
    match(&w, i, 6 * modulus * (double)volumes[i], parts);
  }
  for (uint32_t s = 0; s < spring_count; s++) {
    uint32_t a = ends[s].at[0], b = ends[s].at[1];
    double length = w.lengths[s];
    double count = w.begins[a + 1] - w.begins[a] + w.begins[b + 1] - w.begins[b];
    double counted = fmax(length, short_fraction * (w.sums[a] + w.sums[b]) / count);
    stiffness[s] = length > 0 ? (float)(parts[s] / (length * counted)) : 0;
  }
  return true;
}
