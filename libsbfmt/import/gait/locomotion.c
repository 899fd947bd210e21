/* Scores each kind of locomotion. The highest score wins. If the second is close, legs decide, and a
 * message asks for a check. */
#include "import/gait/locomotion.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const double CLEAR_MARGIN = 2.5; /* minimum lead in points; with less a person should check */

enum { BINS = 20, MIN_MIDDLE = 4, MIN_SNAKE = 6 };

const char *sbfi_locomotion_name(sbfi_locomotion_kind kind) {
  static const char *const names[SBFI_LOCOMOTION_KINDS] = {
      "walk", "swim", "fly", "slither", "crawl", "roll", "none"};
  return names[kind];
}

sbfi_locomotion_kind sbfi_locomotion_named(const char *name) {
  int k = 0;
  while (k < SBFI_LOCOMOTION_KINDS && strcmp(name, sbfi_locomotion_name((sbfi_locomotion_kind)k)) != 0) k++;
  return (sbfi_locomotion_kind)k;
}

typedef struct evaluation {
  sbfi_gait_draft draft;
  sbfi_rig_points points;
  sbfi_limb_shape *limbs;
  uint32_t limb_count;
  double height, length, width, size;                      /* m; along y, z and x */
  uint32_t legs, wings, wheels, flippers, deforming_bones; /* `holding`: number of bones with points */
  bool paired;
  bool is_row; /* a long body of many bones, which moves by waves */
  sbfi_locomotion *found;
} evaluation;

