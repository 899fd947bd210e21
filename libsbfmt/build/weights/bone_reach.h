/* Factors on a bone's reach: thickness of the body around it, and the shells that it passes through. */
#ifndef SBFI_BONE_REACH_H
#define SBFI_BONE_REACH_H

#include "build/weights/bone_segments.h"

/* Fraction of a bone's length within a shell that is closed enough to have an inside; ascending by bone,
 * then shell. */
typedef struct sbfi_bone_fraction {
  uint32_t bone, shell;
  float fraction; /* above 0, up to 1 */
} sbfi_bone_fraction;

typedef struct sbfi_bone_reach {
  double *thickness;             /* (bone_count) radius of the body around each bone */
  sbfi_bone_fraction *fractions; /* (fraction_count) */
  uint32_t fraction_count;
  bool *shell_contains_bone; /* (shell_count) contains more than an eighth of some bone */
} sbfi_bone_reach;

/* False if memory runs out. */
bool sbfi_bone_reach_find(sbfi_bone_reach *reach, const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, const sbfi_bone_segment *segments, const uint32_t *sizes, sbfi_arena *arena);

/* Fraction of a bone's length within a shell; 0 for a shell without an inside. */
float sbfi_bone_fraction_in(const sbfi_bone_reach *reach, uint32_t bone, uint32_t shell);

#endif
