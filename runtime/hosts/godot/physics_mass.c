#include "physics_mass.h"

#include "physics_kinds.h"
#include "turns.h"

body_mass body_mass_of(const gd_variant *server, const gd_variant *body) {
  body_mass mass = {0, {0, 0, 0}, {0, 0, 0}};
  if (!body_is_rigid(server, body)) return mass;
  gd_variant state = GD_CALL(server, "body_get_direct_state", gd_copy(body));
  if (gd_as_object(&state)) {
    mass.inverse = (float)gd_take_float(GD_CALL(&state, "get_inverse_mass"));
    mass.inverse_inertia = gd_take_vector3(GD_CALL(&state, "get_inverse_inertia"));
    mass.centre = gd_take_vector3(GD_CALL(&state, "get_center_of_mass_local"));
  }
  gd_free(&state);
  return mass;
}

static float inverse(float number) {
  return number > 0 ? 1 / number : 0;
}

/* Rotation of the body's principal axes in the world. */
static sbf_quat axes_of(const gd_variant *server, const gd_variant *body) {
  gd_variant state = GD_CALL(server, "body_get_direct_state", gd_copy(body));
  gd_variant axes = gd_as_object(&state) ? GD_CALL(&state, "get_principal_inertia_axes") : gd_nil();
  float m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int64_t k = 0; k < 3 && gd_type(&axes) == GDEXTENSION_VARIANT_TYPE_BASIS; k++) {
    sbf_vec3 v = gd_take_vector3(gd_at(&axes, k));
    m[0][k] = v.x, m[1][k] = v.y, m[2][k] = v.z;
  }
  gd_free(&axes);
  gd_free(&state);
  return turn_of(m);
}

void body_mass_give(const body_mass *mass, const gd_variant *server, const gd_variant *body, int64_t shape,
    sbr_collider_definition *collider) {
  sbf_vec3 i = mass->inverse_inertia, c = mass->centre;
  collider->mass = inverse(mass->inverse);
  collider->inertia = (sbf_vec3){inverse(i.x), inverse(i.y), inverse(i.z)};
  collider->inertia_axes = turn_product(turn_back(collider->rotation), axes_of(server, body));
  gd_variant inner = GD_CALL(server, "body_get_shape_transform", gd_copy(body), gd_int(shape));
  gd_transform t = gd_as_transform(&inner);
  gd_free(&inner);
  collider->centre =
      turned(turn_back(turn_of(t.basis)), (sbf_vec3){c.x - t.origin.x, c.y - t.origin.y, c.z - t.origin.z});
}
