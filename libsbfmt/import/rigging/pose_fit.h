/* Finds a pose of the rig's bones in which its skin matches the input: lowered arms where the rig's are
 * stretched out, a leg in mid stride. Each bone rotates about its joint together with its descendants. */
#ifndef SBFI_POSE_FIT_H
#define SBFI_POSE_FIT_H

#include "import/rigging/rigging.h"
#include "import/rigging/surface_finder.h"

/* A point on a surface, a combination of three of its points. */
typedef struct sbfi_surface_sample {
  uint32_t points[3];
  double weights[3];
  sbfi_d3 position, normal;
  bool is_near; /* whether the other surface has a match with a similar normal within SBFI_MAX_GAP */
  sbfi_surface_location near; /* the nearest match, if any */
  double gap;                 /* distance to the match, m; otherwise SBFI_MAX_GAP of the size */
} sbfi_surface_sample;

enum { SBFI_POSE_SAMPLES = 1000 };

/* As fractions of the rig's size: maximum gap that is measured; maximum gap of points that count as on a
 * surface. */
static const double SBFI_MAX_GAP = 0.1, SBFI_ON_SURFACE = 0.015;

typedef struct sbfi_pose_fit {
  const sbfi_rigging *r;
  sbfi_arena *arena; /* owns everything except what `posed_arena` owns */
  sbfi_arena posed_arena, input_arena;
  const sbf_bone *bones; /* in the bind pose of the skin */
  uint32_t bone_count;
  sbfi_matrix *motions; /* (bones) from the bind pose, asset space; rotations and offsets */
  sbfi_matrix to_asset; /* of the input */
  double sign;          /* -1 where the input's polygons face inwards, as those of a mirrored one do */
  sbfi_scene_surface input, posed; /* in asset space */
  sbfi_surface_finder input_finder, posed_finder;
  sbfi_surface_sample *input_samples, *rig_samples; /* (SBFI_POSE_SAMPLES) evenly spread over the area */
} sbfi_pose_fit;

/* Starts from the bind pose. False if memory runs out. */
bool sbfi_pose_fit_begin(sbfi_pose_fit *f, const sbfi_rigging *r, sbfi_arena *arena);
void sbfi_pose_fit_end(sbfi_pose_fit *f);

/* Updates surfaces, samples and gaps after a change of `motions` or `to_asset`. False if memory runs out. */
bool sbfi_pose_fit_update(sbfi_pose_fit *f);
bool sbfi_pose_fit_move_input(sbfi_pose_fit *f);

/* Rotates a bone with its descendants about its joint. `rotation` is about the origin. */
void sbfi_pose_fit_rotate(sbfi_pose_fit *f, uint32_t bone, const double rotation[4]);
sbfi_d3 sbfi_pose_fit_joint(const sbfi_pose_fit *f, uint32_t bone);
bool sbfi_pose_fit_is_descendant(const sbfi_pose_fit *f, uint32_t bone, uint32_t above);

/* Fractions of both surfaces without a match on the other, and the median gap of the input as a fraction
 * of the rig's size. */
typedef struct sbfi_pose_gaps {
  double input_unmatched, rig_unmatched, median;
} sbfi_pose_gaps;
sbfi_pose_gaps sbfi_pose_fit_gaps(const sbfi_pose_fit *f);

/* Rotates limbs without a match onto unmatched parts of the input, in the best of many directions. False
 * if memory runs out. */
bool sbfi_pose_search_limbs(sbfi_pose_fit *f);

/* Optimizes all joints together towards the nearest surface with a similar normal within a distance
 * (fraction of the size). With `free_input` also optimizes the input's position and size. False if memory
 * runs out. */
bool sbfi_pose_fit_joints(sbfi_pose_fit *f, double within, bool free_input);

/* Rotation of a bone relative to its parent: axis in asset space, with a length of twice the sine of half
 * the angle. */
sbfi_d3 sbfi_pose_fit_rotation_vector(const sbfi_pose_fit *f, uint32_t bone);

#endif
