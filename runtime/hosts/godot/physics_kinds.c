#include "physics_kinds.h"

enum { MODE_STATIC = 0, MODE_RIGID = 2, MODE_RIGID_LINEAR = 3 };

static int64_t mode_of(const gd_variant *server, const gd_variant *body) {
  return gd_take_int(GD_CALL(server, "body_get_mode", gd_copy(body)));
}

bool body_is_rigid(const gd_variant *server, const gd_variant *body) {
  int64_t mode = mode_of(server, body);
  return mode == MODE_RIGID || mode == MODE_RIGID_LINEAR;
}

bool body_is_static(const gd_variant *server, const gd_variant *body) {
  return mode_of(server, body) == MODE_STATIC;
}

static bool is_class(const gd_variant *object, const char *name) {
  return gd_take_bool(GD_CALL(object, "is_class", gd_string(name)));
}

bool body_is_passed(const gd_variant *node, const gd_variant *object) {
  if (!gd_as_object(object) || !is_class(object, "Node")) return false;
  return is_class(object, "SoftCharacter3D") ||
         gd_take_bool(GD_CALL(node, "is_ancestor_of", gd_copy(object))) ||
         (is_class(object, "CharacterBody3D") &&
             gd_take_bool(GD_CALL(object, "is_ancestor_of", gd_copy(node))));
}
