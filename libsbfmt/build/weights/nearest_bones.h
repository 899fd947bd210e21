/* Finds the nearest bone of each site of a mesh along the body. */
#ifndef SBFI_NEAREST_BONES_H
#define SBFI_NEAREST_BONES_H

#include "build/weights/body_grid.h"
#include "build/weights/bone_reach.h"

typedef struct sbfi_nearest_bone {
  uint32_t bone;
  float distance; /* straight distance to the bone's segment, in units of the longest side */
} sbfi_nearest_bone;

/* `nearest` (mesh->site_count). At least one bone deforms. False if memory runs out. */
bool sbfi_nearest_bones_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_grid *grid, const sbfi_bone_segment *segments, const sbfi_bone_reach *reach,
    sbfi_nearest_bone *nearest, sbfi_arena *arena);

#endif
