/* Conversion between poses of rigid bodies and bones. */
#include "coupling/ragdoll/ragdoll.h"
#include "math/quat.h"
#include "soft/solvers/scheme.h"

bool sbri_rigid_is_simulated(const sbri_character *c, uint32_t body) {
  return sbri_rigid_bodies(c)[body].mode != SBR_RIGID_KINEMATIC && c->model->rigid.bodies[body].mass > 0;
}

bool sbri_island_is_coupled(const sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  if (island->scheme->forceless || !c->model->rigid.body_count || !sbri_rigid_drive(c)->any_dynamic)
    return false;
  for (uint32_t i = 0; i < island->pins.attachment_count; i++)
    if (sbri_rigid_is_simulated(c, island->pins.attachments[i])) return true;
  return false;
}

void sbri_rigid_set_frame(sbri_rigid_body_state *body, sbr_transform transform) {
  body->pose = transform;
  body->velocity = body->angular_momentum = body->fine = sbri_vec3(0, 0, 0);
}

void sbri_rigid_apply_impulse(sbri_character *c, uint32_t rigid_body, sbf_vec3 at, sbf_vec3 impulse) {
  sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[rigid_body];
  sbf_vec3 arm = sbri_sub(at, body->pose.position);
  body->velocity = sbri_add_scaled(body->velocity, impulse, c->model->rigid.bodies[rigid_body].inverse_mass);
  body->angular_momentum = sbri_add(body->angular_momentum, sbri_cross(arm, impulse));
  sbri_rigid_wake(c);
}

void sbri_rigid_wake(sbri_character *c) {
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  drive->asleep = drive->idle_ticks = drive->slow_ticks = drive->any_dynamic = 0;
  drive->decay.ticks = 0, drive->decay.max = drive->decay.before = 0;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    drive->any_dynamic |= sbri_rigid_is_simulated(c, b);
  sbri_character_wake(c);
}

bool sbri_rigid_is_still(const sbri_character *c) {
  const sbri_rigid_drive_state *drive = c->model->rigid.body_count ? sbri_rigid_drive(c) : NULL;
  return !drive || !drive->any_dynamic || drive->asleep;
}

sbr_rigid_drive sbr_default_rigid_drive(void) {
  return (sbr_rigid_drive){.cookie = SBRI_RIGID_DRIVE_COOKIE,
      .frequency_hz = 4,
      .damping_ratio = 1,
      .strength = 2,
      .joint_damping_1_s = 2,
      .joint_friction = 0.04f};
}

void sbri_rigid_set_drive(sbri_character *c, const sbr_rigid_drive *drive) {
  sbri_rigid_drive_state *to = sbri_rigid_drive(c);
  to->frequency_hz = sbri_clamp(drive->frequency_hz, 0, 100);
  to->damping_ratio = sbri_clamp(drive->damping_ratio, 0, 10);
  to->strength = sbri_clamp(drive->strength, 0, 1e6f);
  to->joint_damping_1_s = sbri_clamp(drive->joint_damping_1_s, 0, 100);
  to->joint_friction = sbri_clamp(drive->joint_friction, 0, 1);
}

/* ---- From bones to bodies ---- */

sbr_transform sbri_rigid_target(const sbri_character *c, const sbr_transform *pose, uint32_t body) {
  const sbri_rigid_body *is = &c->model->rigid.bodies[body];
  uint32_t frame = is->source->bone >= 0 ? (uint32_t)is->source->bone : sbri_root_frame(c->model);
  sbr_transform rest = sbri_frame_rest(c->model, frame);
  sbf_quat rotation = sbri_quat_multiply(pose[frame].rotation, sbri_quat_conjugate(rest.rotation));
  sbf_vec3 arm = sbri_rotate(rotation, sbri_sub(is->center, rest.position));
  return (sbr_transform){sbri_add(sbri_scale(pose[frame].position, 1 / c->scale), arm),
      sbri_quat_normalize(sbri_quat_multiply(rotation, is->axes))};
}

/* ---- From bodies to bones ---- */

