/* Pins of soft bodies to bones, rigid bodies or the world. Part of sbfmt/model.h, which documents the common
 * conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_PINS_H
#define SBFMT_MODEL_PINS_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of attachment_rule; sbf_attachment_rule_name returns their names in files. */
typedef enum sbf_attachment_rule {
  SBF_ATTACHMENT_RULE_EXPLICIT = 0,
  SBF_ATTACHMENT_RULE_INSIDE_HULL = 1,
  SBF_ATTACHMENT_RULE_COUNT = 2
} sbf_attachment_rule;

/* Points pinned to a frame: a bone, a rigid body, or else the world. */
typedef struct sbf_pin_set {
  const char *name;       /* Name for people. */
  int32_t bone;           /* Bone of the frame. [index into asset.bones, or SBF_NONE] */
  int32_t rigid_body;     /* Rigid body of the frame. [index into asset.rigid_bodies, or SBF_NONE] */
  int32_t derived;        /* Derivation, if `build` made it. [index into asset.derivations, or SBF_NONE] */
  sbf_u32_list points;    /* Points of the body, or of the level. [index into parent.size] */
  sbf_vec3_list offsets;  /* Position of each in the frame; empty: the rest position. [m; length 0 or points] */
  sbf_f32_list weights;   /* Weights: 1 kinematic, less a goal spring; empty: 1. [[0, 1]; length 0 or 1 or points] */
  float stiffness;        /* Stiffness of the goal spring at weight 1. [N/m; [0, inf)] */
  float damping;          /* Damping of the goal spring. [N*s/m; [0, inf)] */
  float minimum;          /* Lower bound of weights. [[0, 1]] */
  float maximum;          /* Upper bound of weights. [[0, 1]; default 1] */
} sbf_pin_set;
typedef struct sbf_pin_set_list { const sbf_pin_set *at; uint32_t count; } sbf_pin_set_list;

/* A rule that pins a body to a rigid body. */
typedef struct sbf_attachment {
  const char *name;          /* Name for people. */
  sbf_attachment_rule rule;  /* inside_hull: every point inside the rigid body's hull; explicit: the points listed. */
  int32_t rigid_body;        /* Rigid body of the frame. [index into asset.rigid_bodies, or SBF_NONE] */
  sbf_u32_list points;       /* Points of rule explicit. [index into parent.size] */
} sbf_attachment;
typedef struct sbf_attachment_list { const sbf_attachment *at; uint32_t count; } sbf_attachment_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_pin_set_init(sbf_pin_set *pin_set);
SBF_API void sbf_attachment_init(sbf_attachment *attachment);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_attachment_rule_name(sbf_attachment_rule value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
