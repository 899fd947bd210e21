/* Corrects rigs whose legs cannot be found: feet that hang on the root, and rigs that face sideways. */
#include <math.h>
#include <string.h>

#include "import/convert/skeleton_draft.h"
#include "import/gait/gait_draft.h"
#include "model/options.h"
#include "motion/quatd.h"

/* Bones in the form that the pass for detached bones needs. */
static bool find_hangings(const sbfi_gait_draft *d, sbfi_arena *scratch, int32_t *hangs_on) {
  const sbf_bone_list *bones = &d->asset->bones;
  sbfi_skeleton_draft s = {sbfi_arena_allocate(scratch, bones->count, sizeof *s.bones), bones->count, false};
  if (!s.bones) return false;
  for (uint32_t i = 0; i < s.count; i++) {
    const sbf_bone *bone = &bones->at[i];
    const double rotation[4] = {(double)bone->rotation.x, (double)bone->rotation.y, (double)bone->rotation.z,
        (double)bone->rotation.w};
    double along[3];
    sbfi_quatd_rotate(rotation, (const double[3]){0, 1, 0}, along);
    s.bones[i] = (sbfi_bone_draft){.parent = bone->parent,
        .head = sbfi_d3_of(bone->head),
        .y = {along[0], along[1], along[2]},
        .next = SBF_NONE,
        .neighbor = SBF_NONE,
        .points = d->shapes[i].points};
  }
  sbfi_draft_continue(&s);
  s.along_y = true; /* true for all bones of an asset */
  sbfi_reparent_to_limbs(&s, hangs_on);
  return true;
}

static bool find_stance(
    const sbf_asset *asset, sbfi_arena *scratch, sbf_convert_stance *stance, int32_t *hangs_on) {
  sbfi_gait_draft d = {.asset = (sbf_asset *)(uintptr_t)asset}; /* not modified here */
  if (!sbfi_draft_facing(asset, scratch, &d.turns) || !sbfi_draft_shapes(&d, scratch)) return false;
  if (!sbfi_draft_legs(&d, scratch) || !find_hangings(&d, scratch, hangs_on)) return false;
  stance->quarter_turns = d.turns;
  stance->height_m = d.height;
  double lowest = INFINITY;
  for (uint32_t l = 0; l < d.leg_count; l++) lowest = fmin(lowest, d.shapes[d.legs[l].limb].low_below);
  stance->ground_m = isfinite(lowest) ? lowest : 0;
  return true;
}

sbf_status sbf_convert_stand(const sbf_asset *asset, const sbf_convert_options *options,
    sbf_convert_stance *stance, int32_t *hangs_on, sbf_diagnostic *error) {
  sbf_convert_options taken = {.struct_size = 0};
  if (!sbfi_options_copy(&taken, sizeof taken, options))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbf_convert_options has a size that no version of the library had: initialize it with the defaults");
  sbf_convert_stance found = {.struct_size = stance->struct_size ? stance->struct_size : sizeof found};
  if (found.struct_size != sizeof found)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbf_convert_stance has a size that no version of the library had: set its size member");
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, taken.allocator, 0);
  bool good = asset->bones.count == 0 || find_stance(asset, &scratch, &found, hangs_on);
  sbfi_arena_free(&scratch);
  if (!good) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while looking for legs");
  *stance = found;
  return SBF_OK;
}
