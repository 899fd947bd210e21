/* Impulses, grabs and measurements of soft bodies. On failure they return 0, with the reason in
 * web_failure(). */
#include <string.h>

#include "sbrun/soft_body.h"
#include "web.h"

static sbr_character_id id_of(uint32_t character) {
  return (sbr_character_id){character};
}
static sbf_diagnostic *begin(void) {
  memset(web_failure(), 0, sizeof(sbf_diagnostic));
  return web_failure();
}

uint32_t WEB_CALL(web_character_nearest_vertex)(
    const sbr_world *world, uint32_t character, uint32_t soft_body, double x, double y, double z) {
  return sbr_character_find_nearest_vertex(world, id_of(character), soft_body, (sbr_double3){x, y, z});
}
uint32_t WEB_CALL(web_character_grab)(sbr_world *world, uint32_t character, uint32_t soft_body,
    uint32_t vertex, double x, double y, double z, float frequency_hz, float max_force) {
  sbr_vertex_grab grab = sbr_default_vertex_grab();
  grab.target = (sbr_double3){x, y, z};
  grab.frequency_hz = frequency_hz, grab.max_force = max_force;
  return sbr_character_grab_vertex(world, id_of(character), soft_body, vertex, &grab, begin()) == SBF_OK;
}
uint32_t WEB_CALL(web_character_release)(
    sbr_world *world, uint32_t character, uint32_t soft_body, uint32_t vertex) {
  return sbr_character_release_vertex(world, id_of(character), soft_body, vertex);
}
/* SBR_WHOLE_BODY is 2^32 - 1. */
uint32_t WEB_CALL(web_character_soft_impulse)(
    sbr_world *world, uint32_t character, uint32_t soft_body, uint32_t vertex, float x, float y, float z) {
  return sbr_character_apply_soft_impulse(
             world, id_of(character), soft_body, vertex, (sbf_vec3){x, y, z}, begin()) == SBF_OK;
}
uint32_t WEB_CALL(web_character_soft_force)(sbr_world *world, uint32_t character, uint32_t soft_body,
    uint32_t vertex, float x, float y, float z, float seconds) {
  return sbr_character_apply_soft_force(
             world, id_of(character), soft_body, vertex, (sbf_vec3){x, y, z}, seconds, begin()) == SBF_OK;
}
uint32_t WEB_CALL(web_character_soft_velocity)(sbr_world *world, uint32_t character, uint32_t soft_body,
    float x, float y, float z, float turn_x, float turn_y, float turn_z) {
  return sbr_character_set_soft_velocity(world, id_of(character), soft_body, (sbf_vec3){x, y, z},
             (sbf_vec3){turn_x, turn_y, turn_z}, begin()) == SBF_OK;
}
/* Ten numbers: mass, centre of mass (3) relative to the origin, velocity (3), angular velocity (3). */
void WEB_CALL(web_character_soft_motion)(
    const sbr_world *world, uint32_t character, uint32_t soft_body, float *to) {
  sbr_soft_motion m = sbr_character_get_soft_motion(world, id_of(character), soft_body);
  _Static_assert(sizeof m == 40, "ten numbers");
  memcpy(to, &m, sizeof m);
}
void WEB_CALL(web_character_get_grab_force)(
    const sbr_world *world, uint32_t character, uint32_t soft_body, uint32_t vertex, float *to) {
  sbf_vec3 force = sbr_character_get_grab_force(world, id_of(character), soft_body, vertex);
  memcpy(to, &force, sizeof force);
}
/* 13 numbers per pin set: set, bone, rigid body and number of points as integers, then position, force,
 * torque. */
uint32_t WEB_CALL(web_character_pin_reactions)(
    const sbr_world *world, uint32_t character, uint32_t soft_body, sbr_pin_reaction *to, uint32_t capacity) {
  _Static_assert(sizeof *to == 52, "13 numbers");
  return sbr_character_get_pin_reactions(world, id_of(character), soft_body, to, capacity);
}
/* 14 numbers per tetrahedron: six of stress, energy density, rest volume, volume ratio, four corners, torn.
 */
uint32_t WEB_CALL(web_character_tetrahedra)(const sbr_world *world, uint32_t character, uint32_t soft_body,
    sbr_tetrahedron_state *to, uint32_t capacity) {
  _Static_assert(sizeof *to == 56, "14 numbers");
  return sbr_character_get_tetrahedra(world, id_of(character), soft_body, to, capacity);
}
