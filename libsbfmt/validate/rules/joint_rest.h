/* A joint in the rest pose: what its coordinates are there, and which of them it leaves free. */
#ifndef SBFI_JOINT_REST_H
#define SBFI_JOINT_REST_H

#include "mechanics/joint_freedom.h"

typedef struct sbfi_joint_rest {
  double at[SBF_JOINT_AXIS_COUNT]; /* by sbf_joint_axis: m or rad; `distance` of a pulley is its rope */
  double rope_a, rope_b;           /* m, of a pulley: from each body's frame to where its rope hangs */
  double arm;                      /* m, how far the frames lie from the bodies' centres together */
} sbfi_joint_rest;

sbfi_joint_rest sbfi_joint_rest_of(const sbf_asset *asset, const sbf_joint *joint);

#endif
