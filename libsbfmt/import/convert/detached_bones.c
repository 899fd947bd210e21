/* Animators move some bones directly: these have skin weights but no parent. Each is attached to the limb
 * that points at its head. */
#include "import/convert/skeleton_draft.h"
#include "model/bone_ends.h"

#include <math.h>
#include <string.h>

/* Limits of the length of a limb's last bone, as multiples of the bone before it. A shorter one is a
 * target at the limb's end. */
static const double LONGEST_TIP = 3, SHORTEST_TIP = 0.1;
/* Minimum cosine of the angle between a limb and its continuation. */
static const double AHEAD = 0.3;
/* Maximum number of root nodes above a detached foot: the file's, the armature's and the rig's. */
enum { MAX_FRAMES = 3 };

/* A detached bone has skin weights and no parent, or only a root without weights. */
static bool is_detached(const sbfi_skeleton_draft *s, uint32_t bone) {
  int32_t parent = s->bones[bone].parent;
  if (!s->bones[bone].points) return false;
  return parent == SBF_NONE || (s->bones[parent].parent == SBF_NONE && !s->bones[parent].points);
}

/* Whether the bone is the last of a limb of at least two bones and has skin weights. */
static bool is_tip(const sbfi_skeleton_draft *s, uint32_t bone) {
  const sbfi_bone_draft *b = &s->bones[bone];
  return b->next == SBF_NONE && b->points && b->parent != SBF_NONE && s->bones[b->parent].parent != SBF_NONE;
}

static bool is_descendant(const sbfi_skeleton_draft *s, int32_t bone, int32_t above) {
  while (bone != above && bone != SBF_NONE) bone = s->bones[bone].parent;
  return bone == above;
}

/* Limb whose last bone points at the head of `bone` and is nearest to it; SBF_NONE if there is none. */
static int32_t find_limb(const sbfi_skeleton_draft *s, uint32_t bone) {
  int32_t best = SBF_NONE;
  double nearest = 0;
  for (uint32_t i = 0; i < s->count; i++) {
    if (!is_tip(s, i) || is_descendant(s, (int32_t)i, (int32_t)bone)) continue;
    const sbfi_bone_draft *tip = &s->bones[i];
    sbfi_d3 displacement = sbfi_d3_sub(s->bones[bone].head, tip->head);
    double length = sbfi_d3_length(displacement);
    double before = sbfi_d3_length(sbfi_d3_sub(tip->head, s->bones[tip->parent].head));
    if (sbfi_d3_dot(sbfi_d3_normal(displacement), sbfi_d3_normal(tip->y)) <= SBFI_STRAIGHT) continue;
    if (length > LONGEST_TIP * before || (best != SBF_NONE && length >= nearest)) continue;
    best = (int32_t)i;
    nearest = length;
  }
  return best;
}

/* --- Rigs without a skin ------------------------------------------------------------------------------- */

static bool is_end(const sbfi_skeleton_draft *s, const sbfi_scene *rig, uint32_t bone) {
  const char *name = rig->nodes[s->bones[bone].node].name;
  return s->bones[bone].below == 0 && sbfi_name_is_end(name, strlen(name));
}

/* Number of descendants, without end markers. */
static uint32_t count_below(const sbfi_skeleton_draft *s, const sbfi_scene *rig, uint32_t bone) {
  uint32_t count = s->bones[bone].below;
  for (uint32_t i = 0; i < s->count; i++)
    count -= i != bone && is_descendant(s, (int32_t)i, (int32_t)bone) && is_end(s, rig, i);
  return count;
}

/* Whether only roots and frames are above the bone, and at most a toe below it. */
static bool is_loose(const sbfi_skeleton_draft *s, const sbfi_scene *rig, uint32_t bone) {
  int depth = 0;
  for (int32_t above = s->bones[bone].parent; above != SBF_NONE; above = s->bones[above].parent) depth++;
  return depth <= MAX_FRAMES && !is_end(s, rig, bone) && count_below(s, rig, bone) <= 1;
}

/* Whether the bone is the last of a limb of at least two bones below another bone. */
static bool ends_limb(const sbfi_skeleton_draft *s, const sbfi_scene *rig, uint32_t bone) {
  int32_t parent = s->bones[bone].parent;
  if (parent == SBF_NONE || is_end(s, rig, bone) || count_below(s, rig, bone)) return false;
  return s->bones[parent].parent != SBF_NONE && count_below(s, rig, (uint32_t)parent) == 1;
}

/* Factor on the distance of a loose bone at which the limb's last bone does not point. */
static const double NOT_POINTED_AT = 4;

static bool points_along(sbfi_d3 axis, sbfi_d3 direction) {
  return sbfi_d3_dot(direction, sbfi_d3_normal(axis)) > SBFI_STRAIGHT;
}

