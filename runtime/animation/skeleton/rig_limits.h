/* Limits of bones, from the joints of the bodies that move with them. */
#ifndef SBRI_RIG_LIMITS_H
#define SBRI_RIG_LIMITS_H

#include "animation/skeleton/rig.h"

void sbri_rig_find_limits(const sbri_rig *rig, sbri_joint_limit *limits);

/* Maximum distance of hip and ankle within the knee's limit, m. */
float sbri_rig_leg_reach(const sbri_rig *rig, const sbri_leg *leg);

/* Maximum limit violation of a bone in a pose, rad. */
float sbri_rig_limit_excess(const sbri_rig *rig, const sbr_transform *pose);

#endif
