/* Walks of pose keys in the runtime's layout: every pose of a walk, mirrored ones included, bone by bone, so
 * that a tick needs no search. */
#ifndef SBRI_WALK_TABLE_H
#define SBRI_WALK_TABLE_H

#include "sbrun/sbrun.h"

/* On top of rest, as a pose key has it; of a bone that a pose does not name: nothing. */
typedef struct sbri_posed_bone {
  sbf_vec3 translation; /* in the parent's frame, asset metres */
  sbf_quat rotation;
} sbri_posed_bone;

/* A pose of a walk. */
typedef struct sbri_walk_frame {
  float at;                     /* share of the cycle, above 0, ascending; the last at 1, which is also 0 */
  const sbri_posed_bone *bones; /* one for each of the walks' bones */
} sbri_walk_frame;

typedef struct sbri_walk {
  float speed;   /* that it is for, m/s */
  float cycle_m; /* walked in one cycle */
  bool mirrored; /* its second half is the mirror image of the first */
  const sbri_walk_frame *frames;
  uint32_t frame_count;
} sbri_walk;

typedef struct sbri_walks {
  const sbri_walk *walks; /* by speed, ascending */
  uint32_t walk_count;
  const uint32_t *bones; /* that any of their poses moves */
  uint32_t bone_count;
  int32_t first_leg, other_leg; /* legs whose steps begin the halves of mirrored walks; -1: none */
} sbri_walks;

#endif
