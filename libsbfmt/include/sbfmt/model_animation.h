/* Clips, poses, bone masks, and chains for motion from other skeletons. Part of sbfmt/model.h, which documents the
 * common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_ANIMATION_H
#define SBFMT_MODEL_ANIMATION_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of track_property; sbf_track_property_name returns their names in files. */
typedef enum sbf_track_property {
  SBF_TRACK_PROPERTY_TRANSLATION = 0,
  SBF_TRACK_PROPERTY_ROTATION = 1,
  SBF_TRACK_PROPERTY_SCALE = 2,
  SBF_TRACK_PROPERTY_COUNT = 3
} sbf_track_property;

/* Values of interpolation; sbf_interpolation_name returns their names in files. */
typedef enum sbf_interpolation {
  SBF_INTERPOLATION_LINEAR = 0,
  SBF_INTERPOLATION_STEP = 1,
  SBF_INTERPOLATION_CUBIC = 2,
  SBF_INTERPOLATION_COUNT = 3
} sbf_interpolation;

/* Keys of one property of one bone's frame in its parent's. */
typedef struct sbf_track {
  int32_t bone;                     /* The bone. [index into asset.bones, or SBF_NONE] */
  sbf_track_property property;      /* Keyed property. */
  sbf_interpolation interpolation;  /* Interpolation between keys. [default linear] */
  sbf_f32_list times;               /* Times of the keys, increasing. [s] */
  sbf_f32_list values;              /* Values of the keys: 3 numbers each, 4 for rotation; cubic: tangent in, value,
                                     * tangent out. */
} sbf_track;
typedef struct sbf_track_list { const sbf_track *at; uint32_t count; } sbf_track_list;

/* A keyed animation. */
typedef struct sbf_clip {
  const char *id;         /* Identity. */
  const char *name;       /* Name for people. */
  float duration;         /* Length. [s; [0, inf)] */
  bool loop;              /* Repeats at its end. [default true] */
  sbf_track_list tracks;  /* Keys. */
} sbf_clip;
typedef struct sbf_clip_list { const sbf_clip *at; uint32_t count; } sbf_clip_list;

/* One bone of a pose, relative to its parent. */
typedef struct sbf_pose_key {
  int32_t bone;          /* The bone. [index into asset.bones, or SBF_NONE] */
  sbf_vec3 translation;  /* Translation added to rest, in the parent's frame. [m] */
  sbf_quat rotation;     /* Rotation after rest. */
} sbf_pose_key;
typedef struct sbf_pose_key_list { const sbf_pose_key *at; uint32_t count; } sbf_pose_key_list;

/* A named pose. */
typedef struct sbf_pose {
  const char *id;          /* Identity. */
  const char *name;        /* Name for people. */
  float distance;          /* Distance walked at which it applies. [m] */
  sbf_pose_key_list keys;  /* Bones. */
  float speed;             /* Speed of its walk; poses of one speed are one walk. [m/s; [0, inf)] */
  bool mirrored;           /* The walk's second half is the mirror image of its poses. [default false] */
} sbf_pose;
typedef struct sbf_pose_list { const sbf_pose *at; uint32_t count; } sbf_pose_list;

/* Weights per bone. */
typedef struct sbf_bone_mask {
  const char *id;        /* Identity. */
  const char *name;      /* Name for people. */
  sbf_u32_list bones;    /* Bones. [index into asset.bones] */
  sbf_f32_list weights;  /* Weights; empty: 1. [[0, 1]; length 0 or bones] */
} sbf_bone_mask;
typedef struct sbf_bone_mask_list { const sbf_bone_mask *at; uint32_t count; } sbf_bone_mask_list;

/* A chain of bones with a name shared by other skeletons. */
typedef struct sbf_retarget_chain {
  const char *id;      /* Identity. */
  const char *name;    /* Name, as spine, leg_left, tail. */
  sbf_u32_list bones;  /* Bones from root to end. [index into asset.bones] */
} sbf_retarget_chain;
typedef struct sbf_retarget_chain_list { const sbf_retarget_chain *at; uint32_t count; } sbf_retarget_chain_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_track_init(sbf_track *track);
SBF_API void sbf_clip_init(sbf_clip *clip);
SBF_API void sbf_pose_key_init(sbf_pose_key *pose_key);
SBF_API void sbf_pose_init(sbf_pose *pose);
SBF_API void sbf_bone_mask_init(sbf_bone_mask *bone_mask);
SBF_API void sbf_retarget_chain_init(sbf_retarget_chain *retarget_chain);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_track_property_name(sbf_track_property value);
SBF_API const char *sbf_interpolation_name(sbf_interpolation value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
