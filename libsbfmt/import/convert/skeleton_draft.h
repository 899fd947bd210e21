/* Intermediate bones between the nodes of a rig and the asset. */
#ifndef SBFI_SKELETON_DRAFT_H
#define SBFI_SKELETON_DRAFT_H

#include "import/convert/conversion.h"
#include "mechanics/vector.h"

typedef struct sbfi_bone_draft {
  uint32_t node;
  int32_t parent;     /* index of a draft, or SBF_NONE */
  sbfi_d3 head, x, y; /* asset space; axes of the node, not normalized */
  uint32_t below;     /* number of descendants */
  int32_t next;       /* child that continues the bone, or SBF_NONE */
  sbfi_d3 along;      /* from its head to that child's head; 0 if none */
  sbfi_d3 tip;        /* from its head to an end without a bone (BVH end site); 0 if none */
  uint32_t points;    /* number of skin points for which it has the greatest weight */
  int32_t neighbor;   /* bone whose skin borders that of this detached bone, or SBF_NONE */
} sbfi_bone_draft;

typedef struct sbfi_skeleton_draft {
  sbfi_bone_draft *bones;
  uint32_t count;
  bool along_y; /* the file's bones point along their own Y, as in Blender: keeps rotations */
} sbfi_skeleton_draft;

/* Minimum cosine of the angle between an axis and its bone. */
#define SBFI_STRAIGHT 0.995

/* Whether the bone's +Y points at the child that continues it. */
bool sbfi_bone_runs_straight(const sbfi_bone_draft *bone);

/* Computes `below`, `next`, `along` and `along_y`. */
void sbfi_draft_continue(sbfi_skeleton_draft *s);

/* Control bones such as feet and hands with inverse kinematics often hang on the root but have the skin
 * weights of the limb's end. Without the control rig only their parents move them. This reattaches such a
 * bone to the end of its limb and reports it. Afterwards parents may come after their children. */
sbf_status sbfi_reparent_detached_bones(sbfi_conversion *c, sbfi_skeleton_draft *s);

/* Computes `neighbor` and `points` of every bone from the rig's skins; false if memory runs out. */
bool sbfi_find_neighbors(sbfi_conversion *c, sbfi_skeleton_draft *s);

/* The same for a draft with counted points. `limbs` (s->count) receives the new parent of each bone,
 * SBF_NONE if it stays. Returns whether any bone was reattached. */
bool sbfi_reparent_to_limbs(sbfi_skeleton_draft *s, int32_t *limbs);

#endif