/* The body's motion from rest to `now`, applied to a position and rotation of the rest pose. */
static sbr_transform move_with_body(
    const sbri_character *c, uint32_t body, const sbr_transform *now, const sbr_transform *rest) {
  const sbri_rigid_body *is = &c->model->rigid.bodies[body];
  sbf_quat rotation = sbri_quat_multiply(now->rotation, sbri_quat_conjugate(is->axes));
  sbf_vec3 at = sbri_add(now->position, sbri_rotate(rotation, sbri_sub(rest->position, is->center)));
  return (sbr_transform){
      sbri_scale(at, c->scale), sbri_quat_normalize(sbri_quat_multiply(rotation, rest->rotation))};
}

sbr_transform sbri_rigid_ahead(
    const sbri_character *c, uint32_t body, float seconds, sbf_vec3 velocity_change) {
  const sbri_rigid_body_state *now = &sbri_rigid_bodies(c)[body];
  sbr_transform to = now->pose;
  if (!(seconds > 0)) return to;
  float scale = c->model->rigid.bodies[body].source->gravity_scale;
  to.position = sbri_add_scaled(to.position, sbri_add_scaled(now->velocity, velocity_change, scale), seconds);
  (void)sbri_torque_free_rotation(
      &c->model->rigid.bodies[body], now->pose.rotation, now->angular_momentum, seconds, &to.rotation);
  return to;
}

/* A bone in the pose `by` relative to its parent, for a parent at `parent_now`. */
static sbr_transform compose_bone(
    const sbr_transform *by, uint32_t bone, uint32_t parent, const sbr_transform *parent_now) {
  sbf_quat rotation = sbri_quat_multiply(parent_now->rotation, sbri_quat_conjugate(by[parent].rotation));
  sbf_vec3 offset = sbri_sub(by[bone].position, by[parent].position);
  return (sbr_transform){sbri_add(parent_now->position, sbri_rotate(rotation, offset)),
      sbri_quat_normalize(sbri_quat_multiply(rotation, by[bone].rotation))};
}

static sbr_transform blend(const sbr_transform *a, const sbr_transform *b, float fraction) {
  return (sbr_transform){
      sbri_lerp(a->position, b->position, fraction), sbri_quat_blend(a->rotation, b->rotation, fraction)};
}

void sbri_rigid_pose(const sbri_character *c, const sbr_transform *animated, float fraction, float ahead_s,
    sbf_vec3 velocity_change, sbr_transform *pose) {
  const sbr_model *model = c->model;
  const sbr_transform *before = sbri_previous_pose(c);
  for (uint32_t i = 0; i < model->frame_count; i++) {
    uint32_t frame = i < model->rig.bones.count ? model->rig.bones.subtree[i] : i;
    int32_t body = model->rigid_body_of_frame[frame];
    if (body < 0 || !sbri_rigid_is_simulated(c, (uint32_t)body)) {
      pose[frame] = fraction < 1 ? blend(&before[frame], &animated[frame], fraction) : animated[frame];
      continue;
    }
    if (sbri_body_frame(model, (uint32_t)body) == frame) {
      sbr_transform now = sbri_rigid_ahead(c, (uint32_t)body, ahead_s, velocity_change),
                    rest = sbri_frame_rest(model, frame);
      pose[frame] = move_with_body(c, (uint32_t)body, &now, &rest);
      continue;
    }
    uint32_t parent = (uint32_t)model->rig.bones.parents[frame];
    pose[frame] = compose_bone(animated, frame, parent, &pose[parent]);
    if (fraction >= 1) continue;
    sbr_transform was = compose_bone(before, frame, parent, &pose[parent]);
    pose[frame] = blend(&was, &pose[frame], fraction);
  }
}

void sbri_rigid_frames_follow(const sbri_character *c, sbr_transform *pose) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    if (c->model->rigid.own_frames[b] == UINT32_MAX) continue;
    int32_t bone = c->model->rigid.bodies[b].source->bone;
    uint32_t frame = sbri_body_frame(c->model, b);
    sbr_transform at = sbri_rigid_target(c, pose, b), rest = sbri_frame_rest(c->model, frame);
    pose[frame] = bone < 0 ? pose[sbri_root_frame(c->model)] : move_with_body(c, b, &at, &rest);
  }
}
