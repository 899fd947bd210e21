/* Torque-free rotation of several bodies, one per lane: bit for bit sbri_torque_free_rotation of each. */
#ifndef SBRI_FREE_TURN_H
#define SBRI_FREE_TURN_H

#include "math/wide.h"
#include "rigid/rigid_state.h"

/* One body per lane. Before: rotations and angular momenta, as set by sbri_torque_free_lanes_set. After: the
 * final rotations, and the mean angular velocities in place of the momenta. */
typedef struct sbri_torque_free_lanes {
  float x[SBRI_LANES], y[SBRI_LANES], z[SBRI_LANES], w[SBRI_LANES];
  float angular_momentum[3][SBRI_LANES];
  float inverse_inertia[3][SBRI_LANES]; /* inverse principal moments */
} sbri_torque_free_lanes;

void sbri_torque_free_lanes_set(sbri_torque_free_lanes *turning, int lane, const sbri_rigid_body *body,
    sbf_quat rotation, sbf_vec3 angular_momentum);
void sbri_torque_free_lanes_rotate(sbri_torque_free_lanes *turning, float step_s);

#endif
