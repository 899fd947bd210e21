/* If a limb is far from the rig's, the nearest surface gives no direction. Among many directions chooses
 * the one in which the limb matches parts of the input that no other part of the rig matches. */
#include <math.h>
#include <stdlib.h>

#include "import/rigging/pose_fit.h"
#include "import/rigging/similarity.h"
#include "motion/quatd.h"

enum { DIRECTIONS = 600, LIMB_SAMPLES = 80 };

/* Minimum cosine of the rotation of a limb. */
static const double FARTHEST = 0.0;
/* Minimum reach of a limb as a fraction of the rig's size; maximum fraction of the samples in a limb. */
static const double MIN_REACH = 0.06, MAX_LIMB = 0.5;
/* Minimum fraction of a limb's samples without a match if its pose differs. */
static const double MIN_UNMATCHED = 0.25;
/* Minimum gain of a rotation. A full match of the limb counts 1, and covering an equal amount of unmatched
 * input counts 1. */
static const double GAIN = 0.15;
static const double PER_RADIAN = 0.1; /* additional gain required per radian */
static const double ROUNDING = 1e-9;  /* of distances, relative */

typedef struct limb {
  sbfi_d3 joint, direction;
  sbfi_d3 positions[LIMB_SAMPLES], normals[LIMB_SAMPLES]; /* relative to the joint */
  uint32_t count, all; /* number of samples of the limb; number of the rig's samples */
} limb;

typedef struct input_sample {
  double along; /* coordinate on the longest axis of the input */
  sbfi_d3 position, normal;
  uint32_t number;
} input_sample;

typedef struct search {
  sbfi_pose_fit *f;
  int axis;                                                              /* longest of the input */
  input_sample samples[SBFI_POSE_SAMPLES], unmatched[SBFI_POSE_SAMPLES]; /* ascending along the axis */
  uint32_t unmatched_count;                                              /* samples without a match */
  sbfi_d3 directions[DIRECTIONS];
} search;

static double weight_below(const sbfi_pose_fit *f, const sbfi_surface_sample *s, uint32_t bone) {
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    const sbfi_influences *of = &f->r->rig_weights[s->points[k]];
    for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES && of->at[i].weight > 0; i++)
      if (sbfi_pose_fit_is_descendant(f, (uint32_t)f->r->c->bone_of_node[of->at[i].node], bone))
        sum += s->weights[k] * (double)of->at[i].weight;
  }
  return sum;
}

/* Selects the samples that a bone moves; false if the limb has no differing pose. */
static bool measure_limb(const search *s, uint32_t bone, limb *l) {
  const sbfi_pose_fit *f = s->f;
  uint32_t of_limb[SBFI_POSE_SAMPLES], away_count = 0;
  double reach = 0, size = f->r->rig.size;
  sbfi_d3 sum = {0, 0, 0};
  l->all = 0;
  l->joint = sbfi_pose_fit_joint(f, bone);
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    const sbfi_surface_sample *at = &f->rig_samples[i];
    if (weight_below(f, at, bone) < 0.5) continue;
    of_limb[l->all++] = i;
    away_count += at->gap > SBFI_ON_SURFACE * size;
    sbfi_d3 from = sbfi_d3_sub(at->position, l->joint);
    sum = sbfi_d3_add(sum, from);
    reach = fmax(reach, sbfi_d3_length(from));
  }
  if (l->all < 4 || l->all > MAX_LIMB * SBFI_POSE_SAMPLES || reach < MIN_REACH * size ||
      away_count < MIN_UNMATCHED * l->all)
    return false;
  l->direction = sbfi_d3_normal(sum);
  l->count = l->all < LIMB_SAMPLES ? l->all : LIMB_SAMPLES;
  for (uint32_t k = 0; k < l->count; k++) {
    const sbfi_surface_sample *at = &f->rig_samples[of_limb[(uint64_t)k * l->all / l->count]];
    l->positions[k] = sbfi_d3_sub(at->position, l->joint);
    l->normals[k] = at->normal;
  }
  return sbfi_d3_length(sum) > 0;
}

static sbfi_d3 rotated(const double rotation[4], sbfi_d3 v) {
  double to[3];
  sbfi_quatd_rotate(rotation, (const double[3]){v.x, v.y, v.z}, to);
  return (sbfi_d3){to[0], to[1], to[2]};
}

static double squared_distance(sbfi_d3 a, sbfi_d3 b) {
  sbfi_d3 d = sbfi_d3_sub(a, b);
  return sbfi_d3_dot(d, d);
}

static double along(const search *s, sbfi_d3 p) {
  return s->axis == 0 ? p.x : s->axis == 1 ? p.y : p.z;
}

