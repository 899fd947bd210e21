/* Bones as segments inside a mesh, in the mesh's units: from each joint to the next, and for bones without a
 * next one to where the body ends. */
#ifndef SBFI_BONE_SEGMENTS_H
#define SBFI_BONE_SEGMENTS_H

#include "build/weights/body_rays.h"

typedef struct sbfi_bone_segment {
  sbfi_d3 head, tail;
  int32_t next;      /* child that it runs to, or SBF_NONE */
  bool is_deforming; /* others hold no points */
  int side;          /* of the limb that it belongs to: 1 left, -1 right, 0 neither */
} sbfi_bone_segment;

/* `segments` (in->bone_count). False where memory runs out. */
bool sbfi_bone_segments_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, sbfi_bone_segment *segments, sbfi_arena *arena);

/* Whether a bone of a limb begins where its parent, which has no next bone, begins, as the fingers of motion
 * capture do at the wrist. It runs beside its parent and does not end it. */
bool sbfi_bone_is_beside(const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t bone);

/* The point of a segment that is nearest to another. */
sbfi_d3 sbfi_segment_nearest(const sbfi_bone_segment *segment, sbfi_d3 point);

/* Squared distance of a point from a segment. */
double sbfi_segment_distance2(const sbfi_bone_segment *segment, sbfi_d3 point);

#endif
