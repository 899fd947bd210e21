/* The runtime's ground below a physics space. Bodies are colliders (physics_bodies.c), so this is a
 * horizontal plane: far below if there is a body to stand on, else at the node's own height. */
#include <stdlib.h>

#include "physics_kinds.h"
#include "soft_character.h"

/* m: search distance below the node; and the depth of the plane if there is a body */
static const double DEEP = 1000;

enum { PASSED = 16 /* maximum number of bodies that a ray ignores */ };

struct physics_ground {
  double level;     /* m */
  bool warned;      /* the warning was given */
  gd_variant query; /* PhysicsRayQueryParameters3D */
};

static double height(const sbr_ground *asked, double x, double z, sbf_vec3 *normal) {
  const physics_ground *ground = asked->user;
  (void)x, (void)z;
  *normal = (sbf_vec3){0, 1, 0};
  return ground->level;
}

physics_ground *physics_ground_make(void) {
  physics_ground *made = calloc(1, sizeof *made);
  if (!made) return NULL;
  made->query = gd_new("PhysicsRayQueryParameters3D");
  return made;
}

void physics_ground_free(physics_ground *ground) {
  if (!ground) return;
  gd_free(&ground->query);
  free(ground);
}

sbr_ground physics_ground_of(physics_ground *ground) {
  return (sbr_ground){.height = height, .user = ground};
}

void physics_ground_level(physics_ground *ground, double level) {
  ground->level = level;
}

/* Whether a ray downwards from the node finds a body that is not its own. */
static bool finds_floor(const soft_character *one, const gd_variant *space, double above) {
  const gd_variant *query = &one->physics.ground->query;
  sbf_vec3 from = one->placement.shown_at.origin, to = from;
  gd_variant passed = gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY);
  bool found = false;
  from.y += (float)above, to.y -= (float)DEEP;
  GD_DO(query, "set_collision_mask", gd_int(one->settings.collision.collision_mask));
  GD_DO(query, "set_from", gd_vector3(from));
  GD_DO(query, "set_to", gd_vector3(to));
  for (int i = 0; i < PASSED && !found; i++) {
    GD_DO(query, "set_exclude", gd_copy(&passed));
    gd_variant hit = GD_CALL(space, "intersect_ray", gd_copy(query));
    bool any = gd_size(&hit) > 0;
    gd_variant object = any ? gd_key(&hit, "collider") : gd_nil();
    found = any && !body_is_passed(&one->node, &object);
    if (any && !found) GD_DO(&passed, "push_back", gd_key(&hit, "rid"));
    gd_free(&object);
    gd_free(&hit);
    if (!any) break;
  }
  gd_free(&passed);
  return found;
}

/* Once only, since it may be intended, as for a flying character. */
static void warn_of_nothing(const soft_character *one) {
  one->physics.ground->warned = true;
  soft_character_warning(one,
      "there is no ground: nothing below it has a layer of its collision_mask, so it stays where it is. "
      "Add a StaticBody3D with a CollisionShape3D, or set ground to GROUND_FLAT");
}

void physics_ground_query(soft_character *one) {
  double y = (double)one->placement.shown_at.origin.y;
  gd_variant world = GD_CALL(&one->node, "get_world_3d");
  gd_variant space = gd_as_object(&world) ? GD_CALL(&world, "get_direct_space_state") : gd_nil();
  bool has_space = gd_as_object(&space) != NULL;
  bool found = has_space && finds_floor(one, &space, soft_character_size(one));
  one->physics.ground->level = found ? y - 2 * DEEP : y;
  if (has_space && !found && !one->physics.ground->warned && !one->is_in_editor) warn_of_nothing(one);
  gd_free(&space);
  gd_free(&world);
}
