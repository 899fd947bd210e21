/* What hosts ask of rigid parts and tell them: sbrun/rigid.h. */
#include "math/quat_log.h"
#include "mechanics/joint_freedom.h"
#include "ragdoll/ragdoll.h"
#include "rigid/joint_place.h"

static bool has_body(const sbri_character *c, int32_t body) {
  return c && c->model->rigid.body_count > 0 && body < (int32_t)c->model->rigid.body_count;
}

/* Bodies of a character none of which was simulated are where the pose is, and as fast. */
static void catch_up(const sbr_world *world, sbri_character *c) {
  float rate = 1 / ((float)world->tick_s * c->time_scale);
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    sbr_transform before = sbri_rigid_target(c, sbri_previous_pose(c), b),
                  now = sbri_rigid_target(c, sbri_pose(c), b);
    body->pose = now;
    body->fine = sbri_vec3(0, 0, 0);
    body->velocity = sbri_scale(sbri_sub(now.position, before.position), rate);
    sbf_quat turn = sbri_quat_multiply(now.rotation, sbri_quat_conjugate(before.rotation));
    body->spin =
        sbri_spin_from(&c->model->rigid.bodies[b], now.rotation, sbri_scale(sbri_quat_log(turn), rate));
  }
}

void sbr_character_rigid_mode(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, sbr_rigid_mode mode) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, rigid_body) || (unsigned)mode > SBR_RIGID_DRIVEN) return;
  sbri_record(world, SBRI_RECORDED_RIGID_MODE, (const double[]){character.value, rigid_body, (double)mode});
  if (!sbri_rigid_drive(c)->any) catch_up(world, c);
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    if (rigid_body < 0 || rigid_body == (int32_t)b) sbri_rigid_bodies(c)[b].mode = (uint32_t)mode;
  sbri_rigid_wake(c);
}

void sbr_character_rigid_drive(sbr_world *world, sbr_character_id character, const sbr_rigid_drive *drive) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, -1) || !drive) return;
  if (!sbri_record(world, SBRI_RECORDED_RIGID_DRIVE,
          (const double[]){character.value, (double)drive->frequency_hz, (double)drive->damping_ratio,
              (double)drive->strength, (double)drive->joint_damping_1_s, (double)drive->joint_friction}))
    return;
  sbri_rigid_set_drive(c, drive);
  sbri_rigid_wake(c);
}

void sbr_character_rigid_share(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, float share) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, rigid_body)) return;
  if (!sbri_record(
          world, SBRI_RECORDED_RIGID_SHARE, (const double[]){character.value, rigid_body, (double)share}))
    return;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    if (rigid_body < 0 || rigid_body == (int32_t)b) sbri_rigid_bodies(c)[b].share = sbri_clamp(share, 0, 1);
  sbri_rigid_wake(c);
}

sbr_rigid_fall sbr_default_rigid_fall(void) {
  return (sbr_rigid_fall){.share = 0.1f, .rest_s = 0.5f, .rise_s = 1.5f};
}

void sbr_character_rigid_fall(sbr_world *world, sbr_character_id character, const sbr_rigid_fall *fall) {
  sbri_character *c = sbri_character_of(world, character);
  if (!has_body(c, -1) || !fall) return;
  if (!sbri_record(world, SBRI_RECORDED_RIGID_FALL,
          (const double[]){character.value, (double)fall->share, (double)fall->rest_s, (double)fall->rise_s}))
    return;
  if (!sbri_rigid_drive(c)->any) catch_up(world, c);
  sbri_reflex_begin(c, fall);
  sbri_rigid_wake(c);
}

sbr_rigid_posture sbr_character_rigid_posture(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return has_body(c, -1) ? (sbr_rigid_posture)sbri_rigid_drive(c)->posture : SBR_RIGID_UP;
}

void sbr_character_rigid_push(
    sbr_world *world, sbr_character_id character, uint32_t rigid_body, sbr_double3 place, sbf_vec3 impulse) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c || rigid_body >= c->model->rigid.body_count || !sbri_rigid_is_simulated(c, rigid_body)) return;
  if (!sbri_record(world, SBRI_RECORDED_RIGID_PUSH,
          (const double[]){character.value, rigid_body, place.x, place.y, place.z, (double)impulse.x,
              (double)impulse.y, (double)impulse.z}))
    return;
  sbr_double3 origin = sbri_head(c)->origin;
  sbf_vec3 at = {(float)(place.x - origin.x), (float)(place.y - origin.y), (float)(place.z - origin.z)};
  sbri_rigid_push(c, rigid_body, sbri_scale(at, 1 / c->scale), sbri_scale(impulse, sbri_own_impulse(c)));
}
