/* The pose that a character stands and moves in, and how its arms swing as it walks. */
#ifndef SBFI_REST_POSE_H
#define SBFI_REST_POSE_H

#include "import/convert/conversion.h"
#include "import/gait/locomotion.h"

/* After the clips: gives a proposed gait its rest pose, from the first frame of a clip that stands idle, else
 * from natural angles where arms are held out; and walk poses in which arms swing against the legs. */
sbf_status sbfi_propose_rest_pose(sbfi_conversion *c);

/* Bones of an arm and what continues it. */
typedef struct sbfi_arm_draft {
  int32_t upper, lower, hand; /* consecutive; hand is SBF_NONE where the arm ends without */
  int side;
} sbfi_arm_draft;

/* Arms of what stands on two legs: `arms` (2 at most); returns how many. */
uint32_t sbfi_draft_arms(const sbfi_rig_view *view, const sbf_gait *gait, sbfi_arm_draft arms[2]);

/* A pose under construction: turns of bones in asset space, each added to its parent's. */
typedef struct sbfi_pose_draft {
  double (*turns)[4]; /* (bones) x y z w, away from the bind pose, relative to the parent's turn */
  bool *turned;       /* (bones) */
  uint32_t count;
} sbfi_pose_draft;

/* Lets arms hang: 70 degrees down, 5 ahead, elbows bent by 20, fingers curled. Arms that hang by 30 degrees
 * or more already stay. Returns whether any was moved. */
bool sbfi_hang_arms(
    const sbfi_rig_view *view, const sbfi_arm_draft *arms, uint32_t count, sbfi_pose_draft *pose);

#endif
