/* A joint in the rest pose: its coordinates, and which of them are free. */
#ifndef SBFI_JOINT_REST_H
#define SBFI_JOINT_REST_H

#include "mechanics/joint_freedom.h"

typedef struct sbfi_joint_rest {
  /* by sbf_joint_axis: m or rad; `distance` of a pulley is its rope length */
  double at[SBF_JOINT_AXIS_COUNT];
  double rope_a, rope_b; /* m, of a pulley: from each body's frame to the anchor of its rope */
  double arm;            /* m, sum of the distances of the frames from the bodies' centres */
} sbfi_joint_rest;

sbfi_joint_rest sbfi_joint_rest_of(const sbf_asset *asset, const sbf_joint *joint);

#endif
