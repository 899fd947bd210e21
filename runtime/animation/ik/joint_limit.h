/* Angle limits of a bone relative to its parent: twist and swing, as joints state them (spec 8.3). */
#ifndef SBRI_JOINT_LIMIT_H
#define SBRI_JOINT_LIMIT_H

#include "math/quat_log.h"

/* The rotation L of a bone relative to its parent is Q = before L after in the joint's frames. */
typedef struct sbri_joint_limit {
  sbf_quat before, after;
  float twist[2], swing_y[2], swing_z[2]; /* minimum and maximum, rad */
  float cone;                             /* half angle, rad */
  bool active;                            /* false: the bone rotates freely and the rest is ignored */
  /* Set by sbri_joint_limit_ready: a test without arctangents that a rotation is well within the limit. Zeros
   * disable it. */
  float twist_tangents[2]; /* of half its bounds */
  float cone_square;       /* of the sine of half the cone angle */
} sbri_joint_limit;

/* Q = S T, with T about +X and S about an axis perpendicular to it. */
typedef struct sbri_swing_twist {
  float twist;            /* rad, in (-pi, pi] */
  float swing_y, swing_z; /* of the rotation vector of S, rad; at most pi long */
} sbri_swing_twist;

sbri_swing_twist sbri_swing_twist_of(sbf_quat q);
sbf_quat sbri_swing_twist_join(sbri_swing_twist parts);

/* Prepares the fast test. A limit without it gives the same results, more slowly. */
void sbri_joint_limit_ready(sbri_joint_limit *limit);

/* Violation of the limit by L, rad; 0 within. */
float sbri_joint_limit_excess(const sbri_joint_limit *limit, sbf_quat local);

/* Whether the violation is at most `slack`, from 1e-5 rad on. */
bool sbri_joint_limit_holds(const sbri_joint_limit *limit, sbf_quat local, float slack);

/* The nearest allowed rotation, angle by angle. If `local` is within the limit, or beyond it by at most 1e-5
 * rad, it is returned unchanged to the bit; so a second call changes nothing. `limit` may be NULL: free. */
sbf_quat sbri_joint_limit_clamp(const sbri_joint_limit *limit, sbf_quat local);

#endif
