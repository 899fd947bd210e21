/* Bones on their way from the nodes of a rig to the asset. */
#ifndef SBFI_SKELETON_DRAFT_H
#define SBFI_SKELETON_DRAFT_H

#include "import/convert/conversion.h"
#include "mechanics/vector.h"

typedef struct sbfi_bone_draft {
  uint32_t node;
  int32_t parent;     /* a draft, or SBF_NONE */
  sbfi_d3 head, x, y; /* asset space; axes as the node has them, not of unit length */
  uint32_t below;     /* bones that hang on it */
  int32_t next;       /* the child that continues it, or SBF_NONE */
  sbfi_d3 along;      /* from its head to that child's; 0 where there is none */
  sbfi_d3 tip;      /* from its head to the end that the file marks without a bone (BVH end sites); else 0 */
  uint32_t points;  /* of skins that it holds more than any other bone does */
  int32_t neighbor; /* the bone whose skin meets that of this detached one, or SBF_NONE */
} sbfi_bone_draft;

typedef struct sbfi_skeleton_draft {
  sbfi_bone_draft *bones;
  uint32_t count;
  bool along_y; /* the file's bones run along their own Y, as Blender's do: rotations are kept as they are */
} sbfi_skeleton_draft;

/* Cosine of the angle within which an axis runs along a bone. */
#define SBFI_STRAIGHT 0.995

/* Whether the bone's +Y points at the child that continues it. */
bool sbfi_bone_runs_straight(const sbfi_bone_draft *bone);

/* Finds `below`, `next`, `along` and `along_y`; what was there is overwritten. */
void sbfi_draft_continue(sbfi_skeleton_draft *s);

/* Bones that a person moves and the limb follows, as feet and hands with inverse kinematics, often hang on
 * the root and hold the skin at the limb's tip all the same. Here nothing moves them but their parents: such
 * a bone is hung where its limb ends, and a note says so. Afterwards parents may stand behind their children.
 */
sbf_status sbfi_hang_detached(sbfi_conversion *c, sbfi_skeleton_draft *s);

/* Finds `neighbor` and `points` of every bone from the rig's skins; false: memory ran out. */
bool sbfi_find_neighbors(sbfi_conversion *c, sbfi_skeleton_draft *s);

/* The same of a draft whose points are counted: `limbs` (s->count) receives the bone that each now hangs on,
 * SBF_NONE where it stays. Whether any was hung elsewhere. */
bool sbfi_hang_on_limbs(sbfi_skeleton_draft *s, int32_t *limbs);

#endif
