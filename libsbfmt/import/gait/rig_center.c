/* Finds the middle of a rig that stands away from the origin of its file. */
#include <math.h>
#include <stdlib.h>

#include "import/gait/gait_draft.h"

enum { MIN_BONES = 3, MAX_SAMPLES = 400 };
/* Fractions of the size of the skeleton: tolerance of mirrored heads, and least offset from 0. */
static const double NEAR = 0.02, OFFSET = 0.02;
/* Fractions of the bones: least number with a mirrored one, and least advantage over the plane at 0. */
static const double MIN_ALIKE = 0.6, CLEARLY = 0.25;

typedef struct heads {
  double (*at)[3]; /* (count) */
  double *sorted;  /* (count) scratch */
  uint32_t count;
  double size;
} heads;

/* Root of the skeleton with most bones; the first of equals. */
static uint32_t main_skeleton(const sbf_bone_list *bones, uint32_t *root_of, uint32_t *counts) {
  uint32_t best = 0;
  for (uint32_t i = 0; i < bones->count; i++) {
    int32_t parent = bones->at[i].parent;
    root_of[i] = parent == SBF_NONE ? i : root_of[parent];
    counts[root_of[i]]++;
  }
  for (uint32_t i = 0; i < bones->count; i++)
    if (counts[i] > counts[best]) best = i;
  return best;
}

static void take_heads(heads *h, const sbf_bone_list *bones, const uint32_t *root_of, uint32_t root) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (uint32_t i = root; i < bones->count; i++) {
    if (root_of[i] != root) continue;
    const sbf_vec3 p = bones->at[i].head;
    const double at[3] = {(double)p.x, (double)p.y, (double)p.z};
    for (int k = 0; k < 3; k++) {
      h->at[h->count][k] = at[k];
      low[k] = fmin(low[k], at[k]);
      high[k] = fmax(high[k], at[k]);
      h->size = fmax(h->size, high[k] - low[k]);
    }
    h->count++;
  }
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The limbs of a symmetric rig balance each other, and its spine lies in the middle. */
static double median(const heads *h, int axis) {
  for (uint32_t i = 0; i < h->count; i++) h->sorted[i] = h->at[i][axis];
  qsort(h->sorted, h->count, sizeof *h->sorted, compare);
  return 0.5 * (h->sorted[(h->count - 1) / 2] + h->sorted[h->count / 2]);
}

static bool has_mirrored(const heads *h, uint32_t bone, int axis, double plane) {
  double to[3] = {h->at[bone][0], h->at[bone][1], h->at[bone][2]};
  to[axis] = 2 * plane - to[axis];
  for (uint32_t i = 0; i < h->count; i++)
    if (fabs(h->at[i][0] - to[0]) <= NEAR * h->size && fabs(h->at[i][1] - to[1]) <= NEAR * h->size &&
        fabs(h->at[i][2] - to[2]) <= NEAR * h->size)
      return true;
  return false;
}

/* Fraction of the bones that have a mirrored one. */
static double rate(const heads *h, int axis, double plane) {
  uint32_t step = h->count / MAX_SAMPLES + 1, sampled = 0, alike = 0;
  for (uint32_t i = 0; i < h->count; i += step, sampled++) alike += has_mirrored(h, i, axis, plane);
  return sampled ? (double)alike / sampled : 0;
}

bool sbfi_rig_center(const sbf_asset *asset, sbfi_arena *scratch, sbf_vec3 *center) {
  const sbf_bone_list *bones = &asset->bones;
  heads h = {.at = sbfi_arena_allocate(scratch, bones->count, sizeof *h.at),
      .sorted = sbfi_arena_allocate(scratch, bones->count, sizeof *h.sorted)};
  uint32_t *root_of = sbfi_arena_allocate(scratch, bones->count, sizeof *root_of);
  uint32_t *counts = sbfi_arena_allocate(scratch, bones->count, sizeof *counts);
  double found[3] = {0, 0, 0};
  *center = (sbf_vec3){0, 0, 0};
  if (bones->count == 0) return true;
  if (!h.at || !h.sorted || !root_of || !counts) return false;
  take_heads(&h, bones, root_of, main_skeleton(bones, root_of, counts));
  for (int axis = 0; axis < 3 && h.count >= MIN_BONES; axis += 2) {
    double plane = median(&h, axis);
    if (fabs(plane) <= OFFSET * h.size) continue;
    double alike = rate(&h, axis, plane);
    if (alike >= MIN_ALIKE && alike >= rate(&h, axis, 0) + CLEARLY) found[axis] = plane;
  }
  *center = (sbf_vec3){(float)found[0], 0, (float)found[2]};
  return true;
}
