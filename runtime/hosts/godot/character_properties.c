/* Properties of SoftCharacter3D in the inspector, and warnings of the editor. */
#include "pose_driver.h"

#include <math.h>
#include <stdio.h>

/* Called when the resource has changed: the character takes its new content. */
void soft_character_asset_changed(void *self, const gd_variant *const *arguments, gd_variant *result) {
  (void)arguments;
  (void)result;
  soft_character_make(self);
}

gd_variant soft_character_callable(const soft_character *one, const char *name) {
  gd_variant made, method = gd_name(name);
  GDExtensionConstVariantPtr given[2] = {&one->node, &method};
  GDExtensionCallError error;
  gd.variant_construct(GDEXTENSION_VARIANT_TYPE_CALLABLE, &made, given, 2, &error);
  gd_free(&method);
  return made;
}

static void get_asset(void *self, const gd_variant *const *arguments, gd_variant *result) {
  (void)arguments;
  gd_assign(result, gd_copy(&((soft_character *)self)->resources.asset));
}

static void set_asset(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_character *one = self;
  (void)result;
  if (gd_as_object(&one->resources.asset) == gd_as_object(arguments[0])) return;
  if (gd_as_object(arguments[0]) && !gd_class_instance(&soft_asset_class, gd_as_object(arguments[0]))) {
    soft_character_error(one,
        "asset: the value is not a SoftAsset: load a .sbfz, or a .sbf that the plugin sbfmt has imported");
    return;
  }
  if (gd_as_object(&one->resources.asset))
    GD_DO(&one->resources.asset, "disconnect", gd_name("changed"),
        soft_character_callable(one, "_asset_changed"));
  gd_assign(&one->resources.asset, gd_copy(arguments[0]));
  if (gd_as_object(&one->resources.asset))
    GD_DO(
        &one->resources.asset, "connect", gd_name("changed"), soft_character_callable(one, "_asset_changed"));
  soft_character_make(one);
  GD_DO(&one->node, "update_configuration_warnings");
}

bool soft_character_fits(const soft_character *one, const char *name, double value, double low, double high) {
  char message[256];
  if (value >= low && value <= high) return true;
  snprintf(message, sizeof message, "%s: %g is not a number from %g to %g; it stays as it was", name, value,
      low, high);
  soft_character_error(one, message);
  return false;
}

