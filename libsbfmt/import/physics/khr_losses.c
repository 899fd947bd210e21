/* Reports what an asset cannot hold of a file's rigid bodies, each once with its number. */
#include "import/physics/physics.h"

static const char *const texts[SBFI_LOSS_COUNT] = {
    [SBFI_LOSS_COMPOUND] = "bodies of several colliders: one convex hull around all",
    [SBFI_LOSS_CONCAVE] = "concave collision meshes: their convex hulls",
    [SBFI_LOSS_PLANE] = "planes and flat meshes: slabs below them, 200 m wide for infinite planes",
    [SBFI_LOSS_STATIC] =
        "static colliders: kinematic bodies, which others meet in worlds with body contacts, as of `run`",
    [SBFI_LOSS_GEOMETRY] = "collision shapes that are flat or cannot be read: left out",
    [SBFI_LOSS_SHAPE_TYPE] = "collision shapes of unknown types: left out",
    [SBFI_LOSS_TRIGGER] = "triggers: left out",
    [SBFI_LOSS_STATIC_FRICTION] = "static frictions other than the dynamic one: left out",
    [SBFI_LOSS_COMBINE] = "rules of combining friction or restitution: left out",
    [SBFI_LOSS_MATERIALS] =
        "colliders with another material or filter than the first of their body: the first's",
    [SBFI_LOSS_SYSTEMS] = "collision filters beyond 31 sets of systems: the last set's",
    [SBFI_LOSS_VELOCITY] = "velocities of kinematic bodies: left out",
    [SBFI_LOSS_NO_MASS] = "bodies with neither mass nor shape: 1 kg",
    [SBFI_LOSS_INFINITE_MASS] = "infinite masses: 1,000,000 kg",
    [SBFI_LOSS_INFINITE_INERTIA] = "infinite moments of inertia: 1,000 times the largest",
    [SBFI_LOSS_STATIC_JOINT] = "joints between static nodes: left out",
    [SBFI_LOSS_TUBE] = "limits of the distance from a line: a square around the circle",
    [SBFI_LOSS_ROTATION] = "limits of the rotation about all axes: a cone and a twist of that angle",
    [SBFI_LOSS_CONE_MIN] = "least angles of cones: left out",
    [SBFI_LOSS_CONES] = "cones about an axis other than the joint's first: left out",
    [SBFI_LOSS_SEVERAL_ANGLES] =
        "joints with angles limited about several axes: twist and swings, equal for small angles",
    [SBFI_LOSS_ACCELERATION] = "drives in acceleration mode: multiplied by the effective mass at rest",
    [SBFI_LOSS_DRIVE] = "drives of unknown types: left out",
};

void sbfi_physics_report(sbfi_conversion *c) {
  for (int i = 0; i < SBFI_LOSS_COUNT; i++)
    if (c->physics->losses[i])
      sbfi_convert_warn(
          c, SBF_CODE_IMPORT_IGNORED, "%u of KHR_physics_rigid_bodies: %s", c->physics->losses[i], texts[i]);
}

/* No part of a skin becomes soft. */
static bool make_all_rigid(sbfi_conversion *c) {
  sbf_section_recipe *recipe = sbfi_convert_allocate(c, 1, sizeof *recipe);
  if (!recipe) return sbfi_convert_no_memory(c) == SBF_OK;
  sbf_section_recipe_init(recipe);
  recipe->rigid = true;
  c->asset->section_recipes = (sbf_section_recipe_list){recipe, 1};
  return true;
}

sbf_status sbfi_physics_convert(sbfi_conversion *c) {
  if ((c->physics->is_simulated && !make_all_rigid(c)) || !sbfi_physics_convert_bodies(c) ||
      !sbfi_physics_convert_joints(c))
    return sbf_code_find(c->error->code)->fault;
  sbfi_physics_report(c);
  return SBF_OK;
}
