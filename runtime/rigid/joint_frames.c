/* Rates of the angles. With Q = S T in frame a, w the angular velocity of b relative to a there, n the unit
 * axis of S (its x is 0), s its angle and t = tan(s / 2):
 *
 *   twist'  = w.(1, n_z t, -n_y t), from twist = 2 atan2(Q.x, Q.w) and Q' = w Q / 2;
 *   swing'  = w.n: twisting b about its own x, which is perpendicular to n, does not change it;
 *   swing_y' = n_y (w.n) + s e_y (cot(s) (w.e) - w.x), e = n x X: the axis n rotates about X as b's x circles
 *               it. */
#include "rigid/joint_frames.h"

sbf_vec3 sbri_joint_separation(
    const sbri_rigid_joint *joint, const sbr_transform *const poses[SBRI_SIDES], sbf_vec3 fine) {
  sbf_vec3 a = sbri_rotate(poses[SBRI_A]->rotation, joint->frames[SBRI_A].at);
  sbf_vec3 b = sbri_rotate(poses[SBRI_B]->rotation, joint->frames[SBRI_B].at);
  sbf_vec3 separation = sbri_sub(poses[SBRI_B]->position, poses[SBRI_A]->position);
  return sbri_add(sbri_add(separation, sbri_sub(b, a)), fine);
}

sbri_joint_frames sbri_joint_frames_of(const sbri_rigid_joint *joint,
    const sbr_transform *const poses[SBRI_SIDES], const sbr_transform *anchor, sbf_vec3 fine) {
  sbri_joint_frames p;
  for (int side = 0; side < SBRI_SIDES; side++)
    p.arms[side] = sbri_rotate(poses[side]->rotation, joint->frames[side].at);
  p.separation = sbri_add(
      sbri_sub(poses[SBRI_B]->position, poses[SBRI_A]->position), sbri_sub(p.arms[SBRI_B], p.arms[SBRI_A]));
  p.separation = sbri_add(p.separation, fine);
  sbf_quat a = sbri_quat_multiply(poses[SBRI_A]->rotation, joint->frames[SBRI_A].axes);
  sbf_quat b = sbri_quat_multiply(poses[SBRI_B]->rotation, joint->frames[SBRI_B].axes);
  p.axes[0] = sbri_quat_x(a);
  p.axes[1] = sbri_quat_y(a);
  p.axes[2] = sbri_cross(p.axes[0], p.axes[1]);
  sbf_quat q = sbri_quat_multiply(sbri_quat_conjugate(a), b);
  p.rotation = q;
  p.has_angles = false;
  float size = q.x * q.x + q.w * q.w;
  float fraction = size > 1e-12f ? 1 / size : 0; /* (w y - x z, w z + x y) / (x^2 + w^2) is n tan(s / 2) */
  p.half_tangent[0] = (q.w * q.y - q.x * q.z) * fraction;
  p.half_tangent[1] = (q.w * q.z + q.x * q.y) * fraction;
  if (joint->source->kind != SBF_JOINT_KIND_PULLEY) return p;
  const sbf_vec3 hung[SBRI_SIDES] = {joint->source->pulley_a, joint->source->pulley_b};
  for (int side = 0; side < SBRI_SIDES; side++) {
    sbf_vec3 at = sbri_add(anchor->position, sbri_rotate(anchor->rotation, hung[side]));
    sbf_vec3 rope = sbri_sub(sbri_add(poses[side]->position, p.arms[side]), at);
    p.ropes[side] = sbri_length(rope);
    p.rope_directions[side] = sbri_normalize(rope, sbri_vec3(0, -1, 0));
  }
  return p;
}

static void find_angles(sbri_joint_frames *p) {
  if (p->has_angles) return;
  p->angles = sbri_swing_twist_of(p->rotation);
  p->swing = sqrtf(p->angles.swing_y * p->angles.swing_y + p->angles.swing_z * p->angles.swing_z);
  p->has_angles = true;
}

float sbri_joint_locked_coordinate(const sbri_joint_frames *p, sbf_joint_axis axis) {
  float w = p->rotation.w < 0 ? -p->rotation.w : p->rotation.w,
        x = p->rotation.w < 0 ? -p->rotation.x : p->rotation.x;
  if (axis == SBF_JOINT_AXIS_TWIST) return 2 * x / (w > 0.1f ? w : 0.1f);
  if (axis == SBF_JOINT_AXIS_SWING_Y) return 2 * p->half_tangent[0];
  if (axis == SBF_JOINT_AXIS_SWING_Z) return 2 * p->half_tangent[1];
  return sbri_dot(p->separation, p->axes[axis - SBF_JOINT_AXIS_LINEAR_X]);
}

