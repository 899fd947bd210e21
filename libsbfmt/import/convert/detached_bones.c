/* Bones that were moved by hand: they hold skin and hang on nothing; each goes to the limb that points at
 * its head. */
#include "import/convert/skeleton_draft.h"

/* How often the length of the bone before it a limb's last bone may have. */
static const double LONGEST_TIP = 3;

/* Moved by hand: it holds skin and hangs on nothing, or on a root that holds none. */
static bool is_detached(const sbfi_skeleton_draft *s, uint32_t bone) {
  int32_t parent = s->bones[bone].parent;
  if (!s->bones[bone].points) return false;
  return parent == SBF_NONE || (s->bones[parent].parent == SBF_NONE && !s->bones[parent].points);
}

/* The last bone of a limb of at least two, with skin on it. */
static bool is_tip(const sbfi_skeleton_draft *s, uint32_t bone) {
  const sbfi_bone_draft *b = &s->bones[bone];
  return b->next == SBF_NONE && b->points && b->parent != SBF_NONE && s->bones[b->parent].parent != SBF_NONE;
}

static bool hangs_below(const sbfi_skeleton_draft *s, int32_t bone, int32_t above) {
  while (bone != above && bone != SBF_NONE) bone = s->bones[bone].parent;
  return bone == above;
}

/* The limb whose last bone points at the head of `bone` and is nearest to it; SBF_NONE where there is none.
 */
static int32_t find_limb(const sbfi_skeleton_draft *s, uint32_t bone) {
  int32_t best = SBF_NONE;
  double nearest = 0;
  for (uint32_t i = 0; i < s->count; i++) {
    if (!is_tip(s, i) || hangs_below(s, (int32_t)i, (int32_t)bone)) continue;
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

bool sbfi_hang_on_limbs(sbfi_skeleton_draft *s, int32_t *limbs) {
  bool moved = false;
  /* All are found before any is moved, so that their order does not matter. Where bones do not run along +Y
   * the last one of a limb does not say where it points. */
  for (uint32_t i = 0; i < s->count; i++) {
    limbs[i] = s->bones[i].neighbor;
    if (limbs[i] == SBF_NONE && s->along_y && is_detached(s, i)) limbs[i] = find_limb(s, i);
  }
  for (uint32_t i = 0; i < s->count; i++) {
    if (limbs[i] != SBF_NONE && hangs_below(s, limbs[i], (int32_t)i)) limbs[i] = SBF_NONE;
    if (limbs[i] == SBF_NONE) continue;
    s->bones[i].parent = limbs[i];
    moved = true;
  }
  return moved;
}

sbf_status sbfi_hang_detached(sbfi_conversion *c, sbfi_skeleton_draft *s) {
  if (!sbfi_find_neighbors(c, s)) return sbfi_convert_no_memory(c);
  int32_t *limbs = sbfi_arena_allocate(&c->scratch, s->count, sizeof *limbs);
  if (!limbs) return sbfi_convert_no_memory(c);
  if (!sbfi_hang_on_limbs(s, limbs)) return SBF_OK;
  for (uint32_t i = 0; i < s->count; i++) {
    if (limbs[i] == SBF_NONE) continue;
    sbfi_convert_warn(c, SBF_CODE_RIG_BONE_REHUNG,
        "bone '%s' belongs where '%s' ends but hangs on the root, to be moved by hand: it now hangs on '%s'",
        c->rig->nodes[s->bones[i].node].name, c->rig->nodes[s->bones[limbs[i]].node].name,
        c->rig->nodes[s->bones[limbs[i]].node].name);
  }
  sbfi_draft_continue(s);
  return SBF_OK;
}
