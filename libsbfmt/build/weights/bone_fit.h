/* Measures how well a skeleton fits a body: it may be another character's. */
#ifndef SBFI_BONE_FIT_H
#define SBFI_BONE_FIT_H

#include "build/weights/nearest_bones.h"

/* Fills the figures of the fit. False if memory runs out. */
bool sbfi_bone_fit_measure(const sbfi_weight_mesh *mesh, const sbfi_body_rays *rays,
    const sbfi_bone_segment *segments, uint32_t bone_count, const sbfi_nearest_bone *nearest,
    sbfi_weights_figures *figures, sbfi_arena *arena);

#endif
