#include "validate/rules/joint_rest.h"

#include "validate/rules/pose.h"

typedef struct frame {
  sbfi_d3 origin;
  sbfi_rotation rotation;
} frame;

/* A body's axes at rest are those of asset space; without a body the frame is in asset space. */
static frame frame_of(const sbf_asset *asset, int32_t body, const sbf_frame *local) {
  sbfi_d3 center = {0, 0, 0};
  if (body >= 0) center = sbfi_d3_of(asset->rigid_bodies.at[body].center);
  return (frame){sbfi_d3_add(center, sbfi_d3_of(local->position)), sbfi_rotation_of(local->rotation)};
}

/* Q = S T with T about +X: the angles that the specification calls twist and swing. */
static void split(sbfi_rotation q, double *at) {
  if (q.w < 0) q = (sbfi_rotation){sbfi_d3_scale(q.v, -1), -q.w};
  double length = sqrt(q.w * q.w + q.v.x * q.v.x);
  sbfi_rotation twist = {{1, 0, 0}, 0}; /* the twist is undefined at a swing of 180 degrees */
  if (length > 0) twist = (sbfi_rotation){{q.v.x / length, 0, 0}, q.w / length};
  sbfi_rotation swing = sbfi_rotation_product(q, sbfi_rotation_inverse(twist));
  double sine = sbfi_d3_length(swing.v), angle = 2 * atan2(sine, fabs(swing.w));
  double scale = sine > 0 ? (swing.w < 0 ? -angle : angle) / sine : 0;
  at[SBF_JOINT_AXIS_TWIST] = 2 * atan2(twist.v.x, twist.w);
  at[SBF_JOINT_AXIS_SWING_Y] = swing.v.y * scale;
  at[SBF_JOINT_AXIS_SWING_Z] = swing.v.z * scale;
  at[SBF_JOINT_AXIS_SWING] = angle;
}

sbfi_joint_rest sbfi_joint_rest_of(const sbf_asset *asset, const sbf_joint *joint) {
  sbfi_joint_rest rest = {{0}, 0, 0, 0};
  frame a = frame_of(asset, joint->body_a, &joint->frame_a),
        b = frame_of(asset, joint->body_b, &joint->frame_b);
  sbfi_rotation to_a = sbfi_rotation_inverse(a.rotation);
  sbfi_d3 o = sbfi_rotated(to_a, sbfi_d3_sub(b.origin, a.origin));
  rest.at[SBF_JOINT_AXIS_LINEAR_X] = o.x;
  rest.at[SBF_JOINT_AXIS_LINEAR_Y] = o.y;
  rest.at[SBF_JOINT_AXIS_LINEAR_Z] = o.z;
  rest.at[SBF_JOINT_AXIS_DISTANCE] = sbfi_d3_length(o);
  split(sbfi_rotation_product(to_a, b.rotation), rest.at);
  rest.arm = sbfi_d3_length(sbfi_d3_of(joint->frame_a.position)) +
             sbfi_d3_length(sbfi_d3_of(joint->frame_b.position));
  if (joint->kind == SBF_JOINT_KIND_PULLEY) {
    rest.rope_a = sbfi_d3_length(sbfi_d3_sub(a.origin, sbfi_d3_of(joint->pulley_a)));
    rest.rope_b = sbfi_d3_length(sbfi_d3_sub(b.origin, sbfi_d3_of(joint->pulley_b)));
    rest.at[SBF_JOINT_AXIS_DISTANCE] = rest.rope_a + (double)joint->pulley_ratio * rest.rope_b;
  }
  return rest;
}
