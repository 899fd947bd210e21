#include "import/convert/main_bones.h"

#include "build/geometry/topology.h"

uint32_t *sbfi_main_bones(const sbf_render_mesh *skinned, sbfi_arena *scratch) {
  const sbf_skin *skin = skinned->skin;
  uint32_t count = skinned->mesh.positions.count;
  uint32_t *bones = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *bones);
  for (uint32_t v = 0, i = 0; bones && v < count; v++) {
    float max = 0;
    bones[v] = SBFI_NO_INDEX;
    uint32_t end = i + (v < skin->influence_counts.count ? skin->influence_counts.at[v] : 0);
    for (; i < end; i++)
      if (skin->weights.at[i] > max) max = skin->weights.at[i], bones[v] = skin->bones.at[i];
  }
  return bones;
}
