/* Chains for the tests of inverse kinematics. */
#ifndef IK_CHAINS_H
#define IK_CHAINS_H

#include "animation/ik/ik.h"

enum { IK_CHAIN_JOINTS = 11 };

typedef struct ik_chain_fixture {
  sbri_ik_chain chain;
  sbri_ik_joint joints[IK_CHAIN_JOINTS];
  sbri_joint_limit limit; /* of all joints but the first and the last, where used */
} ik_chain_fixture;

/* Ten links of 1 m, straight up from the origin, a tolerance of 1 mm, 200 passes. */
void ik_chain_straight(ik_chain_fixture *f);
/* The same bent by 0.2 rad at every joint, about X. */
void ik_chain_bent(ik_chain_fixture *f);
/* Every joint but the first and the last may bend by `most` rad. */
void ik_chain_limit(ik_chain_fixture *f, float max);
/* By how much its worst joint breaks its limit, rad. */
float ik_chain_excess(const ik_chain_fixture *f);

/* The same numbers on every machine: -1 to 1. */
float ik_random(uint32_t *seed);
sbf_vec3 ik_random_place(uint32_t *seed, float radius);
sbf_quat ik_random_rotation(uint32_t *seed);

typedef sbri_ik_result ik_method(sbri_ik_chain *chain);
/* What every iterative method must do; `max_passes` is the mean over reachable targets it may take. */
void ik_expect_reaches(ik_method *solve, float max_passes, int min_of_200);
void ik_expect_keeps_limits(ik_method *solve, int min_of_200);
/* The same of hinges whose axes turn by turn are square to each other. */
void ik_expect_keeps_hinges(ik_method *solve, int min);
void ik_expect_stretches_to(ik_method *solve);
void ik_expect_bows_to_pole(ik_method *solve);
void ik_expect_copies_rotation(ik_method *solve);
void ik_expect_survives(ik_method *solve);
/* The last tenth of the reach is eased: the end never goes back as its target goes out, nor jumps. `off` is
 * what the method leaves of a chain of 10 m that is nearly straight. */
void ik_expect_eases(ik_method *solve, float off);

#endif
