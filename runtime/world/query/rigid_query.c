/* Queries of rigid bodies and joints: sbrun/rigid.h. */
#include "coupling/ragdoll/ragdoll.h"
#include "math/quat.h"
#include "mechanics/joint_freedom.h"
#include "rigid/joint_frames.h"

sbr_rigid_state sbr_character_get_rigid_state(
    const sbr_world *world, sbr_character_id character, uint32_t rigid_body) {
  const sbri_character *c = sbri_character_of(world, character);
  sbr_rigid_state state = {.frame = {.rotation = {0, 0, 0, 1}}};
  if (!c || rigid_body >= c->model->rigid.body_count) return state;
  const sbri_rigid_body *is = &c->model->rigid.bodies[rigid_body];
  sbri_rigid_body_state now = sbri_rigid_bodies(c)[rigid_body];
  if (!sbri_rigid_drive(c)->any_dynamic) now.pose = sbri_rigid_target(c, sbri_pose(c), rigid_body);
  float s = c->scale, mass = is->mass * s * s * s, speed = s * c->time_scale;
  sbf_quat rotation = sbri_quat_multiply(now.pose.rotation, sbri_quat_conjugate(is->axes));
  sbf_vec3 off = sbri_rotate(rotation, sbri_sub(is->source->center, is->center));
  sbf_vec3 w = sbri_angular_velocity_from_momentum(is, now.pose.rotation, now.angular_momentum);
  state.mode = (sbr_rigid_mode)now.mode;
  state.center = sbri_scale(now.pose.position, s);
  state.frame =
      (sbr_transform){sbri_scale(sbri_add(now.pose.position, off), s), sbri_quat_normalize(rotation)};
  state.velocity = sbri_scale(now.velocity, speed);
  state.angular_velocity = sbri_scale(w, c->time_scale);
  state.mass = mass;
  sbf_vec3 g = world->has_gravity ? world->gravity : c->model->asset->environment.gravity;
  state.kinetic_j = 0.5f * (mass * sbri_dot(state.velocity, state.velocity) +
                               s * s * s * speed * speed * sbri_dot(now.angular_momentum, w));
  sbr_double3 o = sbri_header(c)->origin;
  state.potential_j =
      -mass * is->source->gravity_scale *
      (float)((double)g.x * (o.x + (double)state.center.x) + (double)g.y * (o.y + (double)state.center.y) +
              (double)g.z * (o.z + (double)state.center.z));
  return state;
}

/* Violation of a hard limit. */
static float beyond(const sbf_limit *limit, float value) {
  const float turn = 6.28318530718f;
  float best = INFINITY;
  int directions = limit->target == SBF_JOINT_AXIS_TWIST ? 1 : 0;
  for (int direction = -directions; direction <= directions; direction++) {
    float v = value + (float)direction * turn, off = v < limit->min ? limit->min - v : v - limit->max;
    best = off < best ? off : best;
  }
  return best > 0 ? best : 0;
}

sbr_joint_state sbr_character_get_joint_state(
    const sbr_world *world, sbr_character_id character, uint32_t number) {
  const sbri_character *c = sbri_character_of(world, character);
  sbr_joint_state state = {.broken = false};
  if (!c || number >= c->model->rigid.joint_count) return state;
  const sbri_rigid_joint *joint = &c->model->rigid.joints[number];
  const sbri_rigid_joint_state *now = &sbri_rigid_joints(c)[number];
  const sbr_transform *at_anchor = &sbri_pose(c)[sbri_anchor_frame(c->model)];
  sbr_transform anchor = {sbri_scale(at_anchor->position, 1 / c->scale), at_anchor->rotation};
  sbr_transform poses[SBRI_SIDES];
  const sbr_transform *at[SBRI_SIDES];
  for (int side = 0; side < SBRI_SIDES; side++) {
    int32_t body = joint->bodies[side];
    poses[side] = body < 0                           ? anchor
                  : sbri_rigid_drive(c)->any_dynamic ? sbri_rigid_bodies(c)[body].pose
                                                     : sbri_rigid_target(c, sbri_pose(c), (uint32_t)body);
    at[side] = &poses[side];
  }
  sbri_joint_frames joint_frames = sbri_joint_frames_of(joint, at, &anchor, sbri_vec3(0, 0, 0));
  for (int axis = 0; axis < SBF_JOINT_AXIS_COUNT; axis++) {
    bool turns = sbri_axis_is_angular((sbf_joint_axis)axis);
    float value = sbri_joint_coordinate(joint, &joint_frames, (sbf_joint_axis)axis), off = fabsf(value);
    if (axis <= SBF_JOINT_AXIS_SWING_Z && joint->locked >> axis & 1) {
      float *worst = turns ? &state.angular_error : &state.separation;
      *worst = off * (turns ? 1 : c->scale) > *worst ? off * (turns ? 1 : c->scale) : *worst;
    }
    state.coordinates[axis] = turns ? value : value * c->scale;
    for (uint32_t l = 0; l < joint->source->limits.count; l++) {
      const sbf_limit *limit = &joint->source->limits.at[l];
      if (limit->target != (sbf_joint_axis)axis || limit->stiffness > 0 ||
          !sbfi_joint_is_free(joint->source->kind, limit->target))
        continue;
      float broken = beyond(limit, value), *worst = turns ? &state.angle_violation : &state.length_violation;
      if (!turns) broken *= c->scale;
      *worst = broken > *worst ? broken : *worst;
    }
  }
  bool bounded = false;
  for (uint32_t l = 0; l < joint->source->limits.count; l++)
    bounded = bounded || joint->source->limits.at[l].target == SBF_JOINT_AXIS_DISTANCE;
  float length = state.coordinates[SBF_JOINT_AXIS_DISTANCE] - joint->rest_distance * c->scale;
  if (!bounded && joint->source->kind == SBF_JOINT_KIND_DISTANCE) state.separation = fabsf(length);
  if (!bounded && joint->source->kind == SBF_JOINT_KIND_PULLEY) state.separation = length > 0 ? length : 0;
  float s = c->scale;
  state.force = sbri_scale(now->force, s * s * s); /* units: mass times length over time squared */
  state.torque = sbri_scale(now->torque, s * s * s * s);
  state.broken = now->broken != 0;
  return state;
}
