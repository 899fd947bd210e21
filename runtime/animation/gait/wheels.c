/* Wheels rotate by the distance that they roll; the links of tracks move around them (spec 14.7). */
#include "animation/gait/motion_kinds.h"
#include "math/trig.h"

static const float TURN = 6.2831853f;
static const float FULL_STEER = 0.02f; /* m/s; at lower speed, wheels steer as at this speed */

/* Mean z of the wheels that steer, or do not. */
static bool mean_z(const sbri_rig *rig, bool steers, float *z, float *limit) {
  uint32_t count = 0;
  *z = 0, *limit = 1.5f;
  for (uint32_t i = 0; i < rig->gait->wheels.count; i++) {
    const sbf_wheel *wheel = &rig->gait->wheels.at[i];
    if ((wheel->steer_limit > 0) != steers) continue;
    *z += rig->bones.rest[wheel->bone].position.z;
    if (wheel->steer_limit < *limit) *limit = wheel->steer_limit;
    count++;
  }
  if (count) *z /= (float)count;
  return count > 0;
}

void sbri_wheels_allow(const sbri_rig *rig, sbri_gait_input *input) {
  float fixed, steered, limit, unused;
  if (rig->gait->treads.count || !mean_z(rig, true, &steered, &limit)) return;
  if (!mean_z(rig, false, &fixed, &unused)) return;
  float base = fabsf(steered - fixed) * input->scale, s, c;
  sbri_sincos(limit, &s, &c);
  if (!(base > 0)) return;
  float max = fabsf(input->forward) * s / (c * base);
  input->turn = sbri_clamp(input->turn, -max, max);
  input->sideways = -input->turn * fixed * input->scale; /* the fixed axle has no sideways velocity */
}

/* Velocity of a wheel's head over the ground, in body axes. */
static sbf_vec3 velocity_at(const sbri_gait_state *state, sbf_vec3 position, float scale) {
  return sbri_vec3(state->motion.sideways + state->motion.turn * position.z * scale, 0,
      state->motion.forward - state->motion.turn * position.x * scale);
}

static float steer_of(const sbf_wheel *wheel, sbf_vec3 velocity) {
  float ahead = fabsf(velocity.z) > FULL_STEER ? velocity.z : velocity.z < 0 ? -FULL_STEER : FULL_STEER;
  float angle = ahead < 0 ? sbri_atan2(-velocity.x, -ahead) : sbri_atan2(velocity.x, ahead);
  return sbri_clamp(angle, -wheel->steer_limit, wheel->steer_limit);
}

/* Mean position of the links at rest. */
static sbf_vec3 tread_middle(const sbri_rig *rig, const sbf_tread *tread) {
  sbf_vec3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < tread->bones.count; k++)
    sum = sbri_add(sum, rig->bones.rest[tread->bones.at[k]].position);
  return sbri_scale(sum, tread->bones.count ? 1 / (float)tread->bones.count : 0);
}

static float link_length(const sbri_rig *rig, const sbf_tread *tread, uint32_t k) {
  uint32_t next = k + 1 < tread->bones.count ? k + 1 : 0;
  return sbri_length(sbri_sub(
      rig->bones.rest[tread->bones.at[next]].position, rig->bones.rest[tread->bones.at[k]].position));
}

static float tread_length(const sbri_rig *rig, const sbf_tread *tread) {
  float sum = 0;
  for (uint32_t k = 0; k < tread->bones.count; k++) sum += link_length(rig, tread, k);
  return sum;
}

