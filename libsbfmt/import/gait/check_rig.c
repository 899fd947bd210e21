/* Reports rigs that the gait does not move as their author expects: a second character in the file, and one
 * that lies or stands on its head. */
#include <math.h>

#include "import/convert/conversion.h"
#include "import/gait/locomotion.h"
#include "import/gait/propose_gait.h"
#include "mechanics/vector.h"

/* --- Several characters -------------------------------------------------------------------------------- */

enum { MIN_DEFORMING = 5 };               /* bones with points; props and helpers have fewer */
static const double OTHER_FRACTION = 0.5; /* of the bones with points of the character that moves */

sbf_status sbfi_report_other_skeletons(sbfi_conversion *c) {
  const sbf_bone_list *bones = &c->asset->bones;
  sbfi_rig_view view;
  if (c->asset->gaits.count != 1 || !c->asset->gaits.at[0].proposed) return SBF_OK;
  uint32_t *root_of = sbfi_arena_allocate(&c->scratch, bones->count, sizeof *root_of);
  uint32_t *deforming_bones = sbfi_arena_allocate(&c->scratch, bones->count, sizeof *deforming_bones);
  if (!root_of || !deforming_bones || !sbfi_view_rig(&view, c->asset, 0, &c->scratch))
    return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < bones->count; i++) {
    int32_t parent = bones->at[i].parent;
    root_of[i] = parent == SBF_NONE ? i : root_of[parent];
    deforming_bones[root_of[i]] += view.holds[i] > 0;
  }
  uint32_t moved = root_of[c->asset->gaits.at[0].body];
  for (uint32_t i = 0; i < bones->count; i++)
    if (i != moved && deforming_bones[i] >= MIN_DEFORMING &&
        deforming_bones[i] >= OTHER_FRACTION * deforming_bones[moved])
      sbfi_convert_warn(c, SBF_CODE_RIG_OTHER_SKELETON,
          "the gait moves only the skeleton of '%s', and the skeleton of '%s' with %u bones stands still: if "
          "it is another character, export each to its own file",
          bones->at[moved].name, bones->at[i].name, deforming_bones[i]);
  return SBF_OK;
}

/* --- Up ------------------------------------------------------------------------------------------------ */

/* Least lengths of mean directions, where each leg counts 1: of legs, and of two legs against the head. */
static const double LEGS_AGREE = 0.85, HEAD_OPPOSITE = 0.7;

static bool is_named(const sbf_bone *bone, sbfi_word word) {
  return sbfi_words_of(bone->name) >> word & 1;
}

/* From the head of a leg's first bone to the farthest head below it; 0 if it is a single bone. */
static sbfi_d3 leg_direction(const sbf_asset *a, uint32_t first) {
  sbfi_d3 from = sbfi_d3_of(a->bones.at[first].head), best = {0, 0, 0};
  const sbfi_gait_draft d = {.asset = (sbf_asset *)(uintptr_t)a}; /* not modified here */
  for (uint32_t i = first + 1; i < a->bones.count; i++) {
    if (!sbfi_draft_is_below(&d, (int32_t)i, (int32_t)first)) continue;
    sbfi_d3 to = sbfi_d3_sub(sbfi_d3_of(a->bones.at[i].head), from);
    if (sbfi_d3_length(to) > sbfi_d3_length(best)) best = to;
  }
  return sbfi_d3_normal(best);
}

typedef struct posture {
  sbfi_d3 legs; /* mean direction */
  sbfi_d3 hips; /* mean of the legs' first joints */
  uint32_t leg_count;
} posture;

static posture find_posture(const sbf_asset *a) {
  posture p = {.leg_count = 0};
  for (uint32_t i = 0; i < a->bones.count; i++) {
    const sbf_bone *bone = &a->bones.at[i];
    bool first = bone->parent == SBF_NONE || !is_named(&a->bones.at[bone->parent], SBFI_WORD_LEG);
    if (!first || !is_named(bone, SBFI_WORD_LEG)) continue;
    sbfi_d3 along = leg_direction(a, i);
    if (sbfi_d3_length(along) == 0) continue;
    p.legs = sbfi_d3_add(p.legs, along);
    p.hips = sbfi_d3_add(p.hips, sbfi_d3_of(bone->head));
    p.leg_count++;
  }
  if (p.leg_count) {
    p.legs = sbfi_d3_scale(p.legs, 1.0 / p.leg_count);
    p.hips = sbfi_d3_scale(p.hips, 1.0 / p.leg_count);
  }
  return p;
}

/* Whether the head is where the legs do not point: someone who sits has them forwards. */
static bool is_head_opposite(const sbf_asset *a, const posture *p) {
  for (uint32_t i = 0; i < a->bones.count; i++) {
    if (!is_named(&a->bones.at[i], SBFI_WORD_HEAD)) continue;
    sbfi_d3 to_head = sbfi_d3_normal(sbfi_d3_sub(sbfi_d3_of(a->bones.at[i].head), p->hips));
    return sbfi_d3_dot(to_head, p->legs) < -HEAD_OPPOSITE * sbfi_d3_length(p->legs);
  }
  return false;
}

/* Axis that points most along a direction: 0, 2, 4 for x, y, z, and one more for its opposite. */
static int axis_of(sbfi_d3 v) {
  const double at[3] = {v.x, v.y, v.z};
  int k = 0;
  for (int i = 1; i < 3; i++)
    if (fabs(at[i]) > fabs(at[k])) k = i;
  return 2 * k + (at[k] < 0);
}

/* Axis of the file that the rig has upwards. */
static int file_axis(const sbfi_conversion *c, sbfi_d3 up) {
  const double(*m)[4] = c->to_asset.at; /* its columns are the file's axes, equally scaled */
  return axis_of((sbfi_d3){m[0][0] * up.x + m[1][0] * up.y + m[2][0] * up.z,
      m[0][1] * up.x + m[1][1] * up.y + m[2][1] * up.z, m[0][2] * up.x + m[1][2] * up.y + m[2][2] * up.z});
}

sbf_status sbfi_report_lying(sbfi_conversion *c) {
  static const char *const axes[] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
  enum { UP_Y = 2, DOWN = 3, UP_Z = 4, BIPED_LEGS = 2 };
  const posture p = find_posture(c->asset);
  if (c->locomotion && c->locomotion->kind == SBFI_LOCOMOTION_FLY) return SBF_OK; /* legs trail behind */
  if (p.leg_count < BIPED_LEGS || sbfi_d3_length(p.legs) < LEGS_AGREE) return SBF_OK;
  int legs = axis_of(p.legs);
  if (legs == DOWN || (p.leg_count == BIPED_LEGS && !is_head_opposite(c->asset, &p))) return SBF_OK;
  int up = file_axis(c, sbfi_d3_scale(p.legs, -1));
  bool helps = c->rig == c->scene && (up == UP_Y || up == UP_Z);
  sbfi_convert_warn(c, SBF_CODE_RIG_LIES, "its legs point along %s instead of down, as if it %s: %s%s",
      axes[legs], legs == UP_Y ? "stood on its head" : "lay",
      helps ? "stand it up with --up " : "rotate it upright in its program and export it again",
      !helps       ? ""
      : up == UP_Y ? "y"
                   : "z");
  return SBF_OK;
}
