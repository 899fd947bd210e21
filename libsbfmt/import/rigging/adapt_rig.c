/* Fits a rig that states neither unit nor axes, as motion capture, to the input instead of the reverse. */
#include <math.h>

#include "import/rigging/align.h"
#include "import/rigging/moved_bones.h"

static const double SAME_SCALE = 1e-9;

/* The input's unit is used: scales the rig. */
static void scale_rig(sbfi_rigging *r) {
  double factor = sbfi_similarity_scale(&r->c->to_asset) / sbfi_similarity_scale(&r->alignment.to_asset);
  if (fabs(factor - 1) < SAME_SCALE) return;
  for (uint32_t b = 0; b < r->c->asset->bones.count; b++) {
    sbf_bone *bone = (sbf_bone *)(uintptr_t)&r->c->asset->bones.at[b]; /* the conversion owns the asset */
    bone->head = sbfi_d3_rounded(sbfi_d3_scale(sbfi_d3_of(bone->head), factor));
    bone->length = (float)((double)bone->length * factor);
  }
  sbfi_matrix *const matrices[] = {&r->c->rig_to_asset, &r->alignment.to_asset};
  for (int i = 0; i < 2; i++)
    for (int row = 0; row < 3; row++)
      for (int k = 0; k < 4; k++) matrices[i]->at[row][k] *= factor;
  sbfi_convert_warn(r->c, SBF_CODE_RIG_ALIGNED,
      "%s states no unit: it was scaled by %.6g, so that its bones are inside the input", r->rig.scene->file,
      factor);
}

static sbfi_matrix rotation_of(const sbfi_matrix *m) {
  return sbfi_similarity_scaled(m, 1, (sbfi_d3){0, 0, 0});
}

/* Blender writes motion capture with the axes of its scene or armature, so that the rig lies or stands on
 * its head. The rig's up is right if it is +Y of the input, or +Z, which some programs write. */
static void stand_rig(sbfi_rigging *r) {
  sbfi_matrix aligned = rotation_of(&r->alignment.to_asset), stated = rotation_of(&r->c->to_asset), back;
  if (!sbfi_matrix_invert(&aligned, &back)) return;
  sbfi_matrix turn = sbfi_matrix_multiply(&stated, &back);
  bool is_upright = false; /* `turn` takes the rig's axes to the input's */
  for (int k = 0; k < 3; k++) is_upright |= turn.at[k][1] > 0.9;
  if (is_upright || !sbfi_matrix_invert(&turn, &back)) return;
  sbfi_similarity_text text = sbfi_similarity_describe(&turn, r->input.size);
  sbfi_rig_turn(r, &turn);
  sbfi_convert_warn(r->c, SBF_CODE_RIG_ALIGNED,
      "%s states no axes, and its up is not that of the input: the rig was %s; if the character then lies or "
      "stands on its head, rotate both upright in their program",
      r->rig.scene->file, text.at);
}

void sbfi_adapt_rig(sbfi_rigging *r) {
  if (!sbfi_rig_has_no_size(r)) return;
  scale_rig(r);
  if (!r->rig.scene->axes_known) stand_rig(r);
}
