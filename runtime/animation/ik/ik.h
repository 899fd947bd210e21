/* Inverse kinematics of a chain of joints: shared parts, and the solvers.
 *
 * A chain has n joints; the parent of the first one is `base`, and the head of the last one is the end. The
 * solvers start from the given rotations and write the result there. Every solver respects the joints' limits
 * at any time. None allocates. */
#ifndef SBRI_IK_H
#define SBRI_IK_H

#include "animation/ik/joint_limit.h"
#include "sbrun/sbrun.h"

enum { SBRI_IK_MAX_JOINTS = 64 };

typedef struct sbri_ik_joint {
  sbf_vec3 offset;               /* of its head, in the frame of the previous joint; m */
  sbf_quat rotation;             /* relative to the previous joint */
  const sbri_joint_limit *limit; /* NULL: free */
  sbf_quat comfort;              /* the rotation it prefers */
  float comfort_weight;          /* 0: none, to 1 */
  sbf_vec3 comfort_slack; /* fraction of the weight that is missing about each of the joint's axes, 0 to 1 */
} sbri_ik_joint;

typedef struct sbri_ik_chain {
  sbr_transform base;
  sbri_ik_joint *joints;
  uint32_t count; /* 2 to SBRI_IK_MAX_JOINTS */
  sbf_vec3 target;
  sbf_quat target_rotation;
  float copy_rotation; /* fraction of it that the last joint takes, 0 to 1 */
  bool has_pole;
  sbf_vec3 pole;
  float soft_reach; /* [0, 1) */
  float tolerance;  /* m */
  uint32_t iterations;
} sbri_ik_chain;

typedef struct sbri_ik_result {
  uint32_t iterations; /* number of iterations */
  float error;         /* distance of the end to the softened target, m */
  bool reached;        /* within tolerance */
} sbri_ik_result;

/* ---- The solvers. Each one softens the target near full reach, starts from the comforts, rotates the chain
 * to its pole if it has one, and lets the last joint copy the target's rotation. ---- */

/* Three joints; the law of cosines. If limits forbid its result, continues with `sbri_ccd`. */
sbri_ik_result sbri_ik_two_bone(sbri_ik_chain *chain);
/* Cyclic coordinate descent (Wang and Chen 1991): joint after joint, from the end, points the end at the
 * target. */
sbri_ik_result sbri_ccd(sbri_ik_chain *chain);
/* Forward and backward reaching (Aristidou and Lasenby 2011). A target out of reach takes one iteration. */
sbri_ik_result sbri_fabrik(sbri_ik_chain *chain);
/* Damped least squares (Wampler 1986; damping by the error, Sugihara 2011). Comforts act in the null space of
 * the target; the target's rotation is part of the system. */
sbri_ik_result sbri_damped_least_squares(sbri_ik_chain *chain);
/* The chain is on a quadratic curve to the target, bent towards the pole according to its length. */
sbri_ik_result sbri_ik_spline(sbri_ik_chain *chain);
sbri_ik_result sbri_ik_solve(sbf_ik_solver solver, sbri_ik_chain *chain);

/* ---- FABRIK of a tree ---- */

typedef struct sbri_ik_goal {
  uint32_t joint;
  sbf_vec3 position;
} sbri_ik_goal;

typedef struct sbri_ik_tree {
  sbr_transform base;
  sbri_ik_joint *joints;   /* (count) parents before children; the first is the root */
  const uint32_t *parents; /* (count) parent of each joint; that of the first is ignored */
  uint32_t count;
  const sbri_ik_goal *goals;
  uint32_t goal_count;
  float tolerance;
  uint32_t iterations;
} sbri_ik_tree;

/* Several ends at once; `error` is the largest. If not all goals can be reached the error is distributed. */
sbri_ik_result sbri_fabrik_tree(sbri_ik_tree *tree);

/* ---- Shared by the solvers ---- */

/* Distance softened towards the full reach: the identity up to (1 - soft) * reach, then a quadratic with the
 * same slope that meets the full reach, with slope 0, twice the range further out. */
float sbri_soften_reach(float distance, float reach, float soft);

/* World frames of the joints. */
void sbri_ik_compute_frames(const sbri_ik_chain *chain, sbr_transform *frames);
float sbri_ik_reach(const sbri_ik_chain *chain);
/* Applies the comforts, bends a straight chain towards its target, rotates it to its pole. Fills `frames` and
 * returns the softened target. */
sbf_vec3 sbri_ik_begin(sbri_ik_chain *chain, sbr_transform *frames);
/* The part of a rotation that a comfort requires, a rotation vector in the joint's own axes. */
sbf_vec3 sbri_ik_comfort_fraction(const sbri_ik_joint *joint, sbf_vec3 turn);
bool sbri_ik_comfort_is_even(const sbri_ik_joint *joint);
/* Rotates joint `index` by a rotation in world axes, as far as its limit allows. */
void sbri_ik_rotate_bone(
    sbri_ik_chain *chain, uint32_t index, sbf_quat rotation, const sbr_transform *frames);
/* Moves the joints as close to `positions` (count of them, from the second on) as lengths and limits allow.
 */
void sbri_ik_through(sbri_ik_chain *chain, const sbf_vec3 *positions, sbr_transform *frames);
/* Applies the pole and the rotation of the end; returns the result with `iterations`. */
sbri_ik_result sbri_ik_finish(
    sbri_ik_chain *chain, sbf_vec3 target, sbr_transform *frames, uint32_t iterations);

#endif
