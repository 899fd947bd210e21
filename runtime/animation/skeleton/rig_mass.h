/* Mass of each bone, by its visible volume. */
#ifndef SBRI_RIG_MASS_H
#define SBRI_RIG_MASS_H

#include "animation/skeleton/rig.h"

void sbri_rig_find_masses(const sbri_rig *rig, sbri_bone_mass *masses);

/* The centre of mass of a pose; false if masses are unknown. */
bool sbri_rig_center(const sbri_rig *rig, const sbr_transform *pose, float scale, sbf_vec3 *center);

#endif
