/* Finds legs: limbs of one side that end at the ground.
 *
 * A limb begins where everything below a bone is on one side. It is a leg if it reaches the ground.
 * Consider the path from its root to the bone that stands on the ground: the three consecutive bones with
 * the longest reach are thigh, shin and foot. Skin of a shin may come down to the ground too, as that of a
 * boot: the path goes on to the foot. A collar bone before them, or the long middle foot of an animal that
 * walks on its toes, moves with its neighbour. A spider's foot is as long as the others and stands on its
 * toe, a fourth bone. */
#include <math.h>

#include "import/gait/gait_draft.h"
#include "import/gait/named_chains.h"

/* fraction of the height; maximum height of a leg's end above the ground */
static const double GROUND_FRACTION = 0.05;
static const double LIFTED_FRACTION = 0.2; /* the same for the twin of a leg, in a rig bound in mid stride */
/* fraction of the height; parts this close to the leg's lowest point are on the ground */
static const double FOOT_FRACTION = 0.02;
/* fraction of the hip's height above the sole; a bone that begins higher is no foot but a shin, even if skin
 * around its lower end is on the ground */
static const double SHIN_FRACTION = 0.25;
/* fraction of the height; minimum height of a leg's root above its sole */
static const double HIP_FRACTION = 0.05;
static const double MIN_SEGMENT = 0.05; /* minimum fraction of the reach for thigh and shin */
static const double LONG_FOOT = 0.25;   /* fraction of the reach; a foot this long leans over its toe */
static const double HIGH_ANKLE = 0.7;   /* if its ankle is this high, as a fraction of the hip's height */

/* Child on the path to the ground; the longer path if several reach it. */
static int32_t next_down(const sbfi_gait_draft *d, int32_t bone) {
  int32_t best = SBF_NONE;
  for (uint32_t i = (uint32_t)bone + 1; i < d->asset->bones.count; i++) {
    const sbfi_bone_shape *shape = &d->shapes[i];
    if (sbfi_draft_bone(d, (int32_t)i)->parent != bone || !shape->moves_points) continue;
    if (best == SBF_NONE || shape->low_below < d->shapes[best].low_below) best = (int32_t)i;
  }
  return best;
}

/* Child without points that marks the end of a leg's last bone, well below its head. */
static int32_t ankle_mark(const sbfi_gait_draft *d, int32_t bone) {
  double head = (double)sbfi_draft_bone(d, bone)->head.y, lowest = 0.5 * (head + d->ground);
  int32_t best = SBF_NONE;
  for (uint32_t i = (uint32_t)bone + 1; i < d->asset->bones.count; i++) {
    const sbf_bone *child = sbfi_draft_bone(d, (int32_t)i);
    if (child->parent != bone || d->shapes[i].moves_points || (double)child->head.y >= lowest) continue;
    lowest = (double)child->head.y;
    best = (int32_t)i;
  }
  return best;
}

/* Whether a foot stands upright below an ankle about as high as the hip, as a spider's does: then the leg
 * itself can bend and extend only a little. */
static bool is_long_foot(const sbfi_gait_draft *d, const sbfi_leg_draft *leg, int32_t toe) {
  double hip = (double)sbfi_draft_bone(d, leg->upper)->head.y - d->ground;
  double ankle = (double)sbfi_draft_bone(d, leg->end)->head.y - d->ground;
  return sbfi_draft_distance(d, leg->end, toe) > LONG_FOOT * leg->reach && ankle > HIGH_ANKLE * hip;
}

/* Selects thigh, shin and foot among the bones of a path downwards; false if there are none. */
static bool choose_bones(const sbfi_gait_draft *d, const int32_t *path, uint32_t count, sbfi_leg_draft *leg) {
  leg->reach = 0;
  for (uint32_t i = 0; i + 2 < count; i++) {
    double thigh = sbfi_draft_distance(d, path[i], path[i + 1]);
    double shin = sbfi_draft_distance(d, path[i + 1], path[i + 2]), reach = thigh + shin;
    if (fmin(thigh, shin) < MIN_SEGMENT * reach || reach < leg->reach) continue;
    leg->upper = path[i];
    leg->lower = path[i + 1];
    leg->end = path[i + 2];
    leg->reach = reach;
    leg->toe = i + 3 < count && is_long_foot(d, leg, path[i + 3]) ? path[i + 3] : SBF_NONE;
  }
  if (leg->reach > 0) return true;
  if (count < 2) return false;
  leg->upper = path[count - 2]; /* a single bone swings the foot */
  leg->lower = SBF_NONE;
  leg->end = path[count - 1];
  leg->reach = sbfi_draft_distance(d, leg->upper, leg->end);
  return leg->reach > 0;
}

/* Whether a bone of a limb begins too high for a foot. */
static bool is_shin(const sbfi_gait_draft *d, int32_t bone, int32_t limb) {
  double lowest = d->shapes[limb].low_below;
  return (double)sbfi_draft_head(d, bone).y - lowest >
         SHIN_FRACTION * ((double)sbfi_draft_head(d, limb).y - lowest);
}

