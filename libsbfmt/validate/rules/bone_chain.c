#include "validate/rules/bone_chain.h"

#include "mechanics/vector.h"

bool sbfi_bone_is_descendant(const sbf_asset *asset, int32_t bone, int32_t above) {
  while (bone >= 0 && bone != above) bone = asset->bones.at[bone].parent;
  return bone >= 0;
}

double sbfi_distance_from_line(const sbf_asset *asset, int32_t root, int32_t end, sbf_vec3 position) {
  sbfi_d3 from = sbfi_d3_of(asset->bones.at[root].head);
  sbfi_d3 along = sbfi_d3_normal(sbfi_d3_sub(sbfi_d3_of(asset->bones.at[end].head), from));
  sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(position), from);
  return sbfi_d3_length(sbfi_d3_sub(displacement, sbfi_d3_scale(along, sbfi_d3_dot(displacement, along))));
}

sbfi_bone_run sbfi_bone_run_of(const sbf_asset *asset, int32_t root, int32_t end) {
  sbfi_bone_run run = {sbfi_bone_is_descendant(asset, end, root), 1, 0, 0, 0};
  const sbf_bone *bones = asset->bones.at;
  if (!run.whole) return run;
  for (int32_t bone = end; bone != root; bone = bones[bone].parent) {
    sbfi_d3 step = sbfi_d3_sub(sbfi_d3_of(bones[bone].head), sbfi_d3_of(bones[bones[bone].parent].head));
    run.reach += sbfi_d3_length(step);
    run.off_line = fmax(run.off_line, sbfi_distance_from_line(asset, root, end, bones[bone].head));
    run.count++;
  }
  run.head_to_end = sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(bones[end].head), sbfi_d3_of(bones[root].head)));
  return run;
}
