/* Retargets motion from one skeleton to another: matching bones, poses of the source, tracks of the
 * target. */
#ifndef SBFI_RETARGETING_H
#define SBFI_RETARGETING_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "motion/quatd.h"
#include "sbfmt/asset.h"

/* Part of a body, as far as retargeting distinguishes them. */
typedef enum sbfi_part {
  SBFI_PART_OTHER,
  SBFI_PART_HIPS,
  SBFI_PART_THIGH,
  SBFI_PART_LIMB,
  SBFI_PART_HAND
} sbfi_part;

typedef struct sbfi_bone_match {
  int32_t source; /* matching bone of the other skeleton, or SBF_NONE */
  sbfi_part part;
} sbfi_bone_match;

/* For each bone of `to` the bone of `from` that it follows, `matches` (to->bones.count). In this order:
 * retarget chains of equal names, proportionally by bones; equal names; names of the same part and side,
 * such as LeftUpLeg, thigh.L and mixamorig:LeftUpLeg; in order if a part has several bones. Returns the
 * number of matches, -1 if memory runs out. */
int64_t sbfi_match_bones(
    const sbf_asset *from, const sbf_asset *to, sbfi_arena *scratch, sbfi_bone_match *matches);

/* Side in a bone's name, as in thigh.L and RightFoot: 1 left, -1 right, 0 none. */
int sbfi_name_side(const char *name);

/* A bone's frame in asset space: rotation (x y z w) and position. */
typedef struct sbfi_bone_frame {
  double rotation[4], position[3];
} sbfi_bone_frame;

/* Frames at rest, (asset->bones.count). */
void sbfi_compute_rest_frames(const sbf_asset *asset, sbfi_bone_frame *frames);

/* A clip indexed by bone. Ignores scales, because they do not transfer between bodies. */
typedef struct sbfi_clip_poses {
  const sbf_asset *asset;
  const sbf_track **translations, **rotations; /* (bones.count), NULL if the clip has none */
  sbfi_bone_frame *rest, *rest_local;          /* (bones.count) in asset space, and in the parent's frame */
} sbfi_clip_poses;

bool sbfi_clip_poses_init(
    sbfi_clip_poses *poses, const sbf_asset *asset, const sbf_clip *clip, sbfi_arena *scratch);
/* Frames in asset space at a time, (bones.count). */
void sbfi_clip_pose(const sbfi_clip_poses *poses, float time_s, sbfi_bone_frame *frames);

/* Retargets the clips of `from` to the bones of an asset under construction and adds them, as described
 * for sbr_asset_retarget_clips. `file` names the origin in messages and unnamed clips. On failure the
 * asset's clips do not change. */
sbf_status sbfi_retarget_clips(sbf_asset *asset, const sbf_asset *from, const char *file,
    const sbf_allocator *allocator, sbfi_reporter *reporter, sbf_diagnostic *error);

#endif