void sbri_wheels_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  float *angles = sbri_wheel_angles(rig, state), *distances = sbri_tread_distances(rig, state);
  float h = input->tick_s * state->stepping.speed_fraction;
  for (uint32_t i = 0; i < rig->gait->wheels.count; i++) {
    const sbf_wheel *wheel = &rig->gait->wheels.at[i];
    sbf_vec3 v = velocity_at(state, rig->bones.rest[wheel->bone].position, input->scale);
    float s = 0, c = 1;
    if (wheel->steer_limit > 0) sbri_sincos(steer_of(wheel, v), &s, &c);
    angles[i] = sbri_wrap(angles[i] + (v.z * c + v.x * s) * h / (wheel->radius * input->scale), TURN);
  }
  for (uint32_t i = 0; i < rig->gait->treads.count; i++) {
    const sbf_tread *tread = &rig->gait->treads.at[i];
    float length = tread_length(rig, tread);
    sbf_vec3 v = velocity_at(state, tread_middle(rig, tread), input->scale);
    distances[i] = length > 0 ? sbri_wrap(distances[i] + v.z * h / input->scale, length) : 0;
  }
}

static sbf_quat rotation_about(sbf_vec3 axis, float angle) {
  float s, c;
  sbri_sincos(0.5f * angle, &s, &c);
  return (sbf_quat){axis.x * s, axis.y * s, axis.z * s, c};
}

static void pose_tread(const sbri_rig *rig, const sbf_tread *tread, float distance, float scale,
    const sbr_transform *root, sbr_transform *pose) {
  uint32_t count = tread->bones.count, at = 0;
  if (count < 2) return;
  while (distance >= link_length(rig, tread, at)) {
    distance -= link_length(rig, tread, at);
    at = at + 1 < count ? at + 1 : 0;
    if (!(distance > 0)) break;
  }
  for (uint32_t k = 0; k < count; k++) {
    /* Fraction of the distance from the position of link `at + k` to the next one; equal for links of one
     * length. */
    uint32_t from = (at + k) % count, to = (from + 1) % count, bone = tread->bones.at[k];
    float length = link_length(rig, tread, from), t = length > 0 ? sbri_clamp(distance / length, 0, 1) : 0;
    const sbr_transform *a = &rig->bones.rest[tread->bones.at[from]],
                        *b = &rig->bones.rest[tread->bones.at[to]];
    const sbr_transform *rest = &rig->bones.rest[bone];
    sbf_vec3 shift = sbri_sub(sbri_lerp(a->position, b->position, t), rest->position);
    sbf_quat rotation =
        sbri_quat_multiply(sbri_quat_blend(a->rotation, b->rotation, t), sbri_quat_conjugate(rest->rotation));
    sbf_quat parent = sbri_motion_parent_rotation(rig, bone, root, pose);
    sbri_rig_rotate_bone(rig, bone,
        sbri_quat_multiply(sbri_quat_multiply(parent, rotation), sbri_quat_conjugate(parent)), pose);
    sbri_rig_shift(rig, bone, sbri_scale(sbri_rotate(parent, shift), scale), pose);
  }
}

void sbri_wheels_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose) {
  const float *angles = sbri_wheel_angles(rig, state), *distances = sbri_tread_distances(rig, state);
  for (uint32_t i = 0; i < rig->gait->wheels.count; i++) {
    const sbf_wheel *wheel = &rig->gait->wheels.at[i];
    uint32_t bone = (uint32_t)wheel->bone;
    sbf_quat parent = sbri_motion_parent_rotation(rig, bone, root, pose);
    sbf_vec3 axis = sbri_normalize(wheel->axis, sbri_vec3(1, 0, 0));
    sbf_quat rotation = rotation_about(axis, angles[i]);
    if (wheel->steer_limit > 0) {
      sbf_vec3 v = velocity_at(state, rig->bones.rest[bone].position, input->scale);
      rotation = sbri_quat_multiply(rotation_about(sbri_vec3(0, 1, 0), steer_of(wheel, v)), rotation);
    }
    sbri_rig_rotate_bone(rig, bone,
        sbri_quat_multiply(sbri_quat_multiply(parent, rotation), sbri_quat_conjugate(parent)), pose);
  }
  for (uint32_t i = 0; i < rig->gait->treads.count; i++)
    pose_tread(rig, &rig->gait->treads.at[i], distances[i], input->scale, root, pose);
}
