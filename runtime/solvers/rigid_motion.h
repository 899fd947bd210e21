/* A body's motion as a whole: the rigid one that has its momentum and its angular momentum. */
#ifndef SBRI_RIGID_MOTION_H
#define SBRI_RIGID_MOTION_H

#include "core/runtime_model.h"

typedef struct sbri_rigid_motion {
  float mass_kg;
  sbf_vec3 center, velocity, spin; /* m, m/s, rad/s about the centre */
} sbri_rigid_motion;

/* Of the body's free points; arrays of its island. */
sbri_rigid_motion sbri_rigid_motion_find(
    const sbri_island *island, const sbri_body *body, const sbri_point *positions, const float *velocities);

/* Keeps the share `kept` of what each velocity differs from that motion, which stays as it is. */
void sbri_rigid_motion_damp(const sbri_island *island, const sbri_body *body, const sbri_point *positions,
    float *velocities, float kept);

#endif
