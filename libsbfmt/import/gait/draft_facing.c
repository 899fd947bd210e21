/* Finds the direction that a character faces: its legs form pairs across the plane between left and right;
 * their names or their feet tell which end is the front. */
#include <math.h>
#include <stdlib.h>

#include "import/gait/gait_draft.h"
#include "motion/retargeting.h"

static const double PAIR_FRACTION =
    0.1; /* fraction of the height; maximum distance of a leg from its twin's mirror image */
static const double SIDEWAYS_MARGIN = 0.25; /* minimum advantage for a sideways facing to win */
enum { QUADRUPED_LEGS = 4 };

/* Above 0 if the legs named left are on the left; below 0 if they are on the right. */
static int facing_of_names(const sbfi_gait_draft *d) {
  int votes = 0;
  for (uint32_t l = 0; l < d->leg_count; l++)
    votes += d->legs[l].side * sbfi_name_side(sbfi_draft_bone(d, sbfi_draft_is_standing(&d->legs[l]))->name);
  return votes;
}

/* Rates a division into left and right: for each leg 0 to 1 by how close it is to its twin's mirror image,
 * plus the evidence of names. */
static double rate_sides(const sbfi_gait_draft *d) {
  double sum = abs(facing_of_names(d));
  for (uint32_t l = 0; l < d->leg_count; l++) {
    sbf_vec3 here = sbfi_draft_head(d, sbfi_draft_is_standing(&d->legs[l]));
    double nearest = PAIR_FRACTION * d->height;
    for (uint32_t k = 0; k < d->leg_count; k++) {
      sbf_vec3 there = sbfi_draft_head(d, sbfi_draft_is_standing(&d->legs[k]));
      double x = (double)here.x + (double)there.x, y = (double)here.y - (double)there.y;
      double z = (double)here.z - (double)there.z;
      if (d->legs[k].side != d->legs[l].side) nearest = fmin(nearest, sqrt(x * x + y * y + z * z));
    }
    sum += 1 - nearest / (PAIR_FRACTION * d->height);
  }
  return sum;
}

/* Above 0 if the feet reach farther to the front of their joints than to the back. */
static double facing_of_feet(const sbfi_gait_draft *d) {
  double ahead = 0;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    int32_t foot = sbfi_draft_is_standing(&d->legs[l]);
    double ankle = (double)sbfi_draft_head(d, foot).z;
    for (uint32_t i = (uint32_t)foot; i < d->asset->bones.count; i++) {
      if (!sbfi_draft_is_below(d, (int32_t)i, foot)) continue;
      if (d->has_mesh)
        ahead += d->shapes[i].sum_z - d->shapes[i].points * ankle;
      else
        ahead += (double)sbfi_draft_head(d, (int32_t)i).z - ankle;
    }
  }
  return ahead;
}

/* Whether the head is behind all feet. An animal's head is in front of its fore feet, so this is stronger
 * evidence than short hooves. */
static bool is_head_behind_feet(const sbfi_gait_draft *d) {
  int32_t head = d->leg_count >= QUADRUPED_LEGS ? sbfi_draft_named_head(d) : SBF_NONE;
  if (head == SBF_NONE) return false;
  for (uint32_t l = 0; l < d->leg_count; l++)
    if (sbfi_draft_head(d, head).z >= sbfi_draft_head(d, sbfi_draft_is_standing(&d->legs[l])).z) return false;
  return true;
}

bool sbfi_draft_facing(const sbf_asset *asset, sbfi_arena *scratch, uint32_t *turns) {
  sbfi_gait_draft seen[2];
  double rates[2];
  for (uint32_t t = 0; t < 2; t++) {
    seen[t] = (sbfi_gait_draft){.asset = (sbf_asset *)(uintptr_t)asset, .turns = t}; /* not modified here */
    if (!sbfi_draft_shapes(&seen[t], scratch) || !sbfi_draft_legs(&seen[t], scratch)) return false;
    rates[t] = rate_sides(&seen[t]);
  }
  uint32_t side = rates[1] > rates[0] + SIDEWAYS_MARGIN;
  int names = facing_of_names(&seen[side]);
  double feet = facing_of_feet(&seen[side]);
  bool backwards =
      side ? names < 0 || (names == 0 && feet < 0) : names < 0 && (feet < 0 || is_head_behind_feet(&seen[0]));
  *turns = side + 2 * backwards;
  return true;
}
