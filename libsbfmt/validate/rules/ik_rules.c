/* Checks IK chains: a descendant as end, positive length, a bend, comfort ranges inside limits. */
#include "validate/rules/bone_chain.h"
#include "validate/validation.h"

static const double STRAIGHT = 1e-3; /* fraction of the reach */

static void check_bend(
    sbfi_validation *v, const sbf_ik_chain *chain, const sbfi_bone_run *run, const char *path) {
  const char *name = sbfi_label(chain->name, chain->id);
  double pole = sbfi_distance_from_line(v->asset, chain->root, chain->end, chain->pole);
  if (chain->has_pole && pole < STRAIGHT * run->reach)
    sbfi_found(v, SBF_CODE_IK_NO_BEND, path, -1,
        "the pole of chain '%s' lies on the line from its root to its end", name);
  if (!chain->has_pole && run->off_line < STRAIGHT * run->reach)
    sbfi_found(v, SBF_CODE_IK_NO_BEND, path, -1, "chain '%s' is straight at rest and has no pole", name);
}

static void check_chain(sbfi_validation *v, const sbf_ik_chain *chain, const char *path) {
  const char *name = sbfi_label(chain->name, chain->id);
  const char *root = sbfi_bone_label(v->asset, (uint32_t)chain->root);
  const char *end = sbfi_bone_label(v->asset, (uint32_t)chain->end);
  sbfi_bone_run run = sbfi_bone_run_of(v->asset, chain->root, chain->end);
  if (!run.whole) {
    sbfi_found(v, SBF_CODE_IK_CHAIN_BROKEN, path, -1, "the end '%s' of chain '%s' is not below its root '%s'",
        end, name, root);
    return;
  }
  bool two_bone = chain->solver == SBF_IK_SOLVER_TWO_BONE;
  if (two_bone && run.count != 3)
    sbfi_found(v, SBF_CODE_IK_BONE_COUNT, path, -1, "chain '%s' has %u bone%s from '%s' to '%s' instead of 3",
        name, run.count, sbfi_plural(run.count), root, end);
  if (run.reach == 0)
    sbfi_found(
        v, SBF_CODE_IK_NO_REACH, path, -1, "the bones of chain '%s' have their heads at one position", name);
  else if (two_bone && run.count == 3)
    check_bend(v, chain, &run, path);
  for (uint32_t c = 0; c < chain->comforts.count; c++) {
    int32_t bone = chain->comforts.at[c].bone;
    if (!sbfi_bone_is_descendant(v->asset, bone, chain->root) ||
        !sbfi_bone_is_descendant(v->asset, chain->end, bone))
      sbfi_found(v, SBF_CODE_IK_COMFORT_OUTSIDE, sbfi_path_of("%s/comfort[%u]", path, c + 1).text, -1,
          "a comfort of chain '%s' names the bone '%s'", name, sbfi_bone_label(v->asset, (uint32_t)bone));
  }
}

void sbfi_check_ik(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->ik_chains.count; i++)
    check_chain(v, &v->asset->ik_chains.at[i], sbfi_path_of("/sbf/ik/ik_chain[%u]", i + 1).text);
}
