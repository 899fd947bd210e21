#include "import/gait/propose_gait.h"
#include "model/options.h"

/* Reserves the asset's ids that a proposed id could collide with. Proposed ids contain their kind, so a
 * collision needs an author who named something else "ik.foot". */
static bool know_ids(sbfi_conversion *c) {
  for (uint32_t i = 0; i < c->asset->bones.count; i++)
    if (!sbfi_claim_id(c, c->asset->bones.at[i].id)) return false;
  for (uint32_t i = 0; i < c->asset->soft_bodies.count; i++)
    if (!sbfi_claim_id(c, c->asset->soft_bodies.at[i].id)) return false;
  for (uint32_t i = 0; i < c->asset->render_meshes.count; i++)
    if (!sbfi_claim_id(c, c->asset->render_meshes.at[i].id)) return false;
  for (uint32_t i = 0; i < c->asset->followers.count; i++)
    if (!sbfi_claim_id(c, c->asset->followers.at[i].id)) return false;
  return true;
}

sbf_status sbf_convert_gait(sbf_asset *asset, const sbf_convert_options *options, sbf_diagnostic *error) {
  sbf_convert_options taken = {.struct_size = 0};
  if (!sbfi_options_copy(&taken, sizeof taken, options))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbf_convert_options has a size that no version of the library had: initialize it with the defaults");
  static const sbfi_scene nowhere = {.file = ""};
  sbfi_conversion c = {.scene = &nowhere,
      .asset = asset,
      .options = &taken,
      .reporter = {taken.report, taken.user, 0, 0},
      .error = error};
  sbfi_arena_init(&c.scratch, taken.allocator, 0);
  sbfi_array_init(&c.ids.slots, taken.allocator, sizeof(char *));
  sbf_status status = know_ids(&c) ? sbfi_evaluate_gait(&c) : sbfi_convert_no_memory(&c);
  if (status == SBF_OK) status = sbfi_propose_gait(&c);
  sbfi_array_free(&c.ids.slots);
  sbfi_arena_free(&c.scratch);
  return status;
}
