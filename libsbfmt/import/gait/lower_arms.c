/* Natural angles for arms that are held out in the bind pose. */
#include <math.h>

#include "import/convert/propose_limits.h"
#include "import/gait/named_chains.h"
#include "motion/quatd.h"

static const double DEGREE = 0.017453292519943295;
static const double ENOUGH = 30,
                    /* degrees; ENOUGH: angle below level in the bind pose from which arms stay as they are */
    DOWN = 70, AHEAD = 5, ELBOW = 20;
static const double FINGER[3] = {15, 25, 15}; /* degrees, by joint */
static const double STRAIGHT = 0.94;          /* minimum cosine between the bones of straight fingers */

static void head_of(const sbfi_rig_view *view, int32_t bone, double to[3]) {
  sbf_vec3 head = sbfi_draft_head(&view->draft, bone);
  to[0] = (double)head.x;
  to[1] = (double)head.y;
  to[2] = (double)head.z;
}

static bool direction(const double from[3], const double to[3], double heading[3]) {
  double length = 0;
  for (int k = 0; k < 3; k++) {
    heading[k] = to[k] - from[k];
    length += heading[k] * heading[k];
  }
  length = sqrt(length);
  for (int k = 0; k < 3 && length > 0; k++) heading[k] /= length;
  return length > 0;
}

static void rotation_about(const double axis[3], double angle, double rotation[4]) {
  for (int k = 0; k < 3; k++) rotation[k] = axis[k] * sin(angle / 2);
  rotation[3] = cos(angle / 2);
}

static void set_rotation(sbfi_pose_draft *pose, int32_t bone, const double rotation[4]) {
  for (int k = 0; k < 4; k++) pose->rotations[bone][k] = rotation[k];
  pose->is_rotated[bone] = true;
}

/* Child with most points in its subtree; SBF_NONE if none. */
static int32_t thickest_child(const sbfi_rig_view *view, int32_t bone, double *length) {
  const sbfi_gait_draft *d = &view->draft;
  int32_t best = SBF_NONE;
  double farthest = 0;
  for (uint32_t i = (uint32_t)bone + 1; i < d->asset->bones.count; i++) {
    if (sbfi_draft_bone(d, (int32_t)i)->parent != bone || !d->shapes[i].moves_points) continue;
    double reach = sbfi_draft_distance(d, bone, (int32_t)i);
    if (best != SBF_NONE && reach <= farthest) continue;
    farthest = reach;
    best = (int32_t)i;
  }
  *length = farthest;
  return best;
}

/* Whether a bone of an arm is a collarbone by its name and that of the next: some are as long as an upper
 * arm, because they start at the spine. */
static bool is_collarbone(const sbfi_rig_view *view, int32_t bone) {
  const sbfi_gait_draft *d = &view->draft;
  double length;
  int32_t upper = thickest_child(view, bone, &length);
  if (upper == SBF_NONE || sbfi_part_by_name(sbfi_draft_bone(d, bone)->name) != SBFI_PART_COLLAR ||
      sbfi_part_by_name(sbfi_draft_bone(d, upper)->name) != SBFI_PART_SHOULDER)
    return false;
  int32_t lower = thickest_child(view, upper, &length);
  return lower != SBF_NONE && sbfi_part_by_name(sbfi_draft_bone(d, lower)->name) == SBFI_PART_ELBOW;
}

/* Selects upper arm, forearm and hand: the two consecutive bones below the shoulder with the longest
 * reach. */
static bool choose_arm(const sbfi_rig_view *view, const sbfi_limb_shape *limb, sbfi_arm_draft *arm) {
  double best = 0, one, two;
  *arm = (sbfi_arm_draft){.upper = SBF_NONE, .side = limb->side};
  for (int32_t bone = limb->root; bone != SBF_NONE; bone = thickest_child(view, bone, &one)) {
    int32_t lower = thickest_child(view, bone, &one), hand;
    if (lower == SBF_NONE) break;
    if (is_collarbone(view, bone)) continue;
    hand = thickest_child(view, lower, &two);
    if (hand == SBF_NONE) {
      if (best > 0) break;
      two = (double)sbfi_draft_bone(&view->draft, lower)->length;
    }
    if (fmin(one, two) < 0.2 * (one + two) || one + two <= 1.05 * best) continue;
    best = one + two;
    *arm = (sbfi_arm_draft){bone, lower, hand, limb->side};
  }
  return arm->upper != SBF_NONE;
}

/* Ears, hair and horns form pairs like arms do. */
static bool is_of_head(const sbfi_gait_draft *d, const sbf_gait *gait, int32_t bone) {
  for (int32_t at = bone; at != SBF_NONE; at = sbfi_draft_bone(d, at)->parent)
    if (sbfi_words_of(sbfi_draft_bone(d, at)->name) >> SBFI_WORD_HEAD & 1) return true;
  return gait->head && sbfi_draft_is_below(d, bone, gait->head->bone);
}

