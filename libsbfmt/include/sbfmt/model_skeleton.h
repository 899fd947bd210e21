/* Bones: places at rest and who hangs on whom, without anything physical. A chapter of sbfmt/model.h, which says what
 * holds for all of them.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_SKELETON_H
#define SBFMT_MODEL_SKELETON_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* One bone. Its local +Y runs from head to tail; positions are in asset space. */
typedef struct sbf_bone {
  const char *id;         /* Identity. */
  const char *name;       /* Name for people and for matching. */
  int32_t parent;         /* The bone it hangs on; absent for a root. A parent stands before its children.
                           * [index into asset.bones, or SBF_NONE] */
  sbf_vec3 head;          /* Where it begins, in the rest pose. [m] */
  sbf_quat rotation;      /* From the bone's frame to asset space, in the rest pose. */
  float length;           /* From head to tail. [m; [0, inf)] */
  bool inherit_rotation;  /* Turns with its parent. [default true] */
  bool inherit_scale;     /* Scales with its parent. [default true] */
} sbf_bone;
typedef struct sbf_bone_list { const sbf_bone *at; uint32_t count; } sbf_bone_list;

/* Every field at its default, lists empty, references SBF_NONE. */
SBF_API void sbf_bone_init(sbf_bone *bone);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
