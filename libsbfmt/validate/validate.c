/* Runs every rule over an asset. */
#include "sbfmt/validate.h"

#include <string.h>

#include "validate/validation.h"

static sbf_validate_options options_of(const sbf_validate_options *given) {
  sbf_validate_options options = {0};
  size_t size = given && given->struct_size && given->struct_size < sizeof options ? given->struct_size
                                                                                   : sizeof options;
  if (given) memcpy(&options, given, size);
  if (!options.repeats) options.repeats = 8;
  return options;
}

sbf_status sbf_validate(const sbf_asset *asset, const sbf_validate_options *given,
    sbf_validate_result *result, sbf_diagnostic *error) {
  static void (*const families[])(sbfi_validation *) = {sbfi_check_names, sbfi_check_rotations,
      sbfi_check_textures, sbfi_check_sections, sbfi_check_rigid_bodies, sbfi_check_joints, sbfi_check_meshes,
      sbfi_check_render_levels, sbfi_check_skins, sbfi_check_surfaces, sbfi_check_weight_maps,
      sbfi_check_pins, sbfi_check_levels, sbfi_check_lattices, sbfi_check_regions, sbfi_check_springs,
      sbfi_check_colors, sbfi_check_embeddings, sbfi_check_collisions, sbfi_check_cross_springs,
      sbfi_check_ik, sbfi_check_gaits, sbfi_check_chains, sbfi_check_clips, sbfi_check_environment,
      sbfi_check_physics, sbfi_check_derived};
  sbf_validate_result unseen;
  sbf_validate_options options = options_of(given);
  sbfi_validation v = {.asset = asset, .options = &options, .result = result ? result : &unseen};
  v.repeats = options.repeats;
  *v.result = (sbf_validate_result){0};
  for (size_t i = 0; i < sizeof families / sizeof *families && !v.out_of_memory; i++) {
    sbfi_arena_init(&v.scratch, options.allocator, 0);
    families[i](&v);
    sbfi_arena_free(&v.scratch);
  }
  sbfi_report_unlisted(&v);
  if (v.out_of_memory) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while validating");
  return SBF_OK;
}
