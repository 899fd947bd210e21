/* Public calls for rigid parts: sbrun/rigid.h. */
#include "coupling/ragdoll/ragdoll.h"
#include "math/quat_log.h"
#include "mechanics/joint_freedom.h"
#include "rigid/joint_frames.h"

enum { FALL_COOKIE = 0x5b726661 };

static bool has_body(const sbri_character *c, int32_t body) {
  return c && c->model->rigid.body_count > 0 && body < (int32_t)c->model->rigid.body_count;
}

/* Moves the bodies of a character without simulated bodies to the pose, with its velocities. */
static void move_bodies_to_pose(const sbr_world *world, sbri_character *c) {
  float rate = 1 / ((float)world->time.tick_s * c->time_scale);
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    sbr_transform before = sbri_rigid_target(c, sbri_previous_pose(c), b),
                  now = sbri_rigid_target(c, sbri_pose(c), b);
    body->pose = now;
    body->fine = sbri_vec3(0, 0, 0);
    body->velocity = sbri_scale(sbri_sub(now.position, before.position), rate);
    sbf_quat rotation = sbri_quat_multiply(now.rotation, sbri_quat_conjugate(before.rotation));
    body->angular_momentum = sbri_angular_momentum_from_velocity(
        &c->model->rigid.bodies[b], now.rotation, sbri_scale(sbri_quat_log(rotation), rate));
  }
}

void sbr_character_set_rigid_mode(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, sbr_rigid_mode mode) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, rigid_body) || (unsigned)mode > SBR_RIGID_DRIVEN) return;
  sbri_record(world, SBRI_RECORDED_RIGID_MODE, (const double[]){character.value, rigid_body, (double)mode});
  if (!sbri_rigid_drive(c)->any_dynamic) move_bodies_to_pose(world, c);
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    if (rigid_body < 0 || rigid_body == (int32_t)b) sbri_rigid_bodies(c)[b].mode = (uint32_t)mode;
  sbri_rigid_wake(c);
}

void sbr_character_set_rigid_drive(
    sbr_world *world, sbr_character_id character, const sbr_rigid_drive *drive) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, -1) || !drive || drive->cookie != SBRI_RIGID_DRIVE_COOKIE) return;
  if (!sbri_record(world, SBRI_RECORDED_RIGID_DRIVE,
          (const double[]){character.value, (double)drive->frequency_hz, (double)drive->damping_ratio,
              (double)drive->strength, (double)drive->joint_damping_1_s, (double)drive->joint_friction}))
    return;
  sbri_rigid_set_drive(c, drive);
  sbri_rigid_wake(c);
}

void sbr_character_set_rigid_drive_fraction(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, float fraction) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, rigid_body)) return;
  if (!sbri_record(world, SBRI_RECORDED_RIGID_FRACTION,
          (const double[]){character.value, rigid_body, (double)fraction}))
    return;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    if (rigid_body < 0 || rigid_body == (int32_t)b)
      sbri_rigid_bodies(c)[b].fraction = sbri_clamp(fraction, 0, 1);
  sbri_rigid_wake(c);
}

sbr_fall_definition sbr_default_fall_definition(void) {
  return (sbr_fall_definition){.cookie = FALL_COOKIE, .drive_fraction = 0.1f, .rest_s = 0.5f, .rise_s = 1.5f};
}

void sbr_character_knock_over(sbr_world *world, sbr_character_id character, const sbr_fall_definition *fall) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, -1) || !fall || fall->cookie != FALL_COOKIE) return;
  if (!sbri_record(world, SBRI_RECORDED_RIGID_FALL,
          (const double[]){
              character.value, (double)fall->drive_fraction, (double)fall->rest_s, (double)fall->rise_s}))
    return;
  if (!sbri_rigid_drive(c)->any_dynamic) move_bodies_to_pose(world, c);
  sbri_reflex_begin(c, fall);
  sbri_rigid_wake(c);
}

sbr_posture sbr_character_get_posture(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return has_body(c, -1) ? (sbr_posture)sbri_rigid_drive(c)->fall.posture : SBR_POSTURE_UPRIGHT;
}

void sbr_character_apply_rigid_impulse(sbr_world *world, sbr_character_id character, uint32_t rigid_body,
    sbr_double3 position, sbf_vec3 impulse) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c || rigid_body >= c->model->rigid.body_count || !sbri_rigid_is_simulated(c, rigid_body)) return;
  if (!sbri_record(world, SBRI_RECORDED_RIGID_PUSH,
          (const double[]){character.value, rigid_body, position.x, position.y, position.z, (double)impulse.x,
              (double)impulse.y, (double)impulse.z}))
    return;
  sbr_double3 origin = sbri_header(c)->origin;
  sbf_vec3 at = {
      (float)(position.x - origin.x), (float)(position.y - origin.y), (float)(position.z - origin.z)};
  sbri_rigid_apply_impulse(
      c, rigid_body, sbri_scale(at, 1 / c->scale), sbri_scale(impulse, sbri_own_impulse(c)));
}
