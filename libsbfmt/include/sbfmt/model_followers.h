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

/* Values of chain_collider_shape; sbf_chain_collider_shape_name returns their names in files. */
typedef enum sbf_chain_collider_shape {
  SBF_CHAIN_COLLIDER_SHAPE_SPHERE = 0,
  SBF_CHAIN_COLLIDER_SHAPE_CAPSULE = 1,
  SBF_CHAIN_COLLIDER_SHAPE_PLANE = 2,
  SBF_CHAIN_COLLIDER_SHAPE_COUNT = 3
} sbf_chain_collider_shape;

/* Pendulums: each bone of the chain swings about its head; lists have one value for all bones, or one each. */
typedef struct sbf_chain_spring {
  sbf_f32_list stiffness;  /* Acceleration of a bone's end along the bone of the pose; empty: 0.
                            * [m/s^2; [0, inf); length 0 or 1 or parent.bones] */
  sbf_f32_list drag;       /* Rate at which the end's velocity decays; empty: 0.
                            * [1/s; [0, inf); length 0 or 1 or parent.bones] */
  sbf_vec3_list gravity;   /* Acceleration of the end, world axes; empty: 0. [m/s^2; length 0 or 1 or parent.bones] */
  sbf_f32_list radius;     /* Radius of the end for collisions; empty: 0.
                            * [m; [0, inf); length 0 or 1 or parent.bones] */
  int32_t center;          /* Bone relative to which the ends keep their velocity; absent: the world.
                            * [index into asset.bones, or SBF_NONE] */
  sbf_u32_list colliders;  /* Shapes that the ends collide with, in this order. [index into asset.chain_colliders] */
} sbf_chain_spring;
typedef struct sbf_chain_spring_list { const sbf_chain_spring *at; uint32_t count; } sbf_chain_spring_list;

/* A chain of bones. */
typedef struct sbf_chain {
  const char *id;                  /* Identity. */
  const char *name;                /* Name for people. */
  sbf_chain_kind kind;             /* lag: bones keep their world orientation; distance: each is dragged at its spacing.
                                    * [default lag] */
  sbf_u32_list bones;              /* Bones, leading bone first. [index into asset.bones] */
  sbf_f32_list spacing;            /* Distance to the next; empty: bone lengths. [m; [0, inf); length 0 or bones] */
  float angle_limit;               /* Maximum angle between two bones. [rad; [0, 3.15]; default 1] */
  float damping;                   /* Rate at which it straightens at rest. [1/s; [0, inf)] */
  bool proposed;                   /* Guessed from the rig, for a person to confirm. [default false] */
  const sbf_chain_spring *spring;  /* Its bones swing as pendulums, for any kind of chain. */
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

/* A shape that ends of swinging bones stay out of, or inside. */
typedef struct sbf_chain_collider {
  const char *id;                  /* Identity. */
  const char *name;                /* Name for people. */
  int32_t bone;                    /* Bone that moves it. [index into asset.bones, or SBF_NONE] */
  sbf_chain_collider_shape shape;  /* Shape. */
  sbf_vec3 position;               /* Center of a sphere, one end of a capsule's axis, a point of a plane; asset space,
                                    * rest pose. [m] */
  sbf_vec3 end;                    /* Other end of a capsule's axis; asset space, rest pose. [m] */
  sbf_vec3 normal;                 /* Direction out of a plane, of any length above 0; asset space, rest pose.
                                    * [default 0,1,0] */
  float radius;                    /* Radius of a sphere or capsule. [m; [0, inf)] */
  bool inside;                     /* Sphere and capsule: ends stay inside. [default false] */
} sbf_chain_collider;
typedef struct sbf_chain_collider_list { const sbf_chain_collider *at; uint32_t count; } sbf_chain_collider_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_chain_spring_init(sbf_chain_spring *chain_spring);
SBF_API void sbf_chain_init(sbf_chain *chain);
SBF_API void sbf_follower_init(sbf_follower *follower);
SBF_API void sbf_chain_collider_init(sbf_chain_collider *chain_collider);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_chain_kind_name(sbf_chain_kind value);
SBF_API const char *sbf_follower_channel_name(sbf_follower_channel value);
SBF_API const char *sbf_bone_axis_name(sbf_bone_axis value);
SBF_API const char *sbf_chain_collider_shape_name(sbf_chain_collider_shape value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
