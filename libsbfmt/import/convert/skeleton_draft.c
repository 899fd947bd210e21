#include "import/convert/skeleton_draft.h"

bool sbfi_bone_runs_straight(const sbfi_bone_draft *bone) {
  return sbfi_d3_dot(sbfi_d3_normal(bone->y), sbfi_d3_normal(bone->along)) > SBFI_STRAIGHT;
}

/* Whether `bone` continues its parent better than the current choice. A straight bone wins, then the
 * nearer; if neither is straight, the one with more descendants. */
static bool continues_better(const sbfi_skeleton_draft *s, uint32_t bone) {
  sbfi_bone_draft *parent = &s->bones[s->bones[bone].parent], with = *parent;
  with.along = sbfi_d3_sub(s->bones[bone].head, parent->head);
  double length = sbfi_d3_length(with.along);
  if (length < 1e-9) return false;
  if (parent->next == SBF_NONE) return true;
  bool straight = sbfi_bone_runs_straight(&with), was_straight = sbfi_bone_runs_straight(parent);
  if (straight != was_straight) return straight;
  if (straight) return length < sbfi_d3_length(parent->along);
  return s->bones[bone].below > s->bones[parent->next].below;
}

void sbfi_draft_continue(sbfi_skeleton_draft *s) {
  for (uint32_t i = 0; i < s->count; i++) {
    s->bones[i].below = 0;
    s->bones[i].next = SBF_NONE;
    s->bones[i].along = (sbfi_d3){0, 0, 0};
  }
  for (uint32_t i = 0; i < s->count; i++) /* parents may come later: bones may have been reattached */
    for (int32_t above = s->bones[i].parent; above != SBF_NONE; above = s->bones[above].parent)
      s->bones[above].below++;
  uint32_t straight = 0, continued = 0;
  for (uint32_t i = 0; i < s->count; i++) {
    if (s->bones[i].parent == SBF_NONE || !continues_better(s, i)) continue;
    sbfi_bone_draft *parent = &s->bones[s->bones[i].parent];
    parent->next = (int32_t)i;
    parent->along = sbfi_d3_sub(s->bones[i].head, parent->head);
  }
  for (uint32_t i = 0; i < s->count; i++) {
    if (s->bones[i].next == SBF_NONE) continue;
    continued++;
    straight += sbfi_bone_runs_straight(&s->bones[i]);
  }
  s->along_y = 5 * (uint64_t)straight >= 3 * (uint64_t)continued;
}
