/* Motion of one skeleton onto another: which bones stand for which, poses of the one, tracks of the other. */
#ifndef SBFI_CARRIED_MOTION_H
#define SBFI_CARRIED_MOTION_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "motion/turn.h"
#include "sbfmt/asset.h"

/* What a bone is in a body, as far as poses are told apart by it. */
typedef enum sbfi_part {
  SBFI_PART_OTHER,
  SBFI_PART_HIPS,
  SBFI_PART_THIGH,
  SBFI_PART_LIMB,
  SBFI_PART_HAND
} sbfi_part;

typedef struct sbfi_bone_match {
  int32_t source; /* the other skeleton's bone whose motion it takes, or SBF_NONE */
  sbfi_part part;
} sbfi_bone_match;

/* For each bone of `to` the bone of `from` that it follows, `matches` (to->bones.count). In this order:
 * retarget chains of one name, by share of their bones; the same name; names that mean the same part of the
 * same side, as LeftUpLeg, thigh.L and mixamorig:LeftUpLeg; where a part has several bones, by their order.
 * Returns how many follow one, -1 where memory runs out. */
int64_t sbfi_match_bones(
    const sbf_asset *from, const sbf_asset *to, sbfi_arena *scratch, sbfi_bone_match *matches);

/* The side that a bone's name says, as thigh.L and RightFoot do: 1 left, -1 right, 0 none. */
int sbfi_name_side(const char *name);

/* A bone's frame in asset space: a turn (x y z w) and a place. */
typedef struct sbfi_bone_frame {
  double rotation[4], position[3];
} sbfi_bone_frame;

/* Frames at rest, (asset->bones.count). */
void sbfi_compute_rest_frames(const sbf_asset *asset, sbfi_bone_frame *frames);

/* A clip laid out by bone. Scales are left out: they carry no pose from one body to another. */
typedef struct sbfi_clip_poses {
  const sbf_asset *asset;
  const sbf_track **translations, **rotations; /* (bones.count), NULL where the clip has none */
  sbfi_bone_frame *rest, *rest_local;          /* (bones.count) in asset space, in the parent's frame */
} sbfi_clip_poses;

bool sbfi_clip_poses_init(
    sbfi_clip_poses *poses, const sbf_asset *asset, const sbf_clip *clip, sbfi_arena *scratch);
/* Frames in asset space at a time, (bones.count). */
void sbfi_clip_pose(const sbfi_clip_poses *poses, float time_s, sbfi_bone_frame *frames);

/* Carries the clips of `from` over to the bones of an asset under construction and adds them to it: how, says
 * sbr_asset_retarget_clips. `file` names where they come from, in messages and where a clip has no name. On
 * failure the asset has the clips it had. */
sbf_status sbfi_carry_clips(sbf_asset *asset, const sbf_asset *from, const char *file,
    const sbf_allocator *allocator, sbfi_reporter *reporter, sbf_diagnostic *error);

#endif
