/* A pose of the rig's bones in which its skin lies on the input: arms that hang where the rig's are stretched
 * out, a leg in mid-stride. Each bone turns about its joint, and all that hangs on it follows. */
#ifndef SBFI_POSE_FIT_H
#define SBFI_POSE_FIT_H

#include "import/rigging/rigging.h"
#include "import/rigging/surface_finder.h"

/* A point on a surface, of three of its own points. */
typedef struct sbfi_surface_sample {
  uint32_t points[3];
  double weights[3];
  sbfi_d3 position, normal;
  bool is_near; /* whether the other surface faces alike no farther than SBFI_MAX_GAP of the size */
  sbfi_surface_location near; /* where it does, the nearest */
  double gap;                 /* to there, m; else SBFI_MAX_GAP of the size */
} sbfi_surface_sample;

enum { SBFI_POSE_SAMPLES = 1000 };

/* As shares of the rig's size: the widest gap that is distinguished; the widest of points that lie on a
 * surface.
 */
static const double SBFI_MAX_GAP = 0.1, SBFI_ON_SURFACE = 0.015;

typedef struct sbfi_pose_fit {
  const sbfi_rigging *r;
  sbfi_arena *arena; /* holds all but what `posed_arena` does */
  sbfi_arena posed_arena, input_arena;
  const sbf_bone *bones; /* in the pose that the skin was bound in */
  uint32_t bone_count;
  sbfi_matrix *motions; /* (bones) from that pose, asset space; rotations and offsets */
  sbfi_matrix to_asset; /* of the input */
  double sign;          /* -1 where the input's polygons face inwards, as those of a mirrored one do */
  sbfi_scene_surface input, posed; /* in asset space */
  sbfi_surface_finder input_finder, posed_finder;
  sbfi_surface_sample *input_samples, *rig_samples; /* (SBFI_POSE_SAMPLES) spread over the area */
} sbfi_pose_fit;

/* The pose that the skin was bound in. False where memory runs out. */
bool sbfi_pose_fit_begin(sbfi_pose_fit *f, const sbfi_rigging *r, sbfi_arena *arena);
void sbfi_pose_fit_end(sbfi_pose_fit *f);

/* After `motions` or `to_asset` changed: surfaces, samples and gaps. False where memory runs out. */
bool sbfi_pose_fit_update(sbfi_pose_fit *f);
bool sbfi_pose_fit_move_input(sbfi_pose_fit *f);

/* Turns a bone and all that hangs on it about its joint, which `rotation` (about the origin) does not move.
 */
void sbfi_pose_fit_turn(sbfi_pose_fit *f, uint32_t bone, const double rotation[4]);
sbfi_d3 sbfi_pose_fit_joint(const sbfi_pose_fit *f, uint32_t bone);
bool sbfi_pose_fit_hangs_on(const sbfi_pose_fit *f, uint32_t bone, uint32_t above);

/* Where points of both surfaces lie on no surface of the other: shares, and the median gap of the input's as
 * a share of the rig's size. */
typedef struct sbfi_pose_gaps {
  double input_beside, rig_beside, median;
} sbfi_pose_gaps;
sbfi_pose_gaps sbfi_pose_fit_gaps(const sbfi_pose_fit *f);

/* Turns limbs that lie beside the input onto parts of it that no part of the rig lies on; of many directions
 * the best. False where memory runs out. */
bool sbfi_pose_search_limbs(sbfi_pose_fit *f);

/* Turns all joints together towards the nearest surface that faces alike, no farther than `within`, a share
 * of the size. With `free_input` the input's place and size follow as well. False where memory runs out. */
bool sbfi_pose_fit_joints(sbfi_pose_fit *f, double within, bool free_input);

/* The turn of a bone against its parent: an axis in asset space, twice the sine of half the angle long. */
sbfi_d3 sbfi_pose_fit_turn_vector(const sbfi_pose_fit *f, uint32_t bone);

#endif
