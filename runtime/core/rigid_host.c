/* What hosts ask of rigid parts and tell them: sbrun/rigid.h. */
#include "core/world.h"
#include "math/quat_log.h"
#include "mechanics/joint_freedom.h"
#include "rigid/joint_place.h"

sbr_rigid_drive sbr_default_rigid_drive(void) {
  return (sbr_rigid_drive){.frequency_hz = 4, .damping_ratio = 1, .strength = 2, .joint_damping_1_s = 2};
}

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
              (double)drive->strength, (double)drive->joint_damping_1_s}))
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
  sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[rigid_body];
  /* Masses go with the cube of the scale and times with its square root: speeds with the root too. */
  float share = c->time_scale / (c->scale * c->scale * c->scale);
  sbf_vec3 own = sbri_scale(impulse, share),
           arm = sbri_sub(sbri_scale(at, 1 / c->scale), body->pose.position);
  body->velocity = sbri_add_scaled(body->velocity, own, c->model->rigid.bodies[rigid_body].inverse_mass);
  body->spin = sbri_add(body->spin, sbri_cross(arm, own));
  sbri_rigid_wake(c);
}

sbr_rigid_state sbr_character_rigid_state(
    const sbr_world *world, sbr_character_id character, uint32_t rigid_body) {
  const sbri_character *c = sbri_character_of(world, character);
  sbr_rigid_state state = {.frame = {.rotation = {0, 0, 0, 1}}};
  if (!c || rigid_body >= c->model->rigid.body_count) return state;
  const sbri_rigid_body *is = &c->model->rigid.bodies[rigid_body];
  sbri_rigid_body_state now = sbri_rigid_bodies(c)[rigid_body];
  if (!sbri_rigid_drive(c)->any) now.pose = sbri_rigid_target(c, sbri_pose(c), rigid_body);
  float s = c->scale, mass = is->mass * s * s * s, speed = s * c->time_scale;
  sbf_quat turn = sbri_quat_multiply(now.pose.rotation, sbri_quat_conjugate(is->axes));
  sbf_vec3 off = sbri_rotate(turn, sbri_sub(is->source->center, is->center));
  sbf_vec3 w = sbri_spin_velocity(is, now.pose.rotation, now.spin);
  state.mode = (sbr_rigid_mode)now.mode;
  state.center = sbri_scale(now.pose.position, s);
  state.frame = (sbr_transform){sbri_scale(sbri_add(now.pose.position, off), s), sbri_quat_normalize(turn)};
  state.velocity = sbri_scale(now.velocity, speed);
  state.angular_velocity = sbri_scale(w, c->time_scale);
  state.mass = mass;
  sbf_vec3 g = world->has_gravity ? world->gravity : c->model->asset->environment.gravity;
  state.kinetic_j = 0.5f * (mass * sbri_dot(state.velocity, state.velocity) +
                               s * s * s * speed * speed * sbri_dot(now.spin, w));
  sbr_double3 o = sbri_head(c)->origin;
  state.potential_j =
      -mass * is->source->gravity_scale *
      (float)((double)g.x * (o.x + (double)state.center.x) + (double)g.y * (o.y + (double)state.center.y) +
              (double)g.z * (o.z + (double)state.center.z));
  return state;
}

/* Of one limit that is hard: by how much it is broken. */
static float beyond(const sbf_limit *limit, float value) {
  const float turn = 6.28318530718f;
  float best = INFINITY;
  int ways = limit->target == SBF_JOINT_AXIS_TWIST ? 1 : 0;
  for (int way = -ways; way <= ways; way++) {
    float v = value + (float)way * turn, off = v < limit->min ? limit->min - v : v - limit->max;
    best = off < best ? off : best;
  }
  return best > 0 ? best : 0;
}

sbr_joint_state sbr_character_joint_state(
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
    poses[side] = body < 0                   ? anchor
                  : sbri_rigid_drive(c)->any ? sbri_rigid_bodies(c)[body].pose
                                             : sbri_rigid_target(c, sbri_pose(c), (uint32_t)body);
    at[side] = &poses[side];
  }
  sbri_joint_place place = sbri_joint_place_of(joint, at, &anchor, sbri_vec3(0, 0, 0));
  for (int axis = 0; axis < SBF_JOINT_AXIS_COUNT; axis++) {
    bool turns = sbri_axis_turns((sbf_joint_axis)axis);
    float value = sbri_joint_coordinate(joint, &place, (sbf_joint_axis)axis), off = fabsf(value);
    if (axis <= SBF_JOINT_AXIS_SWING_Z && joint->held >> axis & 1) {
      float *worst = turns ? &state.bent : &state.apart;
      *worst = off * (turns ? 1 : c->scale) > *worst ? off * (turns ? 1 : c->scale) : *worst;
    }
    state.coordinates[axis] = turns ? value : value * c->scale;
    for (uint32_t l = 0; l < joint->source->limits.count; l++) {
      const sbf_limit *limit = &joint->source->limits.at[l];
      if (limit->target != (sbf_joint_axis)axis || limit->stiffness > 0 ||
          !sbfi_joint_is_free(joint->source->kind, limit->target))
        continue;
      float broken = beyond(limit, value), *worst = turns ? &state.beyond_angle : &state.beyond_length;
      if (!turns) broken *= c->scale;
      *worst = broken > *worst ? broken : *worst;
    }
  }
  bool bounded = false;
  for (uint32_t l = 0; l < joint->source->limits.count; l++)
    bounded = bounded || joint->source->limits.at[l].target == SBF_JOINT_AXIS_DISTANCE;
  float length = state.coordinates[SBF_JOINT_AXIS_DISTANCE] - joint->rest_distance * c->scale;
  if (!bounded && joint->source->kind == SBF_JOINT_KIND_DISTANCE) state.apart = fabsf(length);
  if (!bounded && joint->source->kind == SBF_JOINT_KIND_PULLEY) state.apart = length > 0 ? length : 0;
  float s = c->scale;
  state.force = sbri_scale(now->force, s * s * s); /* mass times length over the square of time */
  state.torque = sbri_scale(now->torque, s * s * s * s);
  state.broken = now->broken != 0;
  return state;
}
