/* Falling over and getting up again.
 *
 * While a character falls, its bodies are driven with a fraction of their strength, so it falls as someone
 * who is awake. Once it lies still, its gait is placed there in a standing pose and it rises: the drives
 * regain their strength, and a growing force pulls each body towards its pose and carries its weight, up to a
 * stated acceleration. This external force replaces a planned push off the ground. Joints, limits, the ground
 * and obstacles act throughout. When all bodies have arrived they are kinematic again. */
#include "coupling/ragdoll/ragdoll.h"
#include "math/quat_log.h"
#include "math/trig.h"
#include "state/pose/frames.h"

/* The character lies still when no point of a body is faster than this (asset metres a second), or after so
 * many seconds. */
static const float STILL_M_S = 0.15f, LONGEST_FALL_S = 5;

/* Frequency of the external force at the beginning and at the end; its maximum accelerations, linear and
 * angular. */
static const float FIRST_HZ = 1, LAST_HZ = 6, MAX_M_S2 = 40, MAX_RAD_S2 = 200;

/* It has arrived when no body is farther off than this (asset metres and rad), or after so many times the
 * stated time. */
static const float ARRIVED_M = 0.01f, ARRIVED_RAD = 0.06f, LATE_S = 1.5f;

static const float TWO_PI = 6.28318530718f;

static bool is_affected(const sbri_character *c, uint32_t body) {
  const sbri_rigid_body *is = &c->model->rigid.bodies[body];
  return is->mass > 0 && is->source->motion != SBF_BODY_MOTION_DYNAMIC;
}

static void set_all(sbri_character *c, sbr_rigid_mode mode, float fraction) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    if (!is_affected(c, b)) continue;
    sbri_rigid_bodies(c)[b].mode = (uint32_t)mode;
    sbri_rigid_bodies(c)[b].fraction = fraction;
  }
}

void sbri_reflex_begin(sbri_character *c, const sbr_fall_definition *fall) {
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  drive->fall.posture = SBR_POSTURE_FALLING;
  drive->fall.posture_s = drive->fall.still_s = 0;
  drive->fall.drive_fraction = sbri_clamp(fall->drive_fraction, 0, 1);
  drive->fall.rest_s = sbri_clamp(fall->rest_s, 0, 1e6f);
  drive->fall.rise_s = sbri_clamp(fall->rise_s, 0.1f, 1e6f);
  set_all(c, SBR_RIGID_DRIVEN, drive->fall.drive_fraction);
}

void sbri_reflex_end(sbri_character *c) {
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  if (drive->fall.posture == SBR_POSTURE_UPRIGHT) return;
  drive->fall.posture = SBR_POSTURE_UPRIGHT;
  set_all(c, SBR_RIGID_KINEMATIC, 1);
  sbri_rigid_wake(c);
}

/* ---- Standing up ---- */

/* The body nearest to the root of the bones; -1: there is none. */
static int32_t hips_of(const sbri_character *c) {
  const sbri_rig *rig = &c->model->rig;
  for (uint32_t i = 0; i < rig->bones.count; i++)
    if (c->model->rigid.body_of_bone[rig->bones.subtree[i]] >= 0)
      return c->model->rigid.body_of_bone[rig->bones.subtree[i]];
  return -1;
}

/* The heading after getting up: towards the head for a character on its belly, away from it on its back. */
static float heading_of(sbf_quat rotation) {
  sbf_vec3 front = sbri_rotate(rotation, sbri_vec3(0, 0, 1)), up = sbri_rotate(rotation, sbri_vec3(0, 1, 0));
  return sbri_atan2(front.x - front.y * up.x, front.z - front.y * up.z);
}

static void set_standing_pose(const sbr_world *world, sbri_character *c) {
  int32_t body = hips_of(c);
  if (body < 0) return;
  const sbri_rigid_body *is = &c->model->rigid.bodies[body];
  const sbr_transform *now = &sbri_rigid_bodies(c)[body].pose;
  float heading = heading_of(sbri_quat_multiply(now->rotation, sbri_quat_conjugate(is->axes))), s, k, old;
  sbf_vec3 position;
  sbri_sincos(0.5f * heading, &s, &k);
  sbf_vec3 distance = sbri_rotate((sbf_quat){0, s, 0, k}, is->center);
  sbri_gait_get_placement(sbri_gait(c), &position, &old);
  position.x = c->scale * (now->position.x - distance.x),
  position.z = c->scale * (now->position.z - distance.z);
  sbri_surroundings around;
  sbri_gait_input input = sbri_gait_input_of(world, c, &around);
  sbri_gait_reset(&c->model->rig, sbri_gait(c), &input, position, heading);
}

