/* Frames of a joint, the coordinates of one relative to the other (spec 8.3), and their rates for the bodies'
 * motion. */
#ifndef SBRI_JOINT_FRAMES_H
#define SBRI_JOINT_FRAMES_H

#include "animation/ik/joint_limit.h"
#include "model/rigid_model.h"
#include "sbrun/sbrun.h"

typedef struct sbri_joint_frames {
  sbf_vec3 arms[SBRI_SIDES]; /* from the bodies' centres of mass to the frames' origins */
  sbf_vec3 separation;       /* from frame a's origin to frame b's */
  sbf_vec3 axes[3];          /* of frame a */
  sbf_quat rotation;         /* Q: rotation of frame b in frame a */
  float half_tangent[2];     /* y and z of S's axis times the tangent of half its angle */
  bool has_angles;           /* the next two are computed on demand */
  sbri_swing_twist angles;
  float swing; /* angle of the swing */
  sbf_vec3
      rope_directions[SBRI_SIDES]; /* of a pulley: unit vectors from the anchors of its ropes to the frames */
  float ropes[SBRI_SIDES];         /* of a pulley, m */
} sbri_joint_frames;

/* `poses`: of the two bodies' frames; that of the anchor if a body is absent. `anchor`: likewise, for
 * pulleys. `fine`: low-order part of the position of b minus that of a. All in one space. */
sbri_joint_frames sbri_joint_frames_of(const sbri_rigid_joint *joint,
    const sbr_transform *const poses[SBRI_SIDES], const sbr_transform *anchor, sbf_vec3 fine);

/* Only the vector from frame a's origin to frame b's. */
sbf_vec3 sbri_joint_separation(
    const sbri_rigid_joint *joint, const sbr_transform *const poses[SBRI_SIDES], sbf_vec3 fine);

float sbri_joint_coordinate(
    const sbri_rigid_joint *joint, sbri_joint_frames *joint_frames, sbf_joint_axis axis);
/* The coordinate of a locked axis: 0 at the same state and with the same rate there, but for an angle twice
 * the tangent of its half. */
float sbri_joint_locked_coordinate(const sbri_joint_frames *joint_frames, sbf_joint_axis axis);

/* The coordinate's rate is rates[A].(v_a, w_a) + rates[B].(v_b, w_b), with the velocities of the centres of
 * mass and the angular velocities. */
void sbri_joint_compute_gradient(const sbri_rigid_joint *joint, sbri_joint_frames *joint_frames,
    sbf_joint_axis axis, float rates[SBRI_SIDES][6]);

static inline bool sbri_axis_is_angular(sbf_joint_axis axis) {
  return axis == SBF_JOINT_AXIS_TWIST || axis == SBF_JOINT_AXIS_SWING || axis == SBF_JOINT_AXIS_SWING_Y ||
         axis == SBF_JOINT_AXIS_SWING_Z;
}

#endif
