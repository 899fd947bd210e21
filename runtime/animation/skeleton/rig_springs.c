#include "animation/skeleton/rig_springs.h"

#include "animation/skeleton/rig_tails.h"
#include "math/quat.h"

size_t sbri_rig_springs_size(const sbf_asset *asset) {
  return asset->chain_colliders.count * sizeof(sbri_chain_shape) +
         asset->chains.count * sizeof(sbri_bone_chain);
}

static sbri_chain_shape shape_of(const sbri_rig *rig, const sbf_chain_collider *from) {
  const sbr_transform *rest = &rig->bones.rest[from->bone];
  sbf_quat back = sbri_quat_conjugate(rest->rotation);
  return (sbri_chain_shape){.source = from,
      .position = sbri_rotate(back, sbri_sub(from->position, rest->position)),
      .axis = sbri_rotate(back, sbri_sub(from->end, from->position)),
      .normal = sbri_rotate(back, sbri_normalize(from->normal, sbri_vec3(0, 1, 0)))};
}

/* Chains on other chains come after them, because a bone's index is above its ancestors'. */
static void insert(sbri_bone_chain *chains, uint32_t count, sbri_bone_chain chain) {
  uint32_t at = count;
  for (; at > 0 && chains[at - 1].source->bones.at[0] > chain.source->bones.at[0]; at--)
    chains[at] = chains[at - 1];
  chains[at] = chain;
}

void sbri_rig_find_springs(sbri_rig *rig, void *memory) {
  const sbf_asset *asset = rig->asset;
  sbri_chain_shape *shapes = memory;
  sbri_bone_chain *chains = (sbri_bone_chain *)(void *)(shapes + asset->chain_colliders.count);
  rig->springs = (sbri_rig_springs){.chains = {.at = chains}, .shapes = shapes};
  for (uint32_t i = 0; i < asset->chain_colliders.count; i++)
    shapes[i] = shape_of(rig, &asset->chain_colliders.at[i]);
  for (uint32_t i = 0; i < asset->chains.count; i++) {
    const sbf_chain *source = &asset->chains.at[i];
    if (!source->spring || source->bones.count == 0 || sbri_rig_moves_as_tail(rig, i)) continue;
    insert(chains, rig->springs.chains.count++, (sbri_bone_chain){source, 0});
  }
  for (uint32_t i = 0; i < rig->springs.chains.count; i++) {
    chains[i].first_state = rig->springs.chains.bone_count;
    rig->springs.chains.bone_count += chains[i].source->bones.count;
  }
}
