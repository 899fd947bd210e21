/* Inverse kinematics of two bones in closed form: the law of cosines, the knee in the plane of the pole. */
#ifndef SBRI_TWO_BONE_H
#define SBRI_TWO_BONE_H

#include "sbrun/sbrun.h"

typedef struct sbri_two_bone_result {
  sbf_vec3 knee, ankle; /* ankle: the target, or the nearest point within reach */
  bool reached;
} sbri_two_bone_result;

/* Lengths > 0. `soft_reach` in [0, 1): fraction of the full reach over which extension is softened, so that
 * the knee does not snap straight; 0: none. The target is met within 1e-6 of the reach if it is nearer than
 * that range. The pole may be anywhere: if it defines no plane, the plane through `fallback` is used. */
sbri_two_bone_result sbri_two_bone(sbf_vec3 hip, sbf_vec3 target, sbf_vec3 pole, sbf_vec3 fallback,
    float upper, float lower, float soft_reach);

#endif
