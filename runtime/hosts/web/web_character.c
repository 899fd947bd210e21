/* Characters: creation, control, impulses, and reads. */
#include <string.h>

#include "web.h"

static sbr_character_id id_of(uint32_t character) {
  return (sbr_character_id){character};
}

uint32_t WEB_CALL(web_character_create)(sbr_world *world, const sbr_model *model, double x, double y,
    double z, float heading, float scale, uint32_t hold_pose) {
  sbr_character_id character = {0};
  sbr_character_definition definition = sbr_default_character_definition();
  memset(web_failure(), 0, sizeof(sbf_diagnostic));
  definition.position = (sbr_double3){x, y, z};
  definition.heading = heading;
  definition.scale = scale;
  definition.hold_pose = hold_pose != 0;
  sbf_status status = sbr_character_create(world, model, &definition, &character, web_failure());
  return status == SBF_OK ? character.value : 0;
}
void WEB_CALL(web_character_free)(sbr_world *world, uint32_t character) {
  sbr_character_destroy(world, id_of(character));
}
void WEB_CALL(web_character_drive)(
    sbr_world *world, uint32_t character, float forward, float sideways, float turn) {
  sbr_character_set_drive(world, id_of(character), forward, sideways, turn);
}
void WEB_CALL(web_character_set_vertical_speed)(sbr_world *world, uint32_t character, float up) {
  sbr_character_set_vertical_speed(world, id_of(character), up);
}
void WEB_CALL(web_character_displace)(
    sbr_world *world, uint32_t character, float x, float y, float z, float turn) {
  sbr_character_displace(world, id_of(character), (sbf_vec3){x, y, z}, turn);
}
void WEB_CALL(web_character_teleport)(
    sbr_world *world, uint32_t character, double x, double y, double z, float heading) {
  sbr_character_teleport(world, id_of(character), (sbr_double3){x, y, z}, heading);
}
void WEB_CALL(web_character_reset)(sbr_world *world, uint32_t character) {
  sbr_character_reset(world, id_of(character));
}
void WEB_CALL(web_character_wake)(sbr_world *world, uint32_t character) {
  sbr_character_wake(world, id_of(character));
}
void WEB_CALL(web_character_pause)(sbr_world *world, uint32_t character, uint32_t paused) {
  sbr_character_set_paused(world, id_of(character), paused != 0);
}
void WEB_CALL(web_character_play)(sbr_world *world, uint32_t character, uint32_t layer, int32_t clip,
    float weight, float fade_s, float speed, float start_s) {
  sbr_clip_play how = sbr_default_clip_play();
  how.weight = weight, how.fade_s = fade_s, how.speed = speed, how.start_s = start_s;
  sbr_character_play_clip(world, id_of(character), layer, clip, &how);
}
/* A weight below 0 removes the target. */
void WEB_CALL(web_character_reach)(
    sbr_world *world, uint32_t character, uint32_t ik_chain, double x, double y, double z, float weight) {
  sbr_ik_target target = sbr_default_ik_target();
  target.position = (sbr_double3){x, y, z}, target.weight = weight;
  sbr_character_set_ik_target(world, id_of(character), ik_chain, weight < 0 ? NULL : &target);
}
void WEB_CALL(web_character_rigid_mode)(
    sbr_world *world, uint32_t character, int32_t rigid_body, uint32_t mode) {
  sbr_character_set_rigid_mode(world, id_of(character), rigid_body, (sbr_rigid_mode)mode);
}
void WEB_CALL(web_character_fall)(sbr_world *world, uint32_t character) {
  const sbr_fall_definition fall = sbr_default_fall_definition();
  sbr_character_knock_over(world, id_of(character), &fall);
}
uint32_t WEB_CALL(web_character_posture)(const sbr_world *world, uint32_t character) {
  return (uint32_t)sbr_character_get_posture(world, id_of(character));
}
void WEB_CALL(web_character_push)(sbr_world *world, uint32_t character, uint32_t rigid_body, double x,
    double y, double z, float impulse_x, float impulse_y, float impulse_z) {
  sbr_character_apply_rigid_impulse(world, id_of(character), rigid_body, (sbr_double3){x, y, z},
      (sbf_vec3){impulse_x, impulse_y, impulse_z});
}

