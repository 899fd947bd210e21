/* The skeleton as the runtime uses it: constant tables of a rig, shared by all characters of a model.
 *
 * Made by animation/skeleton/rig_make.h. Bone frames are as in the asset: +Y from head to tail. A pose holds
 * every bone's frame in world axes, relative to the character's origin, already scaled. */
#ifndef SBRI_RIG_H
#define SBRI_RIG_H

#include "animation/ik/joint_limit.h"
#include "sbrun/sbrun.h"

/* Walks: all poses of a walk, mirrored ones included, bone by bone, so that a tick needs no search. */

/* Transform of a bone relative to the rest pose, as in a pose key; identity for bones without a key. */
typedef struct sbri_posed_bone {
  sbf_vec3 translation; /* in the parent's frame, asset metres */
  sbf_quat rotation;
} sbri_posed_bone;

/* A pose of a walk. */
typedef struct sbri_walk_frame {
  float at; /* fraction of the cycle, above 0, ascending; the last is 1, which is also 0 */
  const sbri_posed_bone *bones; /* one for each of the walks' bones */
} sbri_walk_frame;

typedef struct sbri_walk {
  float speed;   /* its speed, m/s */
  float cycle_m; /* distance of one cycle */
  bool mirrored; /* its second half is the mirror image of the first */
  const sbri_walk_frame *frames;
  uint32_t frame_count;
} sbri_walk;

typedef struct sbri_walks {
  const sbri_walk *walks; /* by speed, ascending */
  uint32_t walk_count;
  const uint32_t *bones; /* all bones that poses move */
  uint32_t bone_count;
  int32_t first_leg, other_leg; /* legs whose steps begin the halves of mirrored walks; -1: none */
} sbri_walks;

/* Extent of the part of a foot that needs ground below it, from its middle: left (+x), right, toe (+z), heel;
 * m. */
typedef struct sbri_sole {
  float left, right, toe, heel;
  float outline[4]; /* the same extents of the whole foot, seen from above */
  sbf_vec3
      corners[4]; /* outermost points of the sole towards right heel, left heel, right toe, left toe; y 0 */
} sbri_sole;

/* Pole vector of the knee. */
typedef struct sbri_leg_pole {
  sbf_vec3 direction; /* asset space, rest pose */
  int32_t bone;       /* bone that the pole moves with; -1: the root */
  sbf_vec3 position;  /* in that bone's frame, m */
} sbri_leg_pole;

/* Position of the sole at rest. */
typedef struct sbri_leg_home {
  sbf_vec3 position;  /* middle of the sole, asset space; y: height of the ankle above the ground */
  int32_t chain_bone; /* index among the bones of trailing chains of the leg's parent; -1: the body */
  sbf_vec3 in_bone;   /* the position in that bone's frame, m */
  sbf_vec3 ankle;     /* ankle relative to the middle of the sole, m */
  sbf_vec3 toe;       /* head of the toe relative to it, m */
} sbri_leg_home;

/* Lengths of a leg, m. */
typedef struct sbri_leg_length {
  float upper, lower;
  float reach;        /* maximum distance of ankle and hip within the knee's limits; with a long foot, for the
                         upright foot (sbri_leg_span) */
  float soft_reach;   /* fraction of the reach at its end in which the leg stretches softly */
  float rest_span;    /* distance of hip and ankle at rest */
  float rest_stretch; /* rest_span / (reach without its soft part) */
} sbri_leg_length;

/* A leg of the gait, with data of the rest pose. It has three bones: thigh, shin and foot. A leg of two bones
 * has no knee: its upper bone swings the foot, and the distance of both does not limit its reach. A leg of
 * four bones has a long foot that leans over the toe on which it stands. */
