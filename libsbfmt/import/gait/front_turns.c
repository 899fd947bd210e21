/* Finds the front end of a character without legs. */
#include <math.h>

#include "import/gait/locomotion.h"
#include "motion/retargeting.h"

enum { MIN_CHAIN = 4 }; /* bones */

/* fraction of the length at an end; ratio of the widths of both ends */
static const double TAIL_END = 0.25, NARROW = 0.7;

/* Above 0 if bones named left are on the left and heads in front of tails, seen after `turns` quarter
 * turns. */
static double facing_of_names(const sbf_asset *asset, uint32_t turns, sbf_vec3 center, double length) {
  const sbfi_gait_draft seen = {.turns = turns, .center = center};
  double votes = 0, ends[2] = {0, 0};
  uint32_t counts[2] = {0, 0};
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_bone *bone = &asset->bones.at[i];
    sbf_vec3 head = sbfi_draft_seen(&seen, bone->head);
    uint32_t words = sbfi_words_of(bone->name);
    double x = (double)head.x;
    if (fabs(x) > 0.01 * length) votes += sbfi_name_side(bone->name) * (x > 0 ? 1 : -1);
    for (int k = 0; k < 2; k++) {
      if (!(words >> (k ? SBFI_WORD_TAIL : SBFI_WORD_HEAD) & 1)) continue;
      ends[k] += (double)head.z;
      counts[k]++;
    }
  }
  if (counts[0] && counts[1]) {
    double ahead = ends[0] / counts[0] - ends[1] / counts[1];
    if (fabs(ahead) > 0.05 * length) votes += ahead > 0 ? 2 : -2;
  }
  return votes;
}

/* Width of the points near an end. */
static double width_near(const sbfi_rig_points *points, bool front) {
  double length = points->high[2] - points->low[2], low = INFINITY, high = -INFINITY;
  for (uint32_t i = 0; i < points->count; i++) {
    double z = (double)points->at[i].z;
    if (front ? z < points->high[2] - TAIL_END * length : z > points->low[2] + TAIL_END * length) continue;
    low = fmin(low, (double)points->at[i].x);
    high = fmax(high, (double)points->at[i].x);
  }
  return high > low ? high - low : 0;
}

/* Above 0 if the root of a simple chain of bones is in front of its end; 0 if it is not a simple chain.
 * The heads of fishes and snakes are the roots of their rigs. */
static double facing_of_chain(const sbf_asset *asset, uint32_t turns) {
  const sbfi_gait_draft seen = {.turns = turns};
  uint32_t count = asset->bones.count;
  for (uint32_t i = 0; i < count; i++)
    if (asset->bones.at[i].parent != (int32_t)i - 1) return 0; /* SBF_NONE is -1 */
  sbf_vec3 root = sbfi_draft_seen(&seen, asset->bones.at[0].head);
  sbf_vec3 end = sbfi_draft_seen(&seen, asset->bones.at[count - 1].head);
  return count >= MIN_CHAIN ? (double)root.z - (double)end.z : 0;
}

bool sbfi_front_turns(
    const sbf_asset *asset, uint32_t sides, sbfi_locomotion_kind kind, sbfi_arena *scratch, uint32_t *turns) {
  sbfi_rig_points points;
  *turns = 0;
  if (kind == SBFI_LOCOMOTION_NONE) return true;
  if (!sbfi_gather_points(asset, sides, scratch, &points)) return false;
  double names = facing_of_names(asset, sides, points.center, points.high[2] - points.low[2]);
  bool backwards = names < 0;
  if (names == 0 && (kind == SBFI_LOCOMOTION_SWIM || kind == SBFI_LOCOMOTION_SLITHER)) {
    double chain = facing_of_chain(asset, sides);
    backwards = chain < 0 || (chain == 0 && width_near(&points, true) < NARROW * width_near(&points, false));
  }
  *turns = sides + 2 * backwards;
  return true;
}
