/* Angle limits of a bone against its parent: twist and swing, as joints state them (spec 8.3). */
#ifndef SBRI_JOINT_LIMIT_H
#define SBRI_JOINT_LIMIT_H

#include "math/quat_log.h"

/* The rotation L of a bone against its parent is seen in the joint's frames as Q = before L after. */
typedef struct sbri_joint_limit {
  sbf_quat before, after;
  float twist[2], swing_y[2], swing_z[2]; /* least and greatest, rad */
  float cone;                             /* half angle, rad */
  bool active;                            /* false: the bone turns freely and the rest means nothing */
} sbri_joint_limit;

/* Q = S T, with T about +X and S about an axis square to it. */
typedef struct sbri_swing_twist {
  float twist;            /* rad, in (-pi, pi] */
  float swing_y, swing_z; /* of the rotation vector of S, rad; at most pi long */
} sbri_swing_twist;

sbri_swing_twist sbri_swing_twist_of(sbf_quat q);
sbf_quat sbri_swing_twist_join(sbri_swing_twist parts);

/* By how much L breaks its limit, rad; 0 within. */
float sbri_joint_limit_excess(const sbri_joint_limit *limit, sbf_quat local);

/* The nearest allowed rotation, part by part. Within the limit, or off by no more than 1e-5 rad, `local`
 * comes back as it is, to the bit; so a second call changes nothing. `limit` may be NULL: free. */
sbf_quat sbri_joint_limit_clamp(const sbri_joint_limit *limit, sbf_quat local);

#endif