/* ---- Every tick ---- */

static float fastest_of(const sbri_character *c) {
  float max = 0;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    const sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    if (!is_affected(c, b)) continue;
    sbf_vec3 turn = sbri_angular_velocity_from_momentum(
        &c->model->rigid.bodies[b], body->pose.rotation, body->angular_momentum);
    float speed = sbri_length(body->velocity) + c->model->rigid.bodies[b].radius * sbri_length(turn);
    max = speed > max ? speed : max;
  }
  return max;
}

static sbf_vec3 rotation_to(const sbr_transform *to, const sbr_transform *from) {
  return sbri_quat_log(sbri_quat_multiply(to->rotation, sbri_quat_conjugate(from->rotation)));
}

static bool has_arrived(const sbri_character *c) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    const sbr_transform *to = &sbri_rigid_targets(c)[b], *at = &sbri_rigid_bodies(c)[b].pose;
    if (!is_affected(c, b)) continue;
    if (sbri_length(sbri_sub(to->position, at->position)) > ARRIVED_M ||
        sbri_length(rotation_to(to, at)) > ARRIVED_RAD)
      return false;
  }
  return true;
}

static float strength_of(const sbri_rigid_drive_state *drive) {
  float t = sbri_clamp(drive->fall.posture_s / drive->fall.rise_s, 0, 1);
  return t * t * (3 - 2 * t);
}

bool sbri_reflex_tick(const sbr_world *world, sbri_character *c) {
  sbri_rigid_drive_state *drive = c->model->rigid.body_count ? sbri_rigid_drive(c) : NULL;
  float tick_s = (float)world->time.tick_s * c->time_scale;
  if (!drive || drive->fall.posture == SBR_POSTURE_UPRIGHT) return false;
  drive->fall.posture_s += tick_s;
  if (drive->fall.posture == SBR_POSTURE_FALLING) {
    drive->fall.still_s = fastest_of(c) <= STILL_M_S ? drive->fall.still_s + tick_s : 0;
    if (drive->fall.still_s < drive->fall.rest_s &&
        drive->fall.posture_s < LONGEST_FALL_S + drive->fall.rest_s)
      return false;
    drive->fall.posture = SBR_POSTURE_RISING;
    drive->fall.posture_s = 0;
    set_standing_pose(world, c);
    return true;
  }
  float w = strength_of(drive);
  bool up = w >= 1 && (has_arrived(c) || drive->fall.posture_s > drive->fall.rise_s + LATE_S);
  if (up)
    sbri_reflex_end(c);
  else
    set_all(c, SBR_RIGID_DRIVEN, drive->fall.drive_fraction + (1 - drive->fall.drive_fraction) * w);
  return false;
}

static sbf_vec3 bounded(sbf_vec3 v, float max) {
  float length = sbri_length(v);
  return length > max ? sbri_scale(v, max / length) : v;
}

void sbri_reflex_act(const sbri_character *c, const sbri_rigid_tick *t, float step_s) {
  const sbri_rigid_drive_state *drive = t->drive;
  if (drive->fall.posture != SBR_POSTURE_RISING) return;
  float fraction = strength_of(drive), w = TWO_PI * (FIRST_HZ + (LAST_HZ - FIRST_HZ) * fraction);
  for (uint32_t b = 0; b < t->model->body_count; b++) {
    if (!is_affected(c, b) || !sbri_rigid_is_simulated(c, b)) continue;
    const sbri_rigid_body *is = &t->model->bodies[b];
    sbri_rigid_body_state *body = &t->bodies[b];
    sbf_vec3 turn = sbri_angular_velocity_from_momentum(is, body->pose.rotation, body->angular_momentum);
    sbf_vec3 acceleration = sbri_scale(sbri_sub(t->targets[b].position, body->pose.position), w * w);
    sbf_vec3 twist = sbri_scale(rotation_to(&t->targets[b], &body->pose), w * w);
    acceleration = bounded(sbri_add_scaled(acceleration, body->velocity, -2 * w), fraction * MAX_M_S2);
    twist = bounded(sbri_add_scaled(twist, turn, -2 * w), fraction * MAX_RAD_S2);
    float load = 1 + t->model->attached_masses[b] * is->inverse_mass;
    acceleration = sbri_add_scaled(acceleration, t->gravity, -fraction * is->source->gravity_scale * load);
    body->velocity = sbri_add_scaled(body->velocity, acceleration, step_s);
    body->angular_momentum =
        sbri_angular_momentum_from_velocity(is, body->pose.rotation, sbri_add_scaled(turn, twist, step_s));
  }
}