typedef struct sbri_leg {
  int32_t upper, lower, foot; /* bones: thigh, shin (-1: no knee), and the one whose head is the ankle */
  int32_t toe;                /* bone that stands on the ground if the foot is long; else 0 */
  sbri_leg_pole pole;
  sbri_leg_home home;
  sbri_leg_length length;
  float toe_copies;    /* fraction of the ground's slope that the toe of a long foot takes */
  float copy_rotation; /* fraction of the slope that another foot takes */
  uint32_t group;
  bool hind; /* below the hips; else below the chest */
  bool fore; /* a front leg: the body pitches by the heights of front and other legs */
  sbf_quat upper_inverse, lower_inverse; /* undo the rotations of thigh and shin at rest */
  sbri_sole sole;
  bool has_toe;    /* its foot is long */
  bool has_others; /* thigh or shin has other children too, for example twist bones */
  bool is_last;    /* all bones below the thigh are posed after the leg is solved: only legs move them */
} sbri_leg;

typedef struct sbri_tail_bone {
  sbf_vec3 step;   /* from its head to the next head, of the last bone to its end; asset space, at rest */
  float clearance; /* minimum height of its end above the ground, m */
} sbri_tail_bone;

typedef struct sbri_tail {
  const uint32_t *bone_indices; /* bone_count, from the leading one */
  const sbri_tail_bone *bones;  /* bone_count */
  uint32_t bone_count;
  uint32_t first_state; /* index of its first bone among the bones of all tails */
  float frequency, damping_ratio, limit;
} sbri_tail;

/* A trailing chain; tails have their own. */
typedef struct sbri_bone_chain {
  const sbf_chain *source;
  uint32_t first_state; /* index of its first bone among the bones of all chains */
} sbri_bone_chain;

enum { SBRI_MAX_LEGS = 16, SBRI_BELLY = 4, SBRI_WALL_SPHERES = 48 };

/* A ball inside the body that walls keep out, in the gait's rest pose; asset space. */
typedef struct sbri_wall_sphere {
  sbf_vec3 position;
  float radius;
} sbri_wall_sphere;

/* Size of the body for collisions of the gait with colliders: animation/skeleton/wall_volume.c. */
typedef struct sbri_wall_volume {
  sbri_wall_sphere wall_spheres[SBRI_WALL_SPHERES]; /* (wall_sphere_count) */
  uint32_t wall_sphere_count;
  float step_up;        /* maximum height of a step up, m */
  float radius;         /* of wall_spheres and feet about the origin, m */
  float mass;           /* approximate mass, kg: the body pushes lighter colliders aside */
  uint32_t layer, mask; /* union over its bodies */
} sbri_wall_volume;

/* What rotates a bone relative to its parent. */
typedef enum sbri_bone_role {
  SBRI_ROLE_NONE,
  SBRI_ROLE_SPINE,
  SBRI_ROLE_HEAD,
  SBRI_ROLE_TAIL,
  SBRI_ROLE_LEG /* below the thigh of a leg that is posed last */
} sbri_bone_role;

/* Fraction of the body's mass at a bone, and its centre in the bone's frame. */
typedef struct sbri_bone_mass {
  float fraction;
  sbf_vec3 position;
} sbri_bone_mass;

typedef struct sbri_rig_bones {
  uint32_t count;
  const int32_t *parents;          /* (count) -1: root */
  const sbr_transform *rest;       /* (count) asset space */
  const sbr_transform *rest_local; /* (count) in the parent's rest frame; a root's as it is */
  const sbr_transform *base_local; /* the same in the gait's rest pose */
  const float *spine_fraction;     /* (count) 0 rotates with the hips, 1 with the chest, -1 with its parent */
  const uint8_t *roles;            /* (count) of sbri_bone_role */
  const sbri_joint_limit *limits;  /* (count) against the parent */
  const uint32_t *subtree;         /* (count) the bones in an order in which children follow their parent */
  const uint32_t *subtree_begin, *subtree_end; /* (count) range of `subtree` below each bone */
  const sbri_bone_mass *masses;                /* (count) fractions with sum 1, or all 0 */
} sbri_rig_bones;

