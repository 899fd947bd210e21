/* Walks of pose keys in the runtime's layout: every pose of a walk, mirrored ones included, bone by bone, so
 * that a tick needs no search. */
#ifndef SBRI_WALK_TABLE_H
#define SBRI_WALK_TABLE_H

#include "sbrun/sbrun.h"

/* Relative to the rest pose, as in a pose key; identity for bones that a pose does not have. */
typedef struct sbri_posed_bone {
  sbf_vec3 translation; /* in the parent's frame, asset metres */
  sbf_quat rotation;
} sbri_posed_bone;

/* A pose of a walk. */
typedef struct sbri_walk_frame {
  float at; /* fraction of the cycle, above 0, ascending; the last is 1, which is also 0 */
  const sbri_posed_bone *bones; /* one for each of the walks' bones */
} sbri_walk_frame;

typedef struct sbri_walk {
  float speed;   /* its speed, m/s */
  float cycle_m; /* distance of one cycle */
  bool mirrored; /* its second half is the mirror image of the first */
  const sbri_walk_frame *frames;
  uint32_t frame_count;
} sbri_walk;

typedef struct sbri_walks {
  const sbri_walk *walks; /* by speed, ascending */
  uint32_t walk_count;
  const uint32_t *bones; /* all bones that poses move */
  uint32_t bone_count;
  int32_t first_leg, other_leg; /* legs whose steps begin the halves of mirrored walks; -1: none */
} sbri_walks;

#endif
