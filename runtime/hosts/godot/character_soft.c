/* Methods of SoftCharacter3D for soft bodies: impulses, grabs, forces and measurements (sbrun/soft_body.h).
 */
#include <stdlib.h>

#include "sbrun/soft_body.h"
#include "soft_character.h"

#define CALL(name) void name(void *self, const gd_variant *const *arguments, gd_variant *result)
#define UNUSED (void)arguments, (void)result
#define NO_BODY UINT32_MAX

/* Converts a number; the runtime refuses one that is out of range with a message. */
static uint32_t number_of(const gd_variant *value) {
  int64_t number = gd_as_int(value);
  return number >= 0 && number < NO_BODY ? (uint32_t)number : NO_BODY;
}
/* -1: the whole body. */
static uint32_t vertex_of(const gd_variant *value) {
  int64_t number = gd_as_int(value);
  if (number == -1) return SBR_WHOLE_BODY;
  return number >= 0 && number < NO_BODY ? (uint32_t)number : NO_BODY - 1;
}
static sbr_double3 position_of(const gd_variant *value) {
  sbf_vec3 at = gd_as_vector3(value);
  return (sbr_double3){(double)at.x, (double)at.y, (double)at.z};
}
static void report(const soft_character *one, sbf_status status, const sbf_diagnostic *error) {
  if (status != SBF_OK) soft_character_error(one, error->message);
}

static sbr_soft_motion motion_of(soft_character *one, const gd_variant *body) {
  if (!one->world) return (sbr_soft_motion){.mass = 0};
  return sbr_character_get_soft_motion(one->world, one->id, number_of(body));
}
CALL(soft_character_get_soft_mass) {
  gd_assign(result, gd_float((double)motion_of(self, arguments[0]).mass));
}
CALL(soft_character_get_soft_velocity) {
  gd_assign(result, gd_vector3(motion_of(self, arguments[0]).velocity));
}
CALL(soft_character_get_soft_angular_velocity) {
  gd_assign(result, gd_vector3(motion_of(self, arguments[0]).angular_velocity));
}

CALL(soft_character_set_soft_velocity) {
  soft_character *one = self;
  sbf_diagnostic error;
  UNUSED;
  if (one->world)
    report(one,
        sbr_character_set_soft_velocity(one->world, one->id, number_of(arguments[0]),
            gd_as_vector3(arguments[1]), gd_as_vector3(arguments[2]), &error),
        &error);
}

CALL(soft_character_apply_soft_impulse) {
  soft_character *one = self;
  sbf_diagnostic error;
  UNUSED;
  if (one->world)
    report(one,
        sbr_character_apply_soft_impulse(one->world, one->id, number_of(arguments[0]),
            vertex_of(arguments[1]), gd_as_vector3(arguments[2]), &error),
        &error);
}

CALL(soft_character_apply_soft_force) {
  soft_character *one = self;
  sbf_diagnostic error;
  UNUSED;
  if (one->world)
    report(one,
        sbr_character_apply_soft_force(one->world, one->id, number_of(arguments[0]), vertex_of(arguments[1]),
            gd_as_vector3(arguments[2]), (float)gd_as_float(arguments[3]), &error),
        &error);
}

CALL(soft_character_get_nearest_vertex) {
  soft_character *one = self;
  uint32_t vertex = one->world ? sbr_character_find_nearest_vertex(
                                     one->world, one->id, number_of(arguments[0]), position_of(arguments[1]))
                               : SBR_WHOLE_BODY;
  gd_assign(result, gd_int(vertex == SBR_WHOLE_BODY ? -1 : (int64_t)vertex));
}

CALL(soft_character_grab_vertex) {
  soft_character *one = self;
  sbf_diagnostic error;
  sbr_vertex_grab grab = sbr_default_vertex_grab();
  UNUSED;
  grab.target = position_of(arguments[2]);
  if (one->world)
    report(one,
        sbr_character_grab_vertex(
            one->world, one->id, number_of(arguments[0]), number_of(arguments[1]), &grab, &error),
        &error);
}

CALL(soft_character_release_vertex) {
  soft_character *one = self;
  bool released = one->world && sbr_character_release_vertex(
                                    one->world, one->id, number_of(arguments[0]), number_of(arguments[1]));
  gd_assign(result, gd_bool(released));
}

CALL(soft_character_get_grab_force) {
  soft_character *one = self;
  sbf_vec3 force = {0, 0, 0};
  if (one->world)
    force =
        sbr_character_get_grab_force(one->world, one->id, number_of(arguments[0]), number_of(arguments[1]));
  gd_assign(result, gd_vector3(force));
}

/* Force and torque of each pin set, one after the other. */
CALL(soft_character_get_pin_reactions) {
  soft_character *one = self;
  uint32_t body = number_of(arguments[0]);
  uint32_t count = one->world ? sbr_character_get_pin_reactions(one->world, one->id, body, NULL, 0) : 0;
  sbr_pin_reaction *pins = count ? malloc(count * sizeof *pins) : NULL;
  gd_assign(result, gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, pins ? 2 * (int64_t)count : 0));
  if (!pins) return;
  sbf_vec3 *to = gd_vector3s(result);
  sbr_character_get_pin_reactions(one->world, one->id, body, pins, count);
  for (uint32_t i = 0; i < count; i++) to[2 * i] = pins[i].force, to[2 * i + 1] = pins[i].torque;
  free(pins);
}

/* xx, yy, zz, then xy, yz, zx of each tetrahedron. */
CALL(soft_character_get_stress) {
  soft_character *one = self;
  uint32_t body = number_of(arguments[0]);
  uint32_t count = one->world ? sbr_character_get_tetrahedra(one->world, one->id, body, NULL, 0) : 0;
  sbr_tetrahedron_state *found = count ? malloc(count * sizeof *found) : NULL;
  gd_assign(result, gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, found ? 2 * (int64_t)count : 0));
  if (!found) return;
  sbf_vec3 *to = gd_vector3s(result);
  sbr_character_get_tetrahedra(one->world, one->id, body, found, count);
  for (uint32_t i = 0; i < count; i++) {
    const float *s = found[i].stress;
    to[2 * i] = (sbf_vec3){s[0], s[1], s[2]}, to[2 * i + 1] = (sbf_vec3){s[3], s[4], s[5]};
  }
  free(found);
}