float sbri_joint_coordinate(const sbri_rigid_joint *joint, sbri_joint_frames *p, sbf_joint_axis axis) {
  if (sbri_axis_is_angular(axis)) find_angles(p);
  switch (axis) {
  case SBF_JOINT_AXIS_LINEAR_X:
  case SBF_JOINT_AXIS_LINEAR_Y:
  case SBF_JOINT_AXIS_LINEAR_Z:
    return sbri_dot(p->separation, p->axes[axis - SBF_JOINT_AXIS_LINEAR_X]);
  case SBF_JOINT_AXIS_TWIST:
    return p->angles.twist;
  case SBF_JOINT_AXIS_SWING_Y:
    return p->angles.swing_y;
  case SBF_JOINT_AXIS_SWING_Z:
    return p->angles.swing_z;
  case SBF_JOINT_AXIS_SWING:
    return p->swing;
  case SBF_JOINT_AXIS_DISTANCE:
  default:
    if (joint->source->kind != SBF_JOINT_KIND_PULLEY) return sbri_length(p->separation);
    return p->ropes[SBRI_A] + joint->source->pulley_ratio * p->ropes[SBRI_B];
  }
}

static void set_rates(float to[6], sbf_vec3 linear, sbf_vec3 angular) {
  to[0] = linear.x, to[1] = linear.y, to[2] = linear.z;
  to[3] = angular.x, to[4] = angular.y, to[5] = angular.z;
}

/* Rate of the origins' distance along a direction that is fixed in frame a: the direction's rotation counts.
 */
static void set_linear_rates(const sbri_joint_frames *p, sbf_vec3 direction, float rates[SBRI_SIDES][6]) {
  set_rates(rates[SBRI_B], direction, sbri_cross(p->arms[SBRI_B], direction));
  sbf_vec3 back = sbri_scale(direction, -1);
  set_rates(rates[SBRI_A], back, sbri_cross(sbri_add(p->arms[SBRI_A], p->separation), back));
}

/* g in frame a. */
static void set_angular_rates(const sbri_joint_frames *p, sbf_vec3 g, float rates[SBRI_SIDES][6]) {
  const sbf_vec3 none = {0, 0, 0};
  sbf_vec3 w =
      sbri_add_scaled(sbri_add_scaled(sbri_scale(p->axes[0], g.x), p->axes[1], g.y), p->axes[2], g.z);
  set_rates(rates[SBRI_B], none, w);
  set_rates(rates[SBRI_A], none, sbri_scale(w, -1));
}

static void set_pulley_rates(
    const sbri_rigid_joint *joint, const sbri_joint_frames *p, float rates[SBRI_SIDES][6]) {
  for (int side = 0; side < SBRI_SIDES; side++) {
    sbf_vec3 direction =
        sbri_scale(p->rope_directions[side], side == SBRI_B ? joint->source->pulley_ratio : 1);
    set_rates(rates[side], direction, sbri_cross(p->arms[side], direction));
  }
}

void sbri_joint_compute_gradient(
    const sbri_rigid_joint *joint, sbri_joint_frames *p, sbf_joint_axis axis, float rates[SBRI_SIDES][6]) {
  const float *t = p->half_tangent;
  float tangent = sqrtf(t[0] * t[0] + t[1] * t[1]);
  float n_y = tangent > 1e-7f ? t[0] / tangent : 1, n_z = tangent > 1e-7f ? t[1] / tangent : 0;
  switch (axis) {
  case SBF_JOINT_AXIS_LINEAR_X:
  case SBF_JOINT_AXIS_LINEAR_Y:
  case SBF_JOINT_AXIS_LINEAR_Z:
    set_linear_rates(p, p->axes[axis - SBF_JOINT_AXIS_LINEAR_X], rates);
    return;
  case SBF_JOINT_AXIS_TWIST:
    set_angular_rates(p, sbri_vec3(1, t[1], -t[0]), rates);
    return;
  case SBF_JOINT_AXIS_SWING:
    set_angular_rates(p, sbri_vec3(0, n_y, n_z), rates);
    return;
  case SBF_JOINT_AXIS_SWING_Y:
  case SBF_JOINT_AXIS_SWING_Z: {
    find_angles(p);
    /* s cot(s), from the tangent of the half angle; 1 at 0 */
    float s = p->swing, across = s < 1e-4f ? 1 : s * (1 - tangent * tangent) / (2 * tangent);
    bool y = axis == SBF_JOINT_AXIS_SWING_Y;
    float direction = y ? n_y : n_z, e = y ? n_z : -n_y; /* e = (0, n_z, -n_y) */
    set_angular_rates(
        p, sbri_vec3(-s * e, direction * n_y + across * e * n_z, direction * n_z - across * e * n_y), rates);
    return;
  }
  case SBF_JOINT_AXIS_DISTANCE:
  default:
    if (joint->source->kind == SBF_JOINT_KIND_PULLEY)
      set_pulley_rates(joint, p, rates);
    else
      set_linear_rates(p, sbri_normalize(p->separation, p->axes[0]), rates);
  }
}