static void add(evaluation *j, sbfi_locomotion_kind kind, double points, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void add(evaluation *j, sbfi_locomotion_kind kind, double points, const char *format, ...) {
  if (j->found->evidence_count == SBFI_MAX_EVIDENCE) return;
  sbfi_evidence *e = &j->found->evidence[j->found->evidence_count++];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(e->text, sizeof e->text, format, arguments);
  va_end(arguments);
  e->kind = kind;
  e->points = points;
}

/* --- Shape ------------------------------------------------------------------------------------------- */

static double root_height(const evaluation *j, const sbfi_limb_shape *limb) {
  return (double)sbfi_draft_head(&j->draft, limb->root).y;
}

static bool could_stand(const evaluation *j, const sbfi_limb_shape *limb, double lowest) {
  if (limb->twin == SBF_NONE || limb->bones < 2 || limb->is_round || limb->is_loop) return false;
  const sbfi_limb_shape *twin = &j->limbs[limb->twin]; /* in mid stride one of a pair is lifted */
  double low = fmin(limb->low[1], twin->low[1]), root = fmax(root_height(j, limb), root_height(j, twin));
  return low < lowest + 0.08 * j->height && root > low + 0.12 * j->height;
}

/* Scores pairs of limbs that reach as low as the lowest pair and have hips well above their soles. */
static void score_legs(evaluation *j) {
  double lowest = INFINITY, ahead = -INFINITY, behind = INFINITY, middle = 0;
  uint32_t standing = 0, thick = 0;
  for (uint32_t l = 0; l < j->limb_count; l++)
    if (j->limbs[l].twin != SBF_NONE && j->limbs[l].points) lowest = fmin(lowest, j->limbs[l].low[1]);
  for (uint32_t l = 0; l < j->limb_count; l++) {
    const sbfi_limb_shape *limb = &j->limbs[l];
    if (!could_stand(j, limb, lowest)) continue;
    standing++;
    thick += limb->flatness > 0.33;
    ahead = fmax(ahead, limb->high[2]);
    behind = fmin(behind, limb->low[2]);
  }
  if (standing < 2 || (thick < 2 && standing < 4)) return;
  for (uint32_t i = 0; i < j->points.count; i++) middle += (double)j->points.at[i].z / j->points.count;
  double slack = 0.05 * j->size, ground = j->points.low[1];
  bool supports_body = ahead + slack > middle && behind - slack < middle && lowest < ground + 0.1 * j->height;
  bool grounded = fabs(lowest) < 0.1 * j->height;
  j->legs = standing;
  add(j, SBFI_LOCOMOTION_WALK, supports_body && grounded ? 4 : 2, "%u limbs in pairs reach %s", standing,
      supports_body && grounded ? "the ground below the body" : "down");
  add(j, SBFI_LOCOMOTION_SWIM, -3, "%u limbs can stand", standing);
}

/* Scores flat pairs above the ground: wings, or the fins of a ray if the body is flat too. */
static void score_wings(evaluation *j) {
  double ground = j->points.low[1];
  for (uint32_t l = 0; l < j->limb_count; l++) {
    const sbfi_limb_shape *limb = &j->limbs[l];
    if (limb->twin == SBF_NONE || limb->points < 4 || limb->flatness >= 0.25) continue;
    if (limb->high[0] - limb->low[0] < 0.15 * j->size || limb->low[1] < ground + 0.1 * j->height) continue;
    j->wings++;
  }
  if (j->wings >= 2) add(j, SBFI_LOCOMOTION_FLY, 2.5, "%u flat limbs in pairs are off the ground", j->wings);
}

static bool hovers(const evaluation *j) {
  return !j->legs && j->points.low[1] > 0.05 * fmax(j->height, 0.3 * j->size);
}

/* A long body without wings swims through air as through water, so its height is no evidence. */
static void score_position(evaluation *j) {
  double low = j->points.low[1];
  if (hovers(j) && (j->wings || !j->is_row))
    add(j, SBFI_LOCOMOTION_FLY, 2.5, "it has no legs and is above y = 0");
  if (low < -0.15 * j->height && j->deforming_bones >= 4)
    add(j, SBFI_LOCOMOTION_SWIM, 2, "it is modelled around y = 0, not above it");
}

/* Topmost ancestor of a bone. */
static uint32_t root_of(const evaluation *j, uint32_t bone) {
  int32_t parent;
  while ((parent = j->draft.asset->bones.at[bone].parent) != SBF_NONE) bone = (uint32_t)parent;
  return bone;
}

/* Counts middle bones with points below the root with most of them, and the extent of their heads along z.
 * Several skeletons side by side are not a row. */
static uint32_t measure_middle(const evaluation *j, const uint32_t *holds, double *span) {
  uint32_t max = 0;
  *span = 0;
  for (uint32_t root = 0; root < j->draft.asset->bones.count; root++) {
    double low = INFINITY, high = -INFINITY;
    uint32_t count = 0;
    if (j->draft.asset->bones.at[root].parent != SBF_NONE) continue;
    for (uint32_t i = root; i < j->draft.asset->bones.count; i++) {
      if (!holds[i] || j->draft.shapes[i].side || root_of(j, i) != root) continue;
      double z = (double)sbfi_draft_head(&j->draft, (int32_t)i).z;
      low = fmin(low, z);
      high = fmax(high, z);
      count++;
    }
    if (count <= max) continue;
    max = count;
    *span = high - low;
  }
  return max;
}

typedef struct slice {
  double low[2], high[2]; /* x, y */
  uint32_t points;
} slice;

static void measure_slices(const evaluation *j, slice slices[BINS]) {
  for (int b = 0; b < BINS; b++) slices[b] = (slice){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};
  for (uint32_t i = 0; i < j->points.count; i++) {
    double t = ((double)j->points.at[i].z - j->points.low[2]) / j->length;
    slice *s = &slices[t >= 1 ? BINS - 1 : t > 0 ? (int)(t * BINS) : 0];
    const double p[2] = {(double)j->points.at[i].x, (double)j->points.at[i].y};
    for (int k = 0; k < 2; k++) {
      s->low[k] = fmin(s->low[k], p[k]);
      s->high[k] = fmax(s->high[k], p[k]);
    }
    s->points++;
  }
}

static double area_of(const slice *s) {
  return s->points ? (s->high[0] - s->low[0]) * (s->high[1] - s->low[1]) : 0;
}

/* Scores a long body of many bones: a fish is thin at one end, a snake touches the ground. */
static void score_body(evaluation *j, const uint32_t *holds) {
  slice slices[BINS];
  double span, lying = 0, widest = 0;
  uint32_t bones = measure_middle(j, holds, &span);
  if (!(j->length > 0)) return;
  measure_slices(j, slices);
  for (int b = 0; b < BINS; b++) {
    lying += slices[b].points && slices[b].low[1] < j->points.low[1] + 0.1 * j->height;
    widest = fmax(widest, area_of(&slices[b]));
  }
  bool is_long = j->length > 2.5 * j->width;
  bool thin = area_of(&slices[1]) < 0.35 * widest || area_of(&slices[BINS - 2]) < 0.35 * widest;
  if (bones >= MIN_MIDDLE && span > 0.35 * j->length) {
    j->is_row = is_long;
    add(j, SBFI_LOCOMOTION_SWIM, 1, "%u bones in a row along %.0f %% of the length", bones,
        100 * span / j->length);
    if (is_long) add(j, SBFI_LOCOMOTION_SWIM, 1.5, "it is %.1f times as long as wide", j->length / j->width);
    if (thin) add(j, SBFI_LOCOMOTION_SWIM, 0.5, "an end is thin");
  }
  if (!j->paired && bones >= MIN_SNAKE && lying >= 0.5 * BINS && fabs(j->points.low[1]) < 0.1 * j->length)
    add(j, SBFI_LOCOMOTION_SLITHER, 3.5, "%u bones in a row lie along the ground, without limbs", bones);
}

static void score_wheels(evaluation *j) {
  uint32_t loops = 0, round = 0;
  double ground = j->points.low[1];
  for (uint32_t l = 0; l < j->limb_count; l++) {
    const sbfi_limb_shape *limb = &j->limbs[l];
    loops += limb->is_loop;
    if (limb->is_round && limb->low[1] < ground + 0.12 * j->height) round++;
  }
  j->wheels = round;
  if (loops >= 8)
    add(j, SBFI_LOCOMOTION_ROLL, 6, "%u bones form upright loops, as links of tracks do", loops);
  if (round >= 2)
    add(j, SBFI_LOCOMOTION_ROLL, round >= 4 ? 5 : 2 + 0.5 * (round - 2), "%u discs touch the ground", round);
}

static void score_size(evaluation *j) {
  bool grounded = fabs(j->points.low[1]) < 0.05 * j->height;
  add(j, SBFI_LOCOMOTION_NONE, 0.5, "it has nothing to move");
  if (j->deforming_bones <= 3 && !j->paired)
    add(j, SBFI_LOCOMOTION_NONE, 2.2, "only %u bone%s vertices", j->deforming_bones,
        j->deforming_bones == 1 ? " moves" : "s move");
  if (j->draft.has_mesh && !j->legs && !j->wings && grounded && j->deforming_bones >= 4 &&
      j->deforming_bones <= 10)
    add(j, SBFI_LOCOMOTION_CRAWL, 2, "it rests on the ground without legs");
}

/* --- Names ------------------------------------------------------------------------------------------- */

static void score_joints(evaluation *j) {
  uint32_t counts[SBFI_WORDS] = {0};
  const sbf_bone_list *bones = &j->draft.asset->bones;
  for (uint32_t i = 0; i < bones->count; i++) {
    if (!j->draft.shapes[i].moves_points) continue;
    uint32_t words = sbfi_words_of(bones->at[i].name);
    for (int w = 0; w < SBFI_WORDS; w++) counts[w] += words >> w & 1;
  }
  if (counts[SBFI_WORD_LEG] >= 2)
    add(j, SBFI_LOCOMOTION_WALK, 3, "%u bones are named like legs", counts[SBFI_WORD_LEG]);
  if (counts[SBFI_WORD_FIN] >= 2)
    add(j, SBFI_LOCOMOTION_SWIM, 3, "%u bones are named like fins", counts[SBFI_WORD_FIN]);
  if (counts[SBFI_WORD_WING] >= 2)
    add(j, SBFI_LOCOMOTION_FLY, 3.5, "%u bones are named like wings", counts[SBFI_WORD_WING]);
  if (counts[SBFI_WORD_WHEEL] >= 2)
    add(j, SBFI_LOCOMOTION_ROLL, counts[SBFI_WORD_WHEEL] >= 4 ? 4 : 3, "%u bones are named like wheels",
        counts[SBFI_WORD_WHEEL]);
  if (counts[SBFI_WORD_SNAKE]) add(j, SBFI_LOCOMOTION_SLITHER, 2, "a bone is named like a snake's");
}

static void score_objects(evaluation *j, const sbfi_locomotion_names *names) {
  uint32_t words = 0, of_bones = 0;
  for (uint32_t i = 0; i < names->object_count; i++) words |= sbfi_words_of(names->objects[i]);
  for (uint32_t i = 0; i < j->draft.asset->bones.count; i++)
    of_bones |= sbfi_words_of(j->draft.asset->bones.at[i].name);
  if (words >> SBFI_WORD_FIN & 1) add(j, SBFI_LOCOMOTION_SWIM, 2, "an object or material is named like fins");
  if (words >> SBFI_WORD_WING & 1)
    add(j, SBFI_LOCOMOTION_FLY, 1, "an object or material is named like wings");
  if (words >> SBFI_WORD_WHEEL & 1)
    add(j, SBFI_LOCOMOTION_ROLL, 1.5, "an object or material is named like wheels");
  if (words >> SBFI_WORD_SNAKE & 1)
    add(j, SBFI_LOCOMOTION_SLITHER, 3, "an object or material is named like a snake");
  if (words >> SBFI_WORD_FISH & 1) add(j, SBFI_LOCOMOTION_SWIM, 2, "it is named like a swimming animal");
  if (words >> SBFI_WORD_BIRD & 1) add(j, SBFI_LOCOMOTION_FLY, 2, "it is named like something that flies");
  if (words >> SBFI_WORD_VEHICLE & 1) add(j, SBFI_LOCOMOTION_ROLL, 2, "it is named like a vehicle");
  if (words >> SBFI_WORD_WALKER & 1) add(j, SBFI_LOCOMOTION_WALK, 1, "it is named like something with legs");
  bool has_spine = of_bones & (1u << SBFI_WORD_SPINE | 1u << SBFI_WORD_LEG | 1u << SBFI_WORD_WING);
  if ((words | of_bones) >> SBFI_WORD_OBJECT & 1 && !has_spine)
    add(j, SBFI_LOCOMOTION_NONE, 2, "it is named like an object");
}

/* A walking clip counts for legs only if there are legs. */
static sbfi_locomotion_kind walking_without_legs(const evaluation *j) {
  if (j->legs) return SBFI_LOCOMOTION_WALK;
  for (uint32_t e = 0; e < j->found->evidence_count; e++) {
    const sbfi_evidence *evidence = &j->found->evidence[e];
    if (evidence->kind == SBFI_LOCOMOTION_SLITHER || evidence->kind == SBFI_LOCOMOTION_ROLL)
      return evidence->kind;
  }
  return hovers(j) ? SBFI_LOCOMOTION_FLY : SBFI_LOCOMOTION_CRAWL;
}

static void score_clips(evaluation *j, const sbfi_locomotion_names *names) {
  uint32_t counts[SBFI_LOCOMOTION_KINDS] = {0};
  for (uint32_t i = 0; i < names->clip_count; i++) {
    sbfi_locomotion_kind kind = sbfi_clip_kind(names->clips[i]);
    if (kind == SBFI_LOCOMOTION_KINDS) continue;
    if (kind == SBFI_LOCOMOTION_WALK) kind = walking_without_legs(j);
    counts[kind]++;
  }
  for (int k = 0; k < SBFI_LOCOMOTION_KINDS; k++)
    if (counts[k])
      add(j, (sbfi_locomotion_kind)k, fmin(3, 1 + 0.5 * counts[k]), "%u clip%s of such motion", counts[k],
          counts[k] > 1 ? "s" : "");
}

/* --- Verdict ----------------------------------------------------------------------------------------- */

/* If the result is unclear, a character with usable legs walks, and one with little evidence stays in
 * place. */
static void decide(const evaluation *j) {
  sbfi_locomotion *found = j->found;
  double sums[SBFI_LOCOMOTION_KINDS] = {0};
  for (uint32_t e = 0; e < found->evidence_count; e++)
    sums[found->evidence[e].kind] += found->evidence[e].points;
  found->kind = SBFI_LOCOMOTION_NONE;
  found->second = SBFI_LOCOMOTION_KINDS;
  for (int k = 0; k < SBFI_LOCOMOTION_KINDS; k++)
    if (sums[k] > sums[found->kind]) found->kind = (sbfi_locomotion_kind)k;
  for (int k = 0; k < SBFI_LOCOMOTION_KINDS; k++)
    if (k != (int)found->kind && (found->second == SBFI_LOCOMOTION_KINDS || sums[k] > sums[found->second]))
      found->second = (sbfi_locomotion_kind)k;
  found->margin = sums[found->kind] - sums[found->second];
  found->unsure = found->margin < CLEAR_MARGIN;
  if (found->unsure && found->second == SBFI_LOCOMOTION_WALK && j->legs) {
    found->second = found->kind;
    found->kind = SBFI_LOCOMOTION_WALK;
  } else if (found->unsure && found->kind != SBFI_LOCOMOTION_WALK && sums[found->kind] < CLEAR_MARGIN) {
    if (found->kind != SBFI_LOCOMOTION_NONE) found->second = found->kind;
    found->kind = SBFI_LOCOMOTION_NONE;
  }
}

/* Computes points, sides and limbs seen after `turns` quarter turns. `mirrored` counts points of limbs
 * with a twin. Wheels count three times, because a car is symmetric in both directions. */
static bool check(evaluation *j, uint32_t turns, sbfi_arena *scratch, uint32_t *mirrored) {
  uint32_t bones = j->draft.asset->bones.count;
  j->draft.turns = turns;
  if (!sbfi_gather_points(j->draft.asset, turns, scratch, &j->points)) return false;
  j->limbs = sbfi_arena_allocate(scratch, bones, sizeof *j->limbs);
  if (!j->limbs || !sbfi_draft_shapes(&j->draft, scratch)) return false;
  if (!sbfi_find_limbs(&j->draft, &j->points, scratch, j->limbs, &j->limb_count)) return false;
  *mirrored = 0;
  for (uint32_t l = 0; l < j->limb_count; l++)
    if (j->limbs[l].twin != SBF_NONE) *mirrored += j->limbs[l].points * (j->limbs[l].is_round ? 3 : 1);
  j->paired = *mirrored > 0;
  return true;
}

/* For a shape with two symmetry planes, such as a crab or a tank, chooses the direction in which more
 * limbs have a twin. */
static bool predict(evaluation *j, sbfi_arena *scratch) {
  uint32_t mirrored, others;
  bool clear;
  if (!sbfi_gather_points(j->draft.asset, 0, scratch, &j->points)) return false;
  uint32_t turns = sbfi_mirror_turns(j->draft.asset, &j->points, &clear);
  if (!check(j, turns, scratch, &mirrored)) return false;
  if (clear) return true;
  evaluation other = {.draft = {.asset = j->draft.asset}, .found = j->found};
  if (!check(&other, !turns, scratch, &others)) return false;
  if (others > 2 * mirrored) *j = other;
  return true;
}

bool sbfi_find_locomotion(
    const sbf_asset *asset, const sbfi_locomotion_names *names, sbfi_arena *scratch, sbfi_locomotion *found) {
  evaluation j = {.draft = {.asset = (sbf_asset *)(uintptr_t)asset}, .found = found}; /* not modified here */
  *found = (sbfi_locomotion){.kind = SBFI_LOCOMOTION_NONE, .second = SBFI_LOCOMOTION_WALK};
  if (asset->bones.count == 0) return true;
  uint32_t *holds = sbfi_arena_allocate(scratch, asset->bones.count, sizeof *holds);
  if (!holds || !predict(&j, scratch)) return false;
  for (uint32_t i = 0; i < j.points.count; i++) j.deforming_bones += holds[j.points.bone[i]]++ == 0;
  j.width = j.points.high[0] - j.points.low[0];
  j.height = j.points.high[1] - j.points.low[1];
  j.length = j.points.high[2] - j.points.low[2];
  j.size = fmax(j.width, fmax(j.height, j.length));
  found->turns = j.draft.turns;
  score_legs(&j);
  if (j.draft.has_mesh) { /* bones without meshes give no evidence beyond their names */
    score_wings(&j);
    score_body(&j, holds);
    score_position(&j);
    score_wheels(&j);
  }
  score_size(&j);
  score_joints(&j);
  score_objects(&j, names);
  score_clips(&j, names);
  decide(&j);
  return true;
}
