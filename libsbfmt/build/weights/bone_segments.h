/* Bones as line segments in the mesh's units: from each joint to the next, and for the last ones to the
 * end of the body. */
#ifndef SBFI_BONE_SEGMENTS_H
#define SBFI_BONE_SEGMENTS_H

#include "build/weights/body_rays.h"

typedef struct sbfi_bone_segment {
  sbfi_d3 head, tail;
  int32_t next;      /* child at its end, or SBF_NONE */
  bool is_deforming; /* others have no points */
  int side;          /* of its limb: 1 left, -1 right, 0 neither */
} sbfi_bone_segment;

/* `segments` (in->bone_count). False if memory runs out. */
bool sbfi_bone_segments_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, sbfi_bone_segment *segments, sbfi_arena *arena);

/* Whether a limb's bone begins at the head of its parent, which has no continuation, as fingers do at the
 * wrist in motion capture. It is beside its parent instead of continuing it. */
bool sbfi_bone_is_adjacent(const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t bone);

/* Nearest point of a segment. */
sbfi_d3 sbfi_segment_nearest(const sbfi_bone_segment *segment, sbfi_d3 point);

/* Squared distance of a point from a segment. */
double sbfi_segment_distance2(const sbfi_bone_segment *segment, sbfi_d3 point);

#endif
