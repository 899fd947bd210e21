#include "build/sections/section_sole.h"

#include <math.h>

static const float BAND = 0.12f; /* fraction of a foot's height: its sole */

/* End bone of a leg that is the bone or its ancestor; SBF_NONE if there is none. */
static int32_t foot_of(const sbf_asset *asset, int32_t bone) {
  for (; bone >= 0; bone = asset->bones.at[bone].parent)
    for (uint32_t g = 0; g < asset->gaits.count; g++)
      for (uint32_t l = 0; l < asset->gaits.at[g].legs.count; l++) {
        int32_t chain = asset->gaits.at[g].legs.at[l].ik;
        if (chain >= 0 && asset->ik_chains.at[chain].end == bone) return bone;
      }
  return SBF_NONE;
}

/* Fraction of a point's weights on a foot and its descendants. */
static float pinned_by(const sbfi_skin_union *skin, const int32_t *feet, uint32_t point, int32_t foot) {
  float sum = 0;
  for (uint32_t h = skin->bone_weight_begins[point]; h < skin->bone_weight_begins[point + 1]; h++)
    if (feet[skin->bone_weights[h].bone] == foot) sum += skin->bone_weights[h].weight;
  return sum;
}

/* Copies a point's weights of a foot to `bone_weights`. Returns the next free index. */
static uint32_t copy_own_weights(const sbfi_skin_union *skin, const int32_t *feet, uint32_t point,
    int32_t foot, sbfi_bone_weight *bone_weights, uint32_t next) {
  float sum = pinned_by(skin, feet, point, foot);
  for (uint32_t h = skin->bone_weight_begins[point]; h < skin->bone_weight_begins[point + 1]; h++)
    if (feet[skin->bone_weights[h].bone] == foot)
      bone_weights[next++] =
          (sbfi_bone_weight){skin->bone_weights[h].bone, skin->bone_weights[h].weight / sum};
  return next;
}

bool sbfi_soles_gather(sbfi_skin_union *skin, const sbf_asset *asset, uint8_t *soles, sbfi_arena *arena) {
  uint32_t points = skin->mesh.positions.count, bones = asset->bones.count, next = 0;
  int32_t *feet = sbfi_arena_allocate(arena, (size_t)bones + 1, sizeof *feet);
  int32_t *foot_of_point = sbfi_arena_allocate(arena, (size_t)points + 1, sizeof *foot_of_point);
  float(*range)[2] = sbfi_arena_allocate(arena, (size_t)bones + 1, sizeof *range);
  uint32_t *begins = sbfi_arena_allocate(arena, (size_t)points + 1, sizeof *begins);
  sbfi_bone_weight *bone_weights =
      sbfi_arena_allocate(arena, (size_t)skin->bone_weight_begins[points] + 1, sizeof *bone_weights);
  if (!feet || !foot_of_point || !range || !begins || !bone_weights) return false;
  for (uint32_t b = 0; b < bones; b++) {
    feet[b] = foot_of(asset, (int32_t)b);
    range[b][0] = INFINITY, range[b][1] = -INFINITY;
  }
  for (uint32_t p = 0; p < points; p++) {
    foot_of_point[p] = SBF_NONE;
    for (uint32_t h = skin->bone_weight_begins[p]; h < skin->bone_weight_begins[p + 1]; h++) {
      int32_t foot = feet[skin->bone_weights[h].bone];
      if (foot != SBF_NONE && pinned_by(skin, feet, p, foot) > 0.5f) foot_of_point[p] = foot;
    }
    if (foot_of_point[p] == SBF_NONE) continue;
    float *low = &range[foot_of_point[p]][0], *high = &range[foot_of_point[p]][1];
    *low = fminf(*low, skin->mesh.positions.at[p].y);
    *high = fmaxf(*high, skin->mesh.positions.at[p].y);
  }
  for (uint32_t p = 0; p < points; p++) {
    int32_t foot = foot_of_point[p];
    begins[p] = next;
    if (foot != SBF_NONE)
      soles[p] = skin->mesh.positions.at[p].y <= range[foot][0] + BAND * (range[foot][1] - range[foot][0]);
    if (soles[p])
      next = copy_own_weights(skin, feet, p, foot, bone_weights, next);
    else
      for (uint32_t h = skin->bone_weight_begins[p]; h < skin->bone_weight_begins[p + 1]; h++)
        bone_weights[next++] = skin->bone_weights[h];
  }
  begins[points] = next;
  skin->bone_weight_begins = begins;
  skin->bone_weights = bone_weights;
  return true;
}
