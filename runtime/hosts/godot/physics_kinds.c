#include "physics_kinds.h"

enum { MODE_RIGID = 2, MODE_RIGID_LINEAR = 3 };

bool body_is_rigid(const gd_variant *server, const gd_variant *body) {
  int64_t mode = gd_take_int(GD_CALL(server, "body_get_mode", gd_copy(body)));
  return mode == MODE_RIGID || mode == MODE_RIGID_LINEAR;
}

/* A frozen body's mode says nothing of what it is. */
bool body_moves(const gd_variant *server, const gd_variant *body, const gd_variant *object) {
  if (body_is_rigid(server, body)) return true;
  return gd_as_object(object) && (gd_take_bool(GD_CALL(object, "is_class", gd_string("CharacterBody3D"))) ||
                                     gd_take_bool(GD_CALL(object, "is_class", gd_string("RigidBody3D"))));
}

bool body_is_below(const gd_variant *node, const gd_variant *object) {
  return gd_as_object(object) && gd_take_bool(GD_CALL(object, "is_class", gd_string("Node"))) &&
         gd_take_bool(GD_CALL(node, "is_ancestor_of", gd_copy(object)));
}