/* Distance from the head of a limb's last bone to a loose bone that may continue it; INFINITY if it cannot.
 * The limb must point at the loose bone by its end or its +Y, or, if not all bones run along +Y, continue
 * downwards to it; on a root, which may be a frame, by its end alone. Importers rotate the axes of some
 * bones, so a loose bone that one axis points at is preferred. */
static double reach_of_limb(const sbfi_skeleton_draft *s, uint32_t tip, uint32_t loose) {
  const sbfi_bone_draft *last = &s->bones[tip];
  int32_t old_parent = s->bones[loose].parent, limb = s->bones[last->parent].parent;
  if (old_parent == limb || (old_parent != SBF_NONE && !is_descendant(s, limb, old_parent))) return INFINITY;
  sbfi_d3 displacement = sbfi_d3_sub(s->bones[loose].head, last->head);
  sbfi_d3 before = sbfi_d3_sub(last->head, s->bones[last->parent].head);
  sbfi_d3 direction = sbfi_d3_normal(displacement);
  double length = sbfi_d3_length(displacement), length_before = sbfi_d3_length(before);
  bool ends_there = points_along(last->tip, direction), on_root = s->bones[limb].parent == SBF_NONE;
  bool points = ends_there || points_along(last->y, direction);
  bool continues =
      !s->along_y && displacement.y < 0 && sbfi_d3_dot(direction, sbfi_d3_normal(before)) > AHEAD;
  if ((!points && !continues) || (on_root && !ends_there) || length < SHORTEST_TIP * length_before ||
      length > LONGEST_TIP * length_before)
    return INFINITY;
  return points ? length : NOT_POINTED_AT * length;
}

/* Pairs loose bones with the last bones of limbs where each is the nearest candidate of the other. */
static void find_limbs_without_skin(const sbfi_skeleton_draft *s, const sbfi_scene *rig, int32_t *limbs) {
  for (uint32_t i = 0; i < s->count; i++) limbs[i] = SBF_NONE;
  for (uint32_t tip = 0; tip < s->count; tip++) {
    double nearest = INFINITY, others = INFINITY;
    uint32_t best = 0;
    if (!ends_limb(s, rig, tip)) continue;
    for (uint32_t i = 0; i < s->count; i++) {
      double reach = i != tip && is_loose(s, rig, i) ? reach_of_limb(s, tip, i) : INFINITY;
      if (reach < nearest) nearest = reach, best = i;
    }
    for (uint32_t i = 0; i < s->count && isfinite(nearest); i++)
      if (i != tip && ends_limb(s, rig, i)) others = fmin(others, reach_of_limb(s, i, best));
    if (isfinite(nearest) && nearest <= others) limbs[best] = (int32_t)tip;
  }
}

static void find_neighbors_without_skin(sbfi_skeleton_draft *s, const sbfi_scene *rig, int32_t *limbs) {
  find_limbs_without_skin(s, rig, limbs);
  for (uint32_t i = 0; i < s->count; i++) s->bones[i].neighbor = limbs[i];
}

/* --- All of them --------------------------------------------------------------------------------------- */

bool sbfi_reparent_to_limbs(sbfi_skeleton_draft *s, int32_t *limbs) {
  bool moved = false;
  /* Finds all limbs before moving any bone, so that the result does not depend on the order. If bones do
   * not run along +Y, the last bone of a limb has no known direction. */
  for (uint32_t i = 0; i < s->count; i++) {
    limbs[i] = s->bones[i].neighbor;
    if (limbs[i] == SBF_NONE && s->along_y && is_detached(s, i)) limbs[i] = find_limb(s, i);
  }
  for (uint32_t i = 0; i < s->count; i++) {
    if (limbs[i] != SBF_NONE && is_descendant(s, limbs[i], (int32_t)i)) limbs[i] = SBF_NONE;
    if (limbs[i] == SBF_NONE) continue;
    s->bones[i].parent = limbs[i];
    moved = true;
  }
  return moved;
}

sbf_status sbfi_reparent_detached_bones(sbfi_conversion *c, sbfi_skeleton_draft *s) {
  if (!sbfi_find_neighbors(c, s)) return sbfi_convert_no_memory(c);
  int32_t *limbs = sbfi_arena_allocate(&c->scratch, s->count, sizeof *limbs);
  if (!limbs) return sbfi_convert_no_memory(c);
  if (c->rig->mesh_count == 0) find_neighbors_without_skin(s, c->rig, limbs);
  if (!sbfi_reparent_to_limbs(s, limbs)) return SBF_OK;
  for (uint32_t i = 0; i < s->count; i++) {
    if (limbs[i] == SBF_NONE) continue;
    sbfi_convert_warn(c, SBF_CODE_RIG_BONE_REHUNG,
        "bone '%s' is at the end of '%s' but is a child of the root, as a hand-moved control is: it is now a "
        "child of '%s'",
        c->rig->nodes[s->bones[i].node].name, c->rig->nodes[s->bones[limbs[i]].node].name,
        c->rig->nodes[s->bones[limbs[i]].node].name);
  }
  sbfi_draft_continue(s);
  return SBF_OK;
}
