/* Chains that trail behind their first bone, and bones that lag behind their pose. Part of sbfmt/model.h, which
 * documents the common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_FOLLOWERS_H
#define SBFMT_MODEL_FOLLOWERS_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of chain_kind; sbf_chain_kind_name returns their names in files. */
typedef enum sbf_chain_kind {
  SBF_CHAIN_KIND_LAG = 0,
  SBF_CHAIN_KIND_DISTANCE = 1,
  SBF_CHAIN_KIND_COUNT = 2
} sbf_chain_kind;

/* Values of follower_channel; sbf_follower_channel_name returns their names in files. */
typedef enum sbf_follower_channel {
  SBF_FOLLOWER_CHANNEL_ROTATION = 0,
  SBF_FOLLOWER_CHANNEL_POSITION = 1,
  SBF_FOLLOWER_CHANNEL_BOTH = 2,
  SBF_FOLLOWER_CHANNEL_SQUASH = 3,
  SBF_FOLLOWER_CHANNEL_WEIGHT = 4,
  SBF_FOLLOWER_CHANNEL_COUNT = 5
} sbf_follower_channel;

/* Values of bone_axis; sbf_bone_axis_name returns their names in files. */
typedef enum sbf_bone_axis {
  SBF_BONE_AXIS_X = 0,
  SBF_BONE_AXIS_Y = 1,
  SBF_BONE_AXIS_Z = 2,
  SBF_BONE_AXIS_COUNT = 3
} sbf_bone_axis;

/* A chain of bones. */
typedef struct sbf_chain {
  const char *id;        /* Identity. */
  const char *name;      /* Name for people. */
  sbf_chain_kind kind;   /* lag: bones keep their world orientation; distance: each is dragged at its spacing.
                          * [default lag] */
  sbf_u32_list bones;    /* Bones, leading bone first. [index into asset.bones] */
  sbf_f32_list spacing;  /* Distance to the next; empty: bone lengths. [m; [0, inf); length 0 or bones] */
  float angle_limit;     /* Maximum angle between two bones. [rad; [0, 3.15]; default 1] */
  float damping;         /* Rate at which it straightens at rest. [1/s; [0, inf)] */
  bool proposed;         /* Guessed from the rig, for a person to confirm. [default false] */
} sbf_chain;
typedef struct sbf_chain_list { const sbf_chain *at; uint32_t count; } sbf_chain_list;

/* A bone follows its own animated pose as a second-order system. */
typedef struct sbf_follower {
  const char *id;                /* Identity. */
  const char *name;              /* Name for people. */
  int32_t bone;                  /* The bone. [index into asset.bones, or SBF_NONE] */
  sbf_follower_channel channel;  /* Channel that follows. [default rotation] */
  float frequency;               /* Frequency f. [Hz; (0, inf); default 2] */
  float damping_ratio;           /* Damping ratio z. [[0, inf); default 0.5] */
  float response;                /* Response r. [default 0] */
  sbf_bone_axis axis;            /* Squash: the bone's axis of compression and stretch. [default y] */
  float strength;                /* Squash or weight: relative stretch, or movement and lean, per relative lag.
                                  * [[0, inf); default 1] */
  float limit;                   /* Squash: the length stays between 1 / (1 + limit) and 1 + limit; weight: bound of
                                  * movement relative to length, and of lean in rad. [(0, inf); default 0.5] */
} sbf_follower;
typedef struct sbf_follower_list { const sbf_follower *at; uint32_t count; } sbf_follower_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_chain_init(sbf_chain *chain);
SBF_API void sbf_follower_init(sbf_follower *follower);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_chain_kind_name(sbf_chain_kind value);
SBF_API const char *sbf_follower_channel_name(sbf_follower_channel value);
SBF_API const char *sbf_bone_axis_name(sbf_bone_axis value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