uint32_t sbfi_draft_arms(const sbfi_rig_view *view, const sbf_gait *gait, sbfi_arm_draft arms[2]) {
  const sbfi_gait_draft *d = &view->draft;
  double highest = -INFINITY, height = view->points.high[1] - view->points.low[1];
  uint32_t count = 0;
  int32_t pair = SBF_NONE;
  if (gait->kind != SBF_GAIT_KIND_WALK || gait->legs.count != 2) return 0;
  count = sbfi_draft_named_arms(d->asset, arms);
  if (count) return count;
  for (uint32_t l = 0; l < view->limb_count; l++) {
    const sbfi_limb_shape *limb = &view->limbs[l];
    double top = (double)sbfi_draft_head(d, limb->root).y;
    uint32_t words = sbfi_words_of(sbfi_draft_bone(d, limb->root)->name);
    bool is_leg = false;
    for (uint32_t k = 0; k < gait->legs.count; k++)
      is_leg = is_leg || sbfi_draft_is_below(d, d->asset->ik_chains.at[gait->legs.at[k].ik].end, limb->root);
    bool named = words >> SBFI_WORD_ARM & 1;
    if (is_leg || limb->twin == SBF_NONE || limb->bones < 2 || words >> SBFI_WORD_WING & 1) continue;
    if (is_of_head(d, gait, limb->root) || (!named && top < view->points.low[1] + 0.35 * height)) continue;
    /* Short limbs belong to clothes. */
    double reach = fmax(limb->high[0] - limb->low[0], limb->high[1] - limb->low[1]);
    if (!named && reach < 0.15 * height) continue;
    double score = reach + (named ? 10 * height : 0);
    if (score <= highest) continue;
    highest = score;
    pair = (int32_t)l;
  }
  if (pair == SBF_NONE) return 0;
  count += choose_arm(view, &view->limbs[pair], &arms[count]);
  count += choose_arm(view, &view->limbs[view->limbs[pair].twin], &arms[count]);
  return count;
}

/* Curls straight fingers that continue the hand towards the palm, which faces down if arms are held out. */
static void curl_fingers(
    const sbfi_rig_view *view, int32_t hand, const double along[3], sbfi_pose_draft *pose) {
  const sbfi_gait_draft *d = &view->draft;
  double length;
  for (uint32_t i = (uint32_t)hand + 1; i < d->asset->bones.count; i++) {
    int32_t bone = (int32_t)i;
    if (sbfi_draft_bone(d, bone)->parent != hand || !d->shapes[i].moves_points) continue;
    for (int joint = 0; joint < 3 && bone != SBF_NONE; joint++) {
      int32_t next = thickest_child(view, bone, &length);
      double from[3], to[3], heading[3];
      if (next == SBF_NONE && joint == 0) break;
      if (next != SBF_NONE) {
        head_of(view, bone, from);
        head_of(view, next, to);
        if (!direction(from, to, heading)) break;
        if (heading[0] * along[0] + heading[1] * along[1] + heading[2] * along[2] < STRAIGHT) break;
      }
      double size = sqrt(along[0] * along[0] + along[2] * along[2]);
      if (!(size > 0.5)) break;
      /* The axis rotates the finger's direction downwards: along x it is (0, -1, 0). */
      const double axis[3] = {along[2] / size, 0, -along[0] / size};
      double rotation[4];
      rotation_about(axis, FINGER[joint] * DEGREE, rotation);
      set_rotation(pose, bone, rotation);
      bone = next;
    }
  }
}

static bool lower_arm(const sbfi_rig_view *view, const sbfi_arm_draft *arm, sbfi_pose_draft *pose) {
  double shoulder[3], elbow[3], wrist[3], upper[3], lower[3], rotation[4], bend[4];
  head_of(view, arm->upper, shoulder);
  head_of(view, arm->lower, elbow);
  if (!direction(shoulder, elbow, upper) || -upper[1] > sin(ENOUGH * DEGREE)) return false;
  if (upper[1] > 0.8) return false; /* raised on purpose */
  const double wanted[3] = {arm->side * cos(DOWN * DEGREE) * cos(AHEAD * DEGREE), -sin(DOWN * DEGREE),
      cos(DOWN * DEGREE) * sin(AHEAD * DEGREE) + sin(AHEAD * DEGREE) * 0.5};
  double zero[3] = {0, 0, 0}, target[3];
  direction(zero, wanted, target);
  sbfi_quatd_between(upper, target, rotation);
  set_rotation(pose, arm->upper, rotation);
  double bent = 0;
  bool has_hand = arm->hand != SBF_NONE;
  if (has_hand) {
    head_of(view, arm->hand, wrist);
    has_hand = direction(elbow, wrist, lower);
  }
  if (has_hand) {
    double cosine = lower[0] * upper[0] + lower[1] * upper[1] + lower[2] * upper[2];
    bent = acos(fmin(1, fmax(-1, cosine))) / DEGREE;
  }
  if (bent < ELBOW) {
    /* The hinge is defined for the hanging arm. Undoing the arm's rotation gives the hinge in the bind
     * pose. */
    double undo[4], axis[3], ahead[3];
    const double hinge[3] = {
        target[0] * target[0] - 1, target[0] * target[1], target[0] * target[2]}; /* -X across the arm */
    direction(zero, hinge, ahead);
    sbfi_quatd_conjugate(rotation, undo);
    sbfi_quatd_rotate(undo, ahead, axis);
    rotation_about(axis, (ELBOW - bent) * DEGREE, bend);
    set_rotation(pose, arm->lower, bend);
  }
  if (has_hand) curl_fingers(view, arm->hand, lower, pose);
  return true;
}

bool sbfi_lower_arms(
    const sbfi_rig_view *view, const sbfi_arm_draft *arms, uint32_t count, sbfi_pose_draft *pose) {
  bool lowered = false;
  for (uint32_t i = 0; i < count; i++) lowered = lower_arm(view, &arms[i], pose) || lowered;
  return lowered;
}