static bool add_leg(sbfi_gait_draft *d, int32_t limb, double ground_fraction, int32_t *path) {
  const sbfi_bone_shape *shape = &d->shapes[limb];
  uint32_t count = 0;
  if (shape->low_below > d->ground + ground_fraction * d->height) return false;
  if ((double)sbfi_draft_bone(d, limb)->head.y < shape->low_below + HIP_FRACTION * d->height) return false;
  double stands = shape->low_below + FOOT_FRACTION * d->height;
  for (int32_t bone = limb, next; bone != SBF_NONE; bone = next) {
    path[count++] = bone;
    next = next_down(d, bone);
    bool has_foot = next != SBF_NONE && d->shapes[next].low_below <= stands && is_shin(d, bone, limb);
    if (d->shapes[bone].low <= stands && !has_foot) break;
  }
  bool needs_ankle = count == 2 || (count > 2 && is_shin(d, path[count - 1], limb));
  int32_t mark = needs_ankle ? ankle_mark(d, path[count - 1]) : SBF_NONE;
  if (mark != SBF_NONE) path[count++] = mark;
  sbfi_leg_draft *leg = &d->legs[d->leg_count];
  *leg = (sbfi_leg_draft){.limb = limb, .side = shape->side, .toe = SBF_NONE};
  return choose_bones(d, path, count, leg);
}

/* Finds hips and chest: the bones that carry the rearmost and the foremost legs. If they are one bone, it
 * is the hips. */
static void find_girdles(sbfi_gait_draft *d) {
  double rearmost = INFINITY, foremost = -INFINITY;
  d->hips = d->chest = SBF_NONE;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    int32_t limb_root = sbfi_draft_bone(d, d->legs[l].limb)->parent;
    double z = (double)sbfi_draft_bone(d, d->legs[l].end)->head.z;
    if (limb_root == SBF_NONE) continue;
    if (z < rearmost) d->hips = limb_root;
    if (z > foremost) d->chest = limb_root;
    rearmost = fmin(rearmost, z);
    foremost = fmax(foremost, z);
  }
  if (d->chest == d->hips) d->chest = SBF_NONE;
}

static uint32_t count_bearing(const sbfi_gait_draft *d, int32_t bone) {
  uint32_t count = 0;
  for (uint32_t i = (uint32_t)bone; i < d->asset->bones.count; i++)
    count += d->shapes[i].moves_points && sbfi_draft_is_below(d, (int32_t)i, bone);
  return count;
}

static bool begins_limb(const sbfi_gait_draft *d, int32_t bone) {
  int32_t parent = sbfi_draft_bone(d, bone)->parent;
  return d->height > 0 && d->shapes[bone].side && parent != SBF_NONE && d->shapes[parent].side == 0;
}

/* A rig bound in mid stride has a foot in the air. A limb is also a leg if it hangs on the same bone as an
 * unpaired leg of the other side and is built like it. */
static void add_lifted_legs(sbfi_gait_draft *d, int32_t *path) {
  uint32_t sides[2] = {0, 0}, grounded = d->leg_count;
  for (uint32_t l = 0; l < grounded; l++) sides[d->legs[l].side > 0]++;
  if (sides[0] == sides[1]) return;
  int poorer = sides[1] < sides[0] ? 1 : -1;
  for (uint32_t i = 0; i < d->asset->bones.count && sides[0] != sides[1]; i++) {
    bool alike = false;
    if (!begins_limb(d, (int32_t)i) || d->shapes[i].side != poorer) continue;
    for (uint32_t l = 0; l < grounded; l++) {
      int32_t other = d->legs[l].limb;
      if (d->legs[l].side == poorer) continue;
      alike = alike || (sbfi_draft_bone(d, other)->parent == sbfi_draft_bone(d, (int32_t)i)->parent &&
                           count_bearing(d, other) == count_bearing(d, (int32_t)i));
    }
    for (uint32_t l = 0; l < grounded; l++) alike = alike && d->legs[l].limb != (int32_t)i;
    if (!alike || !add_leg(d, (int32_t)i, LIFTED_FRACTION, path)) continue;
    d->leg_count++;
    sides[poorer > 0]++;
  }
}

bool sbfi_draft_legs(sbfi_gait_draft *d, sbfi_arena *scratch) {
  uint32_t count = d->asset->bones.count;
  int32_t *path = sbfi_arena_allocate(scratch, count, sizeof *path);
  d->legs = sbfi_arena_allocate(scratch, count, sizeof *d->legs);
  if (!path || !d->legs) return false;
  if (!sbfi_draft_named_legs(d)) {
    for (uint32_t i = 0; i < count; i++)
      if (begins_limb(d, (int32_t)i) && add_leg(d, (int32_t)i, GROUND_FRACTION, path)) d->leg_count++;
    add_lifted_legs(d, path);
  }
  find_girdles(d);
  return true;
}