/* Eighteen numbers: mode, position of the body's frame (3), its rotation (4), centre of mass (3), velocity
 * (3), angular velocity (3), mass; positions relative to the origin. */
void WEB_CALL(web_character_rigid)(
    const sbr_world *world, uint32_t character, uint32_t rigid_body, float *to) {
  sbr_rigid_state s = sbr_character_get_rigid_state(world, id_of(character), rigid_body);
  sbf_vec3 p = s.frame.position;
  sbf_quat q = s.frame.rotation;
  const float numbers[18] = {(float)s.mode, p.x, p.y, p.z, q.x, q.y, q.z, q.w, s.center.x, s.center.y,
      s.center.z, s.velocity.x, s.velocity.y, s.velocity.z, s.angular_velocity.x, s.angular_velocity.y,
      s.angular_velocity.z, s.mass};
  memcpy(to, numbers, sizeof numbers);
}

void WEB_CALL(web_character_origin)(const sbr_world *world, uint32_t character, sbr_double3 *origin) {
  *origin = sbr_character_get_origin(world, id_of(character));
}
/* Seven numbers per bone: position relative to the origin, rotation. */
void WEB_CALL(web_character_bones)(
    const sbr_world *world, uint32_t character, sbr_transform *bones, uint32_t capacity) {
  _Static_assert(sizeof(sbr_transform) == 28, "seven numbers");
  sbr_character_get_bones(world, id_of(character), bones, capacity);
}
uint32_t WEB_CALL(web_character_skin)(const sbr_world *world, uint32_t character, uint32_t mesh,
    sbf_vec3 *positions, sbf_vec3 *normals, sbf_vec4 *tangents, uint32_t capacity) {
  return sbr_character_get_skin(world, id_of(character), mesh, positions, normals, tangents, capacity);
}
uint32_t WEB_CALL(web_character_points)(
    const sbr_world *world, uint32_t character, uint32_t soft_body, sbf_vec3 *positions, uint32_t capacity) {
  return sbr_character_get_points(world, id_of(character), soft_body, positions, capacity);
}
double WEB_CALL(web_character_distance)(const sbr_world *world, uint32_t character) {
  return sbr_character_get_distance(world, id_of(character));
}

/* State of all bodies of the asset together: minimum volume ratio, maximum strain, energy (J), recoveries,
 * torn elements, whether all numbers are finite and nothing is inverted, whether all sleep. */
void WEB_CALL(web_character_health)(
    const sbr_world *world, uint32_t character, uint32_t body_count, double *to) {
  double all[7] = {1, 0, 0, 0, 0, 1, body_count > 0};
  for (uint32_t i = 0; i < body_count; i++) {
    sbr_body_health health = sbr_character_get_body_health(world, id_of(character), i);
    if ((double)health.volume_ratio < all[0]) all[0] = (double)health.volume_ratio;
    if ((double)health.max_strain > all[1]) all[1] = (double)health.max_strain;
    all[2] += health.kinetic_j + health.elastic_j + health.potential_j;
    all[3] += health.recoveries;
    all[4] += health.torn;
    if (!health.finite || health.inverted) all[5] = 0;
    if (!health.asleep) all[6] = 0;
  }
  memcpy(to, all, sizeof all);
}

/* Ten numbers per leg: planted, steps taken, phase, foot (3), target (3), 0. Returns the number of legs. */
uint32_t WEB_CALL(web_character_legs)(
    const sbr_world *world, uint32_t character, float *to, uint32_t capacity) {
  enum { MAX = 64 };
  sbr_leg_state legs[MAX];
  uint32_t count = sbr_character_get_legs(world, id_of(character), legs, MAX);
  for (uint32_t i = 0; i < count && i < capacity && i < MAX; i++, to += 10) {
    const sbr_leg_state *leg = &legs[i];
    const float numbers[10] = {leg->planted, (float)leg->steps_taken, leg->phase, leg->foot.x, leg->foot.y,
        leg->foot.z, leg->target.x, leg->target.y, leg->target.z, 0};
    memcpy(to, numbers, sizeof numbers);
  }
  return count;
}
