/* Proposes the rest pose of a gait, and how arms swing during a walk. */
#ifndef SBFI_REST_POSE_H
#define SBFI_REST_POSE_H

#include "import/convert/conversion.h"
#include "import/gait/locomotion.h"

/* After the clips: adds a rest pose to a proposed gait, from the first frame of an idle clip, else from
 * natural angles if the arms are held out. Adds walk poses in which arms swing opposite to the legs. */
sbf_status sbfi_propose_rest_pose(sbfi_conversion *c);

/* Bones of an arm and its continuation. */
typedef struct sbfi_arm_draft {
  int32_t upper, lower, hand; /* consecutive; hand is SBF_NONE if the arm has none */
  int side;
} sbfi_arm_draft;

/* Finds the arms of a biped: `arms` has a capacity of 2. Returns their number. */
uint32_t sbfi_draft_arms(const sbfi_rig_view *view, const sbf_gait *gait, sbfi_arm_draft arms[2]);

/* A pose under construction: rotations of bones in asset space, each applied on top of its parent's. */
typedef struct sbfi_pose_draft {
  double (*rotations)[4]; /* (bones) x y z w, from the bind pose, relative to the parent's rotation */
  bool *is_rotated;       /* (bones) whether the bone rotates */
  uint32_t count;
} sbfi_pose_draft;

/* Lowers arms: 70 degrees down, 5 forward, elbows bent by 20, fingers curled. Arms that already hang by 30
 * degrees or more stay. Returns whether any arm moved. */
bool sbfi_lower_arms(
    const sbfi_rig_view *view, const sbfi_arm_draft *arms, uint32_t count, sbfi_pose_draft *pose);

#endif
