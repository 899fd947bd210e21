/* Inverse kinematics: chains of bones that reach for a target. Part of sbfmt/model.h, which documents the common
 * conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_IK_H
#define SBFMT_MODEL_IK_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of ik_solver; sbf_ik_solver_name returns their names in files. */
typedef enum sbf_ik_solver {
  SBF_IK_SOLVER_TWO_BONE = 0,
  SBF_IK_SOLVER_CCD = 1,
  SBF_IK_SOLVER_FABRIK = 2,
  SBF_IK_SOLVER_DAMPED_LEAST_SQUARES = 3,
  SBF_IK_SOLVER_SPLINE = 4,
  SBF_IK_SOLVER_COUNT = 5
} sbf_ik_solver;

/* A rotation a bone prefers, relative to its parent's rest. */
typedef struct sbf_comfort {
  int32_t bone;       /* The bone. [index into asset.bones, or SBF_NONE] */
  sbf_quat rotation;  /* The rotation. */
  float weight;       /* Weight. [[0, 1]; default 1] */
  sbf_vec3 axes;      /* Fractions of the weight about the bone's X, Y and Z. [[0, 1]; default 1,1,1] */
} sbf_comfort;
typedef struct sbf_comfort_list { const sbf_comfort *at; uint32_t count; } sbf_comfort_list;

/* Bones from root to end reach for a target. */
typedef struct sbf_ik_chain {
  const char *id;             /* Identity. */
  const char *name;           /* Name for people. */
  sbf_ik_solver solver;       /* Method. [default two_bone] */
  int32_t root;               /* First bone. [index into asset.bones, or SBF_NONE] */
  int32_t end;                /* Last bone; its head reaches for the target. [index into asset.bones, or SBF_NONE] */
  bool has_pole;              /* The chain bends towards the pole. [default false] */
  sbf_vec3 pole;              /* The pole, asset space, rest pose. [m] */
  int32_t pole_bone;          /* Bone that moves the pole; absent: the root bone's parent.
                               * [index into asset.bones, or SBF_NONE] */
  float copy_rotation;        /* Fraction of the target's rotation that the end takes. [[0, 1]; default 1] */
  float soft_reach;           /* Fraction of the reach over which extension is smoothed. [[0, 1); default 0.02] */
  float tolerance;            /* Tolerance of iterative methods. [m; (0, inf); default 0.0001] */
  uint32_t iterations;        /* Maximum number of iterations. [default 32] */
  sbf_comfort_list comforts;  /* Rotations the bones prefer. */
  bool proposed;              /* Guessed from the rig, for a person to confirm. [default false] */
} sbf_ik_chain;
typedef struct sbf_ik_chain_list { const sbf_ik_chain *at; uint32_t count; } sbf_ik_chain_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_comfort_init(sbf_comfort *comfort);
SBF_API void sbf_ik_chain_init(sbf_ik_chain *ik_chain);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_ik_solver_name(sbf_ik_solver value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