/* First sample that is not farther back than `from` along the axis. */
static uint32_t first_sample(const input_sample *samples, uint32_t count, double from) {
  uint32_t low = 0, high = count;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (samples[middle].along < from)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* Squared distance from a point to the nearest sample that faces alike, at most `cap` squared. */
static double squared_gap(const search *s, sbfi_d3 p, sbfi_d3 normal, double cap) {
  double at = along(s, p), reach = cap * (1 + ROUNDING), nearest = cap * cap;
  for (uint32_t i = first_sample(s->samples, SBFI_POSE_SAMPLES, at - reach);
       i < SBFI_POSE_SAMPLES && s->samples[i].along <= at + reach; i++) {
    double squared = squared_distance(s->samples[i].position, p);
    if (squared < nearest && sbfi_d3_dot(s->samples[i].normal, normal) > 0.5) nearest = squared;
  }
  return nearest;
}

/* Lowers squared distances of unmatched samples, by their numbers, to that of a point that faces alike. */
static void cover(const search *s, sbfi_d3 p, sbfi_d3 normal, double cap, double *nearest) {
  double at = along(s, p), reach = cap * (1 + ROUNDING);
  for (uint32_t i = first_sample(s->unmatched, s->unmatched_count, at - reach);
       i < s->unmatched_count && s->unmatched[i].along <= at + reach; i++) {
    const input_sample *of = &s->unmatched[i];
    double squared = squared_distance(of->position, p);
    if (squared < nearest[of->number] && sbfi_d3_dot(of->normal, normal) > 0.5) nearest[of->number] = squared;
  }
}

/* Score of a limb: fraction that matches the input, plus the newly covered amount relative to the limb. */
static double evaluate(const search *s, const limb *l, const double rotation[4]) {
  const sbfi_pose_fit *f = s->f;
  double cap = SBFI_MAX_GAP * f->r->rig.size, lies = 0, covers = 0, nearest_unmatched[SBFI_POSE_SAMPLES];
  for (uint32_t i = 0; i < s->unmatched_count; i++) nearest_unmatched[i] = cap * cap;
  for (uint32_t k = 0; k < l->count; k++) {
    sbfi_d3 p = sbfi_d3_add(l->joint, rotated(rotation, l->positions[k])),
            n = rotated(rotation, l->normals[k]);
    lies += 1 - sqrt(squared_gap(s, p, n, cap)) / cap;
    cover(s, p, n, cap, nearest_unmatched);
  }
  for (uint32_t i = 0; i < s->unmatched_count; i++) covers += 1 - sqrt(nearest_unmatched[i]) / cap;
  return lies / l->count + fmin(covers / l->all, 1);
}

static void rotation_between(sbfi_d3 from, sbfi_d3 to, double rotation[4]) {
  sbfi_quatd_between(
      (const double[3]){from.x, from.y, from.z}, (const double[3]){to.x, to.y, to.z}, rotation);
}

static int compare_along(const void *a, const void *b) {
  const input_sample *x = a, *y = b;
  if (x->along != y->along) return x->along < y->along ? -1 : 1;
  return (x->number > y->number) - (x->number < y->number);
}

static void sort_samples(search *s) {
  const sbfi_pose_fit *f = s->f;
  sbfi_d3 sides = sbfi_d3_sub(sbfi_d3_of(f->input.high), sbfi_d3_of(f->input.low));
  s->axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
  s->unmatched_count = 0;
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    const sbfi_surface_sample *at = &f->input_samples[i];
    s->samples[i] = (input_sample){along(s, at->position), at->position, at->normal, i};
    if (at->gap <= SBFI_ON_SURFACE * f->r->rig.size) continue;
    s->unmatched[s->unmatched_count] = s->samples[i];
    s->unmatched[s->unmatched_count].number = s->unmatched_count;
    s->unmatched_count++;
  }
  qsort(s->samples, SBFI_POSE_SAMPLES, sizeof *s->samples, compare_along);
  qsort(s->unmatched, s->unmatched_count, sizeof *s->unmatched, compare_along);
}

static bool find_rotation(const search *s, const limb *l, double best_rotation[4]) {
  static const double none[4] = {0, 0, 0, 1};
  double best = evaluate(s, l, none) + GAIN;
  bool found = false;
  for (uint32_t i = 0; i < DIRECTIONS; i++) {
    sbfi_d3 to = s->directions[i];
    double rotation[4], cosine = sbfi_d3_dot(to, l->direction);
    if (cosine < FARTHEST) continue;
    rotation_between(l->direction, to, rotation);
    double sine = sqrt(fmax(1 - rotation[3] * rotation[3], 0)); /* of half the angle */
    double score = evaluate(s, l, rotation) - PER_RADIAN * 2 * sine;
    if (score <= best) continue;
    best = score;
    found = true;
    for (int k = 0; k < 4; k++) best_rotation[k] = rotation[k];
  }
  return found;
}

bool sbfi_pose_search_limbs(sbfi_pose_fit *f) {
  search *s = sbfi_arena_allocate(f->arena, 1, sizeof *s);
  limb *l = sbfi_arena_allocate(f->arena, 1, sizeof *l);
  if (!s || !l) return false;
  s->f = f;
  sbfi_spread_directions(s->directions, DIRECTIONS);
  for (uint32_t b = 0; b < f->bone_count; b++) {
    double rotation[4];
    if (f->bones[b].parent == SBF_NONE || !measure_limb(s, b, l)) continue;
    sort_samples(s);
    if (!find_rotation(s, l, rotation)) continue;
    sbfi_pose_fit_rotate(f, b, rotation);
    if (!sbfi_pose_fit_update(f)) return false;
  }
  return true;
}
