/* Torque-free rotation of several bodies, one per lane: bit for bit sbri_free_turn of each. */
#ifndef SBRI_FREE_TURN_H
#define SBRI_FREE_TURN_H

#include "math/wide.h"
#include "rigid/rigid_state.h"

/* One body per lane. Before: rotations and angular momenta, as set by sbri_free_turning_put. After: the final
 * rotations, and the mean angular velocities in place of the momenta. */
typedef struct sbri_free_turning {
  float x[SBRI_LANES], y[SBRI_LANES], z[SBRI_LANES], w[SBRI_LANES];
  float angular_momentum[3][SBRI_LANES];
  float inverse_inertia[3][SBRI_LANES]; /* inverse principal moments */
} sbri_free_turning;

void sbri_free_turning_put(sbri_free_turning *turning, int lane, const sbri_rigid_body *body,
    sbf_quat rotation, sbf_vec3 angular_momentum);
void sbri_free_turns(sbri_free_turning *turning, float step_s);

#endif
