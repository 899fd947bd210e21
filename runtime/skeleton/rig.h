/* The skeleton as the runtime uses it: constant tables of a rig, shared by all characters of a model.
 *
 * Made by skeleton/rig_make.h. Bone frames are as in the asset: +Y from head to tail. A pose holds every
 * bone's frame in world axes, relative to the character's origin, already scaled. */
#ifndef SBRI_RIG_H
#define SBRI_RIG_H

#include "ik/joint_limit.h"
#include "sbrun/sbrun.h"
#include "skeleton/walk_table.h"

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
typedef struct sbri_leg {
  int32_t upper, lower, foot; /* bones: thigh, shin (-1: a peg), and the one whose head is the ankle */
  int32_t toe;                /* the one that stands, where that is not the foot itself; else 0 */
  sbf_vec3 pole;              /* asset space, rest pose */
  int32_t pole_bone;          /* the pole moves with it; -1: with the root */
  sbf_vec3 pole_position;     /* in that bone's frame, m */
  sbf_vec3 home; /* middle of the sole at rest, asset space, y that of the ankle above the ground */
  float upper_length, lower_length;
  float reach; /* farthest that the ankle may be from the hip, as far as the knee's limits let it stretch, m;
                  of a long foot, were that upright: sbri_leg_span */
  float rest_span;    /* distance of hip and ankle at rest, m */
  float toe_copies;   /* share of how the ground lies that the toe takes; the foot leans, and takes none */
  float rest_stretch; /* distance of hip and ankle at rest, in shares of what `soft_reach` leaves of the reach
                       */
  uint32_t group;
  bool hind; /* hangs on the hips; else on the chest */
  bool fore; /* one of those in front, by which the body pitches */
  float copy_rotation, soft_reach;
  sbf_quat upper_back, lower_back; /* undo how thigh and shin face at rest */
  int32_t carrier;                 /* place among the chains' bones of the one it hangs on; -1: none */
  sbf_vec3 home_in_bone;           /* in that bone's frame, m */
  sbf_vec3 ankle;                  /* from the middle of the sole, m; `home` is above that middle */
  sbf_vec3 toe_position;           /* the same of the toe's head */
  sbri_sole sole;
  bool has_toe;    /* its foot is long */
  bool has_others; /* bones hang on thigh or shin beside the leg's own, as those that share a twist */
  bool last; /* all that hangs on the thigh is posed after the leg is solved: nothing but legs moves it */
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

/* How much room the body takes among colliders: skeleton/rig_girth.c. */
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

typedef struct sbri_rig {
  const sbf_asset *asset;
  uint32_t bone_count;
  const int32_t *parents;          /* bone_count; -1: root */
  const sbr_transform *rest;       /* bone_count, asset space */
  const sbr_transform *rest_local; /* bone_count, in the parent's rest frame; a root's as it is */
  const sbr_transform *base_local; /* the same in the gait's rest pose */
  const float *spine_fraction; /* bone_count: 0 turns with the hips, 1 with the chest, -1 with its parent */
  const uint8_t *roles;        /* bone_count, of sbri_bone_role */
  const sbri_joint_limit *limits; /* bone_count, against the parent */
  const uint32_t *subtree;        /* bone_count: the bones so ordered that what hangs on one follows it */
  const uint32_t *subtree_begin, *subtree_end; /* bone_count: a bone's own stretch of them */
  const sbri_bone_mass *masses;                /* bone_count, shares summing to 1, or all 0 */

  const sbf_gait *gait; /* the asset's first; NULL: the character is moved as a whole */
  sbri_leg legs[SBRI_MAX_LEGS];
  uint32_t leg_count;
  const sbri_tail *tails;
  uint32_t tail_count, tail_bone_count;
  const sbri_bone_chain *chains;
  uint32_t chain_count, chain_bone_count;
  sbri_walks walks;
  float hind_z, fore_z;       /* mean z of the homes of fore legs and of the others, asset space */
  float hips_y;               /* mean height at which legs begin */
  float half_width;           /* mean |x| of the homes */
  float spread;               /* greatest distance of a home from the middle, level, m */
  float reach;                /* mean of the legs' lengths, m */
  uint32_t group_count;       /* of the legs */
  bool has_pegs;              /* some leg has no knee */
  sbf_vec3 belly[SBRI_BELLY]; /* the lowest of the body fore and hind, left and right; asset space */
  uint32_t belly_count;
  sbri_girth girth;
  sbf_vec3 low, high; /* bounds at rest, asset space, of kinds of gait other than walking */
  /* The chain of the gait's undulation: front and back end of each bone at rest, asset space; where the
   * middle and the head of each are, from the nose, relative to the length; that, m. */
  const sbf_vec3 *wave_joints;
  const float *wave_middles, *wave_heads;
  float wave_length;
} sbri_rig;

/* A long foot leans by half of what the leg would have to stretch or to bend, were it upright: how far the
 * ankle is from the hip then, `upright` being how far it would be, m; and back. */
static inline float sbri_leg_span(const sbri_leg *leg, float scale, float upright) {
  return !leg->has_toe ? upright : 0.5f * (upright + leg->rest_span * scale);
}
static inline float sbri_leg_upright(const sbri_leg *leg, float scale, float span) {
  return !leg->has_toe ? span : 2 * span - leg->rest_span * scale;
}

/* Rotation whose +Y runs along a bone and whose +X is square to it, towards `side`. */
sbf_quat sbri_bone_facing(sbf_vec3 along, sbf_vec3 side);

/* Whether a bone is another or hangs on it. */
static inline bool sbri_rig_is_below(const sbri_rig *rig, int32_t bone, int32_t ancestor) {
  for (; bone >= 0; bone = rig->parents[bone])
    if (bone == ancestor) return true;
  return false;
}

/* Turns a bone, and all that hangs on it, about the bone's head. */
void sbri_rig_turn(const sbri_rig *rig, uint32_t bone, sbf_quat rotation, sbr_transform *pose);

/* Moves a bone, and all that hangs on it. */
void sbri_rig_shift(const sbri_rig *rig, uint32_t bone, sbf_vec3 by, sbr_transform *pose);

#endif
