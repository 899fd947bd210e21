/* Inverse kinematics of two bones in closed form: the law of cosines, the knee in the plane of the pole. */
#ifndef SBRI_TWO_BONE_H
#define SBRI_TWO_BONE_H

#include "sbrun/sbrun.h"

typedef struct sbri_two_bone_result {
  sbf_vec3 knee, ankle; /* ankle: the target, or as near to it as the chain reaches */
  bool reached;
} sbri_two_bone_result;

/* Lengths > 0. `soft_reach` in [0, 1): share of the full reach over which extension is eased, so that the
 * knee does not snap straight; 0: none. The target is met within 1e-6 of the reach while it lies nearer than
 * that range. The pole may lie anywhere: where it gives no plane, the plane through `fallback` is taken. */
sbri_two_bone_result sbri_two_bone(sbf_vec3 hip, sbf_vec3 target, sbf_vec3 pole, sbf_vec3 fallback,
    float upper, float lower, float soft_reach);

#endif
