/* Points of a character's parts, each with the bone that moves it. */
#ifndef SBRI_BONE_POINTS_H
#define SBRI_BONE_POINTS_H

#include "animation/skeleton/rig.h"

/* `position`: in the rest pose, asset metres. `bone`: the bone that moves it, with the largest weight. */
typedef void sbri_point_visitor(void *user, const sbri_rig *rig, int32_t bone, sbf_vec3 position);

/* Calls `take` for the vertices of all skins; without skins, for the surfaces of soft bodies on bones. */
void sbri_rig_visit_points(const sbri_rig *rig, sbri_point_visitor *take, void *user);

#endif
