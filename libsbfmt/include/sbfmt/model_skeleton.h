/* Bones: rest pose and hierarchy. Part of sbfmt/model.h, which documents the common conventions.
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
  int32_t parent;         /* Parent bone; absent for a root. Parents precede children.
                           * [index into asset.bones, or SBF_NONE] */
  sbf_vec3 head;          /* Head position in the rest pose. [m] */
  sbf_quat rotation;      /* Rotation from the bone's frame to asset space, in the rest pose. */
  float length;           /* Distance from head to tail. [m; [0, inf)] */
  bool inherit_rotation;  /* Inherits the parent's rotation. [default true] */
  bool inherit_scale;     /* Inherits the parent's scale. [default true] */
} sbf_bone;
typedef struct sbf_bone_list { const sbf_bone *at; uint32_t count; } sbf_bone_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_bone_init(sbf_bone *bone);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