/* A simple setting: its member of soft_settings, its name, and the action after a change. */
#define SETTING(field, name, type, low, high, after)                                                         \
  static void get_##name(void *self, const gd_variant *const *arguments, gd_variant *result) {               \
    (void)arguments;                                                                                         \
    gd_assign(result, gd_##type(((soft_character *)self)->settings.field));                                  \
  }                                                                                                          \
  static void set_##name(void *self, const gd_variant *const *arguments, gd_variant *result) {               \
    soft_character *one = self;                                                                              \
    (void)result;                                                                                            \
    if (one->settings.field == gd_as_##type(arguments[0])) return;                                           \
    if (!soft_character_fits(one, #name, (double)gd_as_##type(arguments[0]), low, high)) return;             \
    one->settings.field = gd_as_##type(arguments[0]);                                                        \
    after;                                                                                                   \
  }

static void get_material(void *self, const gd_variant *const *arguments, gd_variant *result) {
  (void)arguments;
  gd_assign(result, gd_copy(&((soft_character *)self)->resources.material));
}

static void set_material(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_character *one = self;
  (void)result;
  gd_assign(&one->resources.material, gd_copy(arguments[0]));
  character_mesh_apply_settings(one->mesh, one);
}

static void get_surface_materials(void *self, const gd_variant *const *arguments, gd_variant *result) {
  (void)arguments;
  gd_assign(result, GD_CALL(&((soft_character *)self)->resources.surface_materials, "duplicate"));
}

static void set_surface_materials(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_character *one = self;
  (void)result;
  gd_assign(&one->resources.surface_materials, GD_CALL(arguments[0], "duplicate"));
  character_mesh_apply_materials(one->mesh, one);
}

SETTING(
    simulation.scheme, scheme, int, SBF_SCHEME_AUTOMATIC, SBF_SCHEME_BLOCK_DESCENT, soft_character_make(one))
SETTING(simulation.substeps, substeps, int, 0, 1024, soft_character_make(one))
SETTING(simulation.level, level, int, 0, 64, soft_character_make(one))
SETTING(simulation.detail, detail, int, SOFT_DETAIL_AUTOMATIC, SOFT_DETAIL_FULL, soft_character_make(one))
SETTING(simulation.free_bodies, free_bodies, bool, 0, 1, soft_character_make(one))
SETTING(simulation.hold_pose, hold_pose, bool, 0, 1, soft_character_make(one))
SETTING(simulation.use_threads, use_threads, bool, 0, 1, soft_character_make(one))
SETTING(drive.forward_speed, forward_speed, float, -SOFT_MAX, SOFT_MAX, soft_character_drive(one))
SETTING(drive.sideways_speed, sideways_speed, float, -SOFT_MAX, SOFT_MAX, soft_character_drive(one))
SETTING(drive.turn_speed, turn_speed, float, -SOFT_MAX, SOFT_MAX, soft_character_drive(one))
SETTING(drive.vertical_speed, vertical_speed, float, -SOFT_MAX, SOFT_MAX, soft_character_drive(one))
SETTING(drive.max_turn_speed, max_turn_speed, float, 0, SOFT_MAX, (void)one)
SETTING(simulation.gravity_scale, gravity_scale, float, -SOFT_MAX, SOFT_MAX, soft_character_make(one))
SETTING(paused, paused, bool, 0, 1, soft_character_pause(one))
SETTING(preview, preview, bool, 0, 1, GD_DO(&one->node, "update_gizmos"))
SETTING(display.mirror_skeleton, mirror_skeleton, bool, 0, 1, soft_character_make(one))
SETTING(collision.ground, ground, int, 0, 1, soft_character_make(one))
SETTING(teleport_distance, teleport_distance, float, 0, SOFT_MAX, (void)one)
SETTING(collision.collision_layer, collision_layer, int, INT32_MIN, UINT32_MAX,
    soft_character_apply_part_settings(one))
SETTING(collision.input_ray_pickable, input_ray_pickable, bool, 0, 1, soft_character_apply_part_settings(one))
SETTING(collision.collision_mask, collision_mask, int, INT32_MIN, UINT32_MAX, (void)one)
SETTING(collision.push_bodies, push_bodies, bool, 0, 1, (void)one)
SETTING(collision.push_limit, push_limit, float, 0, SOFT_MAX, (void)one)
SETTING(collision.collide_with_others, collide_with_others, bool, 0, 1, soft_character_make(one))
SETTING(display.cast_shadow, cast_shadow, int, 0, 3, character_mesh_apply_settings(one->mesh, one))
SETTING(display.layers, layers, int, INT32_MIN, UINT32_MAX, character_mesh_apply_settings(one->mesh, one))
#undef SETTING

static void get_velocity(void *self, const gd_variant *const *arguments, gd_variant *result) {
  (void)arguments;
  gd_assign(result, gd_vector3(((soft_character *)self)->movement.velocity));
}

static void set_velocity(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_character *one = self;
  sbf_vec3 v = gd_as_vector3(arguments[0]);
  (void)result;
  if (soft_character_fits(one, "velocity", (double)v.x, -SOFT_MAX, SOFT_MAX) &&
      soft_character_fits(one, "velocity", (double)v.y, -SOFT_MAX, SOFT_MAX) &&
      soft_character_fits(one, "velocity", (double)v.z, -SOFT_MAX, SOFT_MAX))
    one->movement.velocity = v;
}

/* Made again where the asset with the clip is needed, or no longer. */
static void get_pose_source(void *self, const gd_variant *const *arguments, gd_variant *result) {
  const soft_character *one = self;
  (void)arguments;
  gd_assign(result,
      one->pose_driver ? gd_copy(&one->pose_driver->path) : gd_empty(GDEXTENSION_VARIANT_TYPE_NODE_PATH));
}

static void set_pose_source(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_character *one = self;
  pose_driver *pose = pose_driver_of(one);
  (void)result;
  if (!pose) return;
  gd_assign(&pose->path, gd_copy(arguments[0]));
  pose_driver_clear(one);
  pose->warned = false;
  if (one->model && pose_driver_is_used(one) != (soft_model_pose(one->model) != NULL))
    soft_character_make(one);
}

static void get_pose_weight(void *self, const gd_variant *const *arguments, gd_variant *result) {
  const soft_character *one = self;
  (void)arguments;
  gd_assign(result, gd_float(one->pose_driver ? one->pose_driver->weight : 1));
}

static void set_pose_weight(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_character *one = self;
  double weight = gd_as_float(arguments[0]);
  (void)result;
  if (!soft_character_fits(one, "pose_weight", weight, 0, 1) || !pose_driver_of(one)) return;
  one->pose_driver->weight = weight;
}

enum {
  HINT_RANGE = 1,
  HINT_ENUM = 2,
  HINT_LAYERS_3D_RENDER = 10,
  HINT_LAYERS_3D_PHYSICS = 11,
  HINT_RESOURCE_TYPE = 17,
  HINT_NODE_PATH_VALID_TYPES = 26
};

#define GROUP(title)                                                                                         \
  { .name = title }
#define SHOWN(label, kind, hint_kind, text, get_word, member)                                                \
  {                                                                                                          \
    .name = label, .type = GDEXTENSION_VARIANT_TYPE_##kind, .hint = hint_kind, .hint_text = text,            \
    .getter_name = get_word label, .setter_name = "set_" label, .get = get_##member, .set = set_##member     \
  }
#define CHOICE(label, of, text, member)                                                                      \
  {                                                                                                          \
    .name = label, .type = GDEXTENSION_VARIANT_TYPE_INT, .hint = HINT_ENUM, .hint_text = text,               \
    .class_name = of, .getter_name = "get_" label, .setter_name = "set_" label, .get = get_##member,         \
    .set = set_##member                                                                                      \
  }
#define RESOURCE(label, of, member)                                                                          \
  {                                                                                                          \
    .name = label, .type = GDEXTENSION_VARIANT_TYPE_OBJECT, .hint = HINT_RESOURCE_TYPE, .hint_text = of,     \
    .class_name = of, .getter_name = "get_" label, .setter_name = "set_" label, .get = get_##member,         \
    .set = set_##member                                                                                      \
  }
const gd_property soft_character_properties[] = {
    RESOURCE("asset", "SoftAsset", asset),
    SHOWN("paused", BOOL, 0, NULL, "is_", paused),
    SHOWN("preview", BOOL, 0, NULL, "is_", preview),
    GROUP("Drive"),
    SHOWN(
        "forward_speed", FLOAT, HINT_RANGE, "-5,5,0.01,or_less,or_greater,suffix:m/s", "get_", forward_speed),
    SHOWN("sideways_speed", FLOAT, HINT_RANGE, "-5,5,0.01,or_less,or_greater,suffix:m/s", "get_",
        sideways_speed),
    SHOWN(
        "turn_speed", FLOAT, HINT_RANGE, "-3.2,3.2,0.01,or_less,or_greater,suffix:rad/s", "get_", turn_speed),
    SHOWN("vertical_speed", FLOAT, HINT_RANGE, "-5,5,0.01,or_less,or_greater,suffix:m/s", "get_",
        vertical_speed),
    SHOWN("velocity", VECTOR3, 0, "suffix:m/s", "get_", velocity),
    SHOWN("max_turn_speed", FLOAT, HINT_RANGE, "0,10,0.01,or_greater,suffix:rad/s", "get_", max_turn_speed),
    GROUP("Animation"),
    SHOWN("pose_source", NODE_PATH, HINT_NODE_PATH_VALID_TYPES, "Skeleton3D", "get_", pose_source),
    SHOWN("pose_weight", FLOAT, HINT_RANGE, "0,1,0.01", "get_", pose_weight),
    GROUP("Simulation"),
    CHOICE("scheme", "SoftCharacter3D.Scheme",
        "Automatic,Symplectic,Position Based,Relaxation,Explicit Euler,Heun,Block Descent", scheme),
    SHOWN("substeps", INT, HINT_RANGE, "0,100,1,or_greater", "get_", substeps),
    SHOWN("level", INT, HINT_RANGE, "0,8,1", "get_", level),
    CHOICE("detail", "SoftCharacter3D.Detail", "Automatic,Full", detail),
    SHOWN("gravity_scale", FLOAT, HINT_RANGE, "-4,4,0.01,or_less,or_greater", "get_", gravity_scale),
    SHOWN("free_bodies", BOOL, 0, NULL, "is_", free_bodies),
    SHOWN("hold_pose", BOOL, 0, NULL, "is_", hold_pose),
    SHOWN("use_threads", BOOL, 0, NULL, "is_", use_threads),
    SHOWN("mirror_skeleton", BOOL, 0, NULL, "is_", mirror_skeleton),
    GROUP("Ground"),
    CHOICE("ground", "SoftCharacter3D.Ground", "Physics Space,Flat", ground),
    GROUP("Collision"),
    SHOWN("teleport_distance", FLOAT, HINT_RANGE, "0,10,0.01,or_greater,suffix:m", "get_", teleport_distance),
    SHOWN("collision_layer", INT, HINT_LAYERS_3D_PHYSICS, NULL, "get_", collision_layer),
    SHOWN("collision_mask", INT, HINT_LAYERS_3D_PHYSICS, NULL, "get_", collision_mask),
    SHOWN("input_ray_pickable", BOOL, 0, NULL, "is_", input_ray_pickable),
    SHOWN("push_bodies", BOOL, 0, NULL, "is_", push_bodies),
    SHOWN("push_limit", FLOAT, HINT_RANGE, "0,20,0.1,or_greater,suffix:m/s", "get_", push_limit),
    SHOWN("meet_others", BOOL, 0, NULL, "is_", collide_with_others),
    GROUP("Geometry"),
    RESOURCE("material_override", "Material", material),
    SHOWN("surface_materials", DICTIONARY, 0, NULL, "get_", surface_materials),
    CHOICE("cast_shadow", "GeometryInstance3D.ShadowCastingSetting", "Off,On,Double-Sided,Shadows Only",
        cast_shadow),
    SHOWN("layers", INT, HINT_LAYERS_3D_RENDER, NULL, "get_", layers),
    {0},
};

/* ---- Warnings ---- */

static bool is_uneven(const gd_transform *at) {
  float min = INFINITY, max = 0;
  for (int k = 0; k < 3; k++) {
    float size = sqrtf(at->basis[0][k] * at->basis[0][k] + at->basis[1][k] * at->basis[1][k] +
                       at->basis[2][k] * at->basis[2][k]);
    min = fminf(min, size), max = fmaxf(max, size);
  }
  return max > 1.001f * min;
}

static bool is_tilted(const gd_transform *at) {
  float x = at->basis[0][1], y = at->basis[1][1], z = at->basis[2][1];
  return !(y > 0) || x * x + z * z > 1e-4f * y * y;
}

static void warnings(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_character *one = self;
  soft_asset *asset = gd_class_instance(&soft_asset_class, gd_as_object(&one->resources.asset));
  gd_variant value = GD_CALL(&one->node, "get_transform");
  gd_transform at = gd_as_transform(&value);
  (void)arguments;
  gd_free(&value);
  gd_assign(result, gd_empty(GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY));
  if (!asset || !soft_asset_of(asset))
    GD_DO(result, "push_back",
        gd_string("There is nothing to show: set Asset to a .sbfz, or to a .sbf that the plugin sbfmt has "
                  "imported."));
  if (is_tilted(&at))
    GD_DO(result, "push_back",
        gd_string("The node is tilted, but the character stands upright: a character rotates only about +Y. "
                  "Set the rotation about X and Z to 0."));
  if (is_uneven(&at))
    GD_DO(result, "push_back",
        gd_string("The node is scaled unevenly: a character has one scale, the same along all axes."));
}

const gd_method soft_character_virtuals[] = {
    {"_get_configuration_warnings", warnings, true, {"", GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY, NULL},
        0, {{0}}},
    {0},
};
