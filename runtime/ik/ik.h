/* Inverse kinematics of a chain of joints: what the solvers share, and the solvers.
 *
 * A chain is n joints, the first hanging on `base`, the last the one whose head is to reach the target. Its
 * rotations are what is solved for: solvers start from those given and leave the answer there. Every solver
 * keeps the joints' limits at every moment. None allocates. */
#ifndef SBRI_IK_H
#define SBRI_IK_H

#include "ik/joint_limit.h"
#include "sbrun/sbrun.h"

enum { SBRI_IK_MAX_JOINTS = 64 };

typedef struct sbri_ik_joint {
  sbf_vec3 offset;               /* of its head, in the frame of the joint before; m */
  sbf_quat rotation;             /* against the joint before */
  const sbri_joint_limit *limit; /* NULL: free */
  sbf_quat comfort;              /* the rotation it prefers */
  float comfort_weight;          /* 0: none, to 1 */
  sbf_vec3 comfort_slack;        /* share of the weight that is missing about the joint's own axes, 0 to 1 */
} sbri_ik_joint;

typedef struct sbri_ik_chain {
  sbr_transform base;
  sbri_ik_joint *joints;
  uint32_t count; /* 2 to SBRI_IK_MAX_JOINTS */
  sbf_vec3 target;
  sbf_quat target_rotation;
  float copy_rotation; /* share of it that the last joint takes, 0 to 1 */
  bool has_pole;
  sbf_vec3 pole;
  float soft_reach; /* [0, 1) */
  float tolerance;  /* m */
  uint32_t iterations;
} sbri_ik_chain;

typedef struct sbri_ik_result {
  uint32_t iterations; /* passes that were made */
  float error;         /* distance of the end to the target, as eased; m */
  bool reached;        /* within tolerance */
} sbri_ik_result;

/* ---- The solvers. Each eases the target near full reach, starts from the comforts, turns the chain to its
 * pole where it has one, and lets the last joint copy the target's rotation. ---- */

/* Three joints; the law of cosines. Where limits forbid its answer, `sbri_ccd` goes on from it. */
sbri_ik_result sbri_ik_two_bone(sbri_ik_chain *chain);
/* Cyclic coordinate descent (Wang and Chen 1991): joint after joint, from the end, points the end at the
 * target. */
sbri_ik_result sbri_ccd(sbri_ik_chain *chain);
/* Forward and backward reaching (Aristidou and Lasenby 2011). A target out of reach takes one pass. */
sbri_ik_result sbri_fabrik(sbri_ik_chain *chain);
/* Damped least squares (Wampler 1986; damping by the error, Sugihara 2011). Comforts act in the null space of
 * the target all along; the target's rotation is part of what is solved. */
sbri_ik_result sbri_damped_least_squares(sbri_ik_chain *chain);
/* The chain lies on a quadratic curve to the target, bowed towards the pole as far as its length asks. */
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
  const uint32_t *parents; /* (count) of each joint; the first's means nothing */
  uint32_t count;
  const sbri_ik_goal *goals;
  uint32_t goal_count;
  float tolerance;
  uint32_t iterations;
} sbri_ik_tree;

/* Several ends at once; `error` is the worst of them. Where not all can be reached they share the miss. */
sbri_ik_result sbri_fabrik_tree(sbri_ik_tree *tree);

/* ---- Shared by the solvers ---- */

/* Distance eased towards the full reach: the identity up to (1 - soft) * reach, then a quadratic of the same
 * slope there that meets the full reach, with no slope, twice the range further out. */
float sbri_soften_reach(float distance, float reach, float soft);

/* World frames of the joints. */
void sbri_ik_compute_frames(const sbri_ik_chain *chain, sbr_transform *frames);
float sbri_ik_reach(const sbri_ik_chain *chain);
/* Takes the comforts, bends a chain that is straight towards its target, turns it to its pole. Fills `frames`
 * and returns the eased target. */
sbf_vec3 sbri_ik_begin(sbri_ik_chain *chain, sbr_transform *frames);
/* What a comfort asks for of a turn towards it, a rotation vector in the joint's own axes. */
sbf_vec3 sbri_ik_comfort_fraction(const sbri_ik_joint *joint, sbf_vec3 turn);
bool sbri_ik_comfort_is_even(const sbri_ik_joint *joint);
/* Turns joint `index` by a rotation in world axes, as far as its limit allows. */
void sbri_ik_turn(sbri_ik_chain *chain, uint32_t index, sbf_quat rotation, const sbr_transform *frames);
/* Brings the joints as near to `positions` (count of them, from the second on) as lengths and limits allow.
 */
void sbri_ik_through(sbri_ik_chain *chain, const sbf_vec3 *positions, sbr_transform *frames);
/* Pole and rotation of the end; then the result, `iterations` taken over. */
sbri_ik_result sbri_ik_finish(
    sbri_ik_chain *chain, sbf_vec3 target, sbr_transform *frames, uint32_t iterations);

#endif
