/* The skeleton as the runtime uses it: constant tables of a rig, shared by all characters of a model.
 *
 * Made by animation/skeleton/rig_make.h. Bone frames are as in the asset: +Y from head to tail. A pose holds
 * every bone's frame in world axes, relative to the character's origin, already scaled. */
#ifndef SBRI_RIG_H
#define SBRI_RIG_H

#include "animation/ik/joint_limit.h"
#include "animation/skeleton/walk_table.h"
#include "sbrun/sbrun.h"

/* What has to have ground under a foot, from its middle: left (+x), right, toe (+z), heel; m. */
typedef struct sbri_sole {
  float left, right, toe, heel;
  float outline[4];    /* the same of all of the foot, seen from above */
  sbf_vec3 corners[4]; /* of what it stands on: outermost towards right heel, left heel, right toe, left toe;
                          y 0 */
} sbri_sole;

/* A leg as the gait uses it: three bones of the chain, and what the rest pose says of it. Or two, a peg: the
 * upper one swings the foot, and how far the foot is from it says nothing of how far the leg may reach. Or
 * four: the third is a long foot that leans over the toe it stands on. */
typedef struct sbri_leg_pole {
  sbf_vec3 direction; /* asset space, rest pose */
  int32_t bone;       /* the pole moves with it; -1: with the root */
  sbf_vec3 position;  /* in that bone's frame, m */
} sbri_leg_pole;

/* Where the sole stands at rest. */
typedef struct sbri_leg_home {
  sbf_vec3 position; /* middle of the sole, asset space, y that of the ankle above the ground */
  int32_t carrier;   /* index among the chains' bones of the one that the leg hangs on; -1: none */
  sbf_vec3 in_bone;  /* the position in that bone's frame, m */
  sbf_vec3 ankle;    /* from the middle of the sole, m; `position` is above that middle */
  sbf_vec3 toe;      /* the same of the toe's head */
} sbri_leg_home;

/* m. */
typedef struct sbri_leg_length {
  float upper, lower;
  float reach;        /* maximum distance of ankle and hip, as far as the knee's limits let it stretch; of a
                         long foot, were that upright: sbri_leg_span */
  float soft_reach;   /* fraction of the reach from which on the leg stretches softly */
  float rest_span;    /* distance of hip and ankle at rest */
  float rest_stretch; /* the same as a fraction of what soft_reach leaves of the reach */
} sbri_leg_length;

typedef struct sbri_leg {
  int32_t upper, lower, foot; /* bones: thigh, shin (-1: a peg), and the one whose head is the ankle */
  int32_t toe;                /* the one that stands, where that is not the foot itself; else 0 */
  sbri_leg_pole pole;
  sbri_leg_home home;
  sbri_leg_length length;
  float toe_copies; /* fraction of the ground's slope that the toe takes; the foot leans, and takes none */
  float copy_rotation;
  uint32_t group;
  bool hind;                             /* hangs on the hips; else on the chest */
  bool fore;                             /* one of those in front, by which the body pitches */
  sbf_quat upper_inverse, lower_inverse; /* undo the rotations of thigh and shin at rest */
  sbri_sole sole;
  bool has_toe;    /* its foot is long */
  bool has_others; /* bones hang on thigh or shin beside the leg's own, as those that share a twist */
  bool is_last; /* all that hangs on the thigh is posed after the leg is solved: nothing but legs moves it */
} sbri_leg;

typedef struct sbri_tail_bone {
  sbf_vec3 step;   /* from its head to the next one's, of the last to its end; asset space, at rest */
  float clearance; /* that its end keeps over the ground, m */
} sbri_tail_bone;

typedef struct sbri_tail {
  const uint32_t *bone_indices; /* bone_count, from the leading one */
  const sbri_tail_bone *bones;  /* bone_count */
  uint32_t bone_count;
  uint32_t first_state; /* place of its first bone among all tails' bones */
  float frequency, damping_ratio, limit;
} sbri_tail;

/* A chain that no tail moves. */
typedef struct sbri_bone_chain {
  const sbf_chain *source;
  uint32_t first_state; /* place of its first bone among all such chains' bones */
} sbri_bone_chain;

enum { SBRI_MAX_LEGS = 16, SBRI_BELLY = 4, SBRI_BUMPERS = 48 };

/* A ball in the body, in the gait's rest pose; asset space. */
typedef struct sbri_bumper {
  sbf_vec3 position;
  float radius;
} sbri_bumper;

/* How much room the body takes among colliders: animation/skeleton/rig_girth.c. */
typedef struct sbri_girth {
  sbri_bumper bumpers[SBRI_BUMPERS]; /* that walls keep out */
  uint32_t bumper_count;
  float step_up;        /* m: the highest that it steps on */
  float radius;         /* m: about the origin, of all of this and of the feet */
  float mass;           /* kg, about: what is lighter gives way to it */
  uint32_t layer, mask; /* of any of its bodies */
} sbri_girth;

/* What turns a bone beside its parent. */
typedef enum sbri_bone_role {
  SBRI_ROLE_NONE,
  SBRI_ROLE_SPINE,
  SBRI_ROLE_HEAD,
  SBRI_ROLE_TAIL,
  SBRI_ROLE_LEG /* below the thigh of a leg that is posed last */
} sbri_bone_role;

/* Share of the body's mass that a bone carries, and its middle in the bone's frame. */
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

/* The standing body: what its legs and its belly measure, asset space. */
typedef struct sbri_rig_stand {
  float hind_z, fore_z;       /* mean z of the homes of fore legs and of the others */
  float hips_y;               /* mean height at which legs begin */
  float half_width;           /* mean |x| of the homes */
  float spread;               /* maximum distance of a home from the middle, horizontal, m */
  float reach;                /* mean of the legs' lengths, m */
  uint32_t group_count;       /* of the legs */
  bool has_pegs;              /* some leg has no knee */
  sbf_vec3 belly[SBRI_BELLY]; /* lowest points of the body: fore and hind, left and right */
  uint32_t belly_count;
  sbf_vec3 low, high; /* bounds at rest, of kinds of gait other than walking */
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
  sbri_walks walks;
  sbri_rig_stand stand;
  sbri_girth girth;
  sbri_rig_wave wave;
} sbri_rig;

/* A long foot leans by half of what the leg would have to stretch or to bend, were it upright: how far the
 * ankle is from the hip then, `upright` being how far it would be, m; and back. */
static inline float sbri_leg_span(const sbri_leg *leg, float scale, float upright) {
  return !leg->has_toe ? upright : 0.5f * (upright + leg->length.rest_span * scale);
}
static inline float sbri_leg_upright(const sbri_leg *leg, float scale, float span) {
  return !leg->has_toe ? span : 2 * span - leg->length.rest_span * scale;
}

/* Rotation whose +Y runs along a bone and whose +X is square to it, towards `side`. */
sbf_quat sbri_bone_facing(sbf_vec3 along, sbf_vec3 side);

/* Whether a bone is another or hangs on it. */
static inline bool sbri_rig_is_below(const sbri_rig *rig, int32_t bone, int32_t ancestor) {
  for (; bone >= 0; bone = rig->bones.parents[bone])
    if (bone == ancestor) return true;
  return false;
}

/* Turns a bone, and all that hangs on it, about the bone's head. */
void sbri_rig_rotate_bone(const sbri_rig *rig, uint32_t bone, sbf_quat rotation, sbr_transform *pose);

/* Moves a bone, and all that hangs on it. */
void sbri_rig_shift(const sbri_rig *rig, uint32_t bone, sbf_vec3 by, sbr_transform *pose);

#endif
