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
  /* By sbri_joint_limit_ready: what tells without an arctangent that a rotation is well within. Zeros tell
   * nothing. */
  float twist_tangents[2]; /* of half its bounds */
  float cone_square;       /* of the sine of half the cone */
} sbri_joint_limit;

/* Q = S T, with T about +X and S about an axis square to it. */
typedef struct sbri_swing_twist {
  float twist;            /* rad, in (-pi, pi] */
  float swing_y, swing_z; /* of the rotation vector of S, rad; at most pi long */
} sbri_swing_twist;

sbri_swing_twist sbri_swing_twist_of(sbf_quat q);
sbf_quat sbri_swing_twist_join(sbri_swing_twist parts);

/* Fills what the bounds make of themselves. A limit without it acts the same, slower. */
void sbri_joint_limit_ready(sbri_joint_limit *limit);

/* By how much L breaks its limit, rad; 0 within. */
float sbri_joint_limit_excess(const sbri_joint_limit *limit, sbf_quat local);

/* Whether it breaks it by no more than `slack`, from 1e-5 rad on. */
bool sbri_joint_limit_holds(const sbri_joint_limit *limit, sbf_quat local, float slack);

/* The nearest allowed rotation, part by part. Within the limit, or off by no more than 1e-5 rad, `local`
 * comes back as it is, to the bit; so a second call changes nothing. `limit` may be NULL: free. */
sbf_quat sbri_joint_limit_clamp(const sbri_joint_limit *limit, sbf_quat local);

#endif