typedef struct sbri_rig_tails {
  const sbri_tail *at;
  uint32_t count, bone_count;
} sbri_rig_tails;

typedef struct sbri_rig_chains {
  const sbri_bone_chain *at;
  uint32_t count, bone_count;
} sbri_rig_chains;

/* Shape that the ends of swinging bones collide with, in its bone's frame. */
typedef struct sbri_chain_shape {
  const sbf_chain_collider *source;
  sbf_vec3 position; /* as in the source, m */
  sbf_vec3 axis;     /* from a capsule's first end to the other, m */
  sbf_vec3 normal;   /* of a plane, unit length */
} sbri_chain_shape;

/* Chains that swing, those on other chains after them. */
typedef struct sbri_rig_springs {
  sbri_rig_chains chains;
  const sbri_chain_shape *shapes; /* (asset's chain_colliders) */
} sbri_rig_springs;

/* Measures of the standing body, asset space. */
typedef struct sbri_rig_stand {
  float hind_z, fore_z;       /* mean z of the homes of fore legs and of the others */
  float hips_y;               /* mean height at which legs begin */
  float half_width;           /* mean |x| of the homes */
  float spread;               /* maximum distance of a home from the middle, horizontal, m */
  float reach;                /* mean of the legs' lengths, m */
  uint32_t group_count;       /* of the legs */
  bool has_one_bone_legs;     /* some leg has no knee */
  sbf_vec3 belly[SBRI_BELLY]; /* lowest points of the body: fore and hind, left and right */
  uint32_t belly_count;
  sbf_vec3 low, high; /* bounds at rest, for gaits other than walking */
} sbri_rig_stand;

/* The chain of the gait's undulation. */
typedef struct sbri_rig_wave {
  const sbf_vec3 *joints;       /* front and back end of each bone at rest, asset space */
  const float *middles, *heads; /* middle and head of each from the nose, relative to the length */
  float length;                 /* m */
} sbri_rig_wave;

typedef struct sbri_rig {
  const sbf_asset *asset;
  sbri_rig_bones bones;
  const sbf_gait *gait; /* the asset's first; NULL: the character is moved as a whole */
  sbri_leg legs[SBRI_MAX_LEGS];
  uint32_t leg_count;
  sbri_rig_tails tails;
  sbri_rig_chains chains;
  sbri_rig_springs springs;
  sbri_walks walks;
  sbri_rig_stand stand;
  sbri_wall_volume wall_volume;
  sbri_rig_wave wave;
} sbri_rig;

/* A long foot leans so that the leg stretches or bends by only half of the change that it would need with an
 * upright foot. Returns the distance of hip and ankle, m, if it would be `upright` for an upright foot; and
 * the inverse. */
static inline float sbri_leg_span(const sbri_leg *leg, float scale, float upright) {
  return !leg->has_toe ? upright : 0.5f * (upright + leg->length.rest_span * scale);
}
static inline float sbri_leg_upright(const sbri_leg *leg, float scale, float span) {
  return !leg->has_toe ? span : 2 * span - leg->length.rest_span * scale;
}

/* Rotation with +Y along a bone and +X perpendicular to it, towards `side`. */
sbf_quat sbri_bone_facing(sbf_vec3 along, sbf_vec3 side);

/* Whether a bone is `ancestor` or below it. */
static inline bool sbri_rig_is_below(const sbri_rig *rig, int32_t bone, int32_t ancestor) {
  for (; bone >= 0; bone = rig->bones.parents[bone])
    if (bone == ancestor) return true;
  return false;
}

/* Rotates a bone and its descendants about the bone's head. */
void sbri_rig_rotate_bone(const sbri_rig *rig, uint32_t bone, sbf_quat rotation, sbr_transform *pose);

/* Moves a bone and its descendants. */
void sbri_rig_shift(const sbri_rig *rig, uint32_t bone, sbf_vec3 by, sbr_transform *pose);

#endif
