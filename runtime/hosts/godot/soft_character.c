#include "pose_driver.h"

#include <stdio.h>
#include <stdlib.h>

/* Godot's notifications of a node. */
enum {
  ENTER_TREE = 10,
  EXIT_TREE = 11,
  READY = 13,
  INTERNAL_PROCESS = 25,
  INTERNAL_PHYSICS_PROCESS = 26,
  EDITOR_PRE_SAVE = 9001,
  EDITOR_POST_SAVE = 9002
};

static void report(const soft_character *one, const char *message, void (*log)(const char *)) {
  char name[256], line[1024];
  gd_variant text = GD_CALL(&one->node, "to_string");
  gd_as_text(&text, name, sizeof name);
  gd_free(&text);
  snprintf(line, sizeof line, "%s: %s", name, message);
  log(line);
}

void soft_character_error(const soft_character *one, const char *message) {
  report(one, message, gd_error);
}

void soft_character_warning(const soft_character *one, const char *message) {
  report(one, message, gd_warning);
}

static void notify(void *self, int32_t what, bool reversed) {
  soft_character *one = self;
  (void)reversed;
  if (what == ENTER_TREE || what == READY) {
    GD_DO(&one->node, "set_physics_process_internal", gd_bool(true));
    GD_DO(&one->node, "set_process_internal", gd_bool(true));
    if (!one->world) soft_character_make(one);
  } else if (what == EXIT_TREE) {
    soft_character_unmake(one);
  } else if (what == INTERNAL_PHYSICS_PROCESS) {
    if (one->world) shared_world_step(one);
  } else if (what == INTERNAL_PROCESS && one->world && one->is_mesh_stale) {
    if (!gd_take_bool(GD_CALL(&one->node, "is_visible_in_tree"))) return; /* drawn when it becomes visible */
    character_mesh_update(one->mesh, one);
    one->is_mesh_stale = false;
  } else if (what == EDITOR_PRE_SAVE || what == EDITOR_POST_SAVE) {
    soft_character_save(one, what == EDITOR_POST_SAVE);
  }
}

static void begin(void *self, GDExtensionObjectPtr object) {
  soft_character *one = self;
  gd_variant engine = gd_singleton("Engine");
  one->node = gd_object(object);
  one->resources.asset = gd_nil();
  one->resources.material = gd_nil();
  one->resources.surface_materials = gd_empty(GDEXTENSION_VARIANT_TYPE_DICTIONARY);
  one->skeleton = gd_nil();
  one->is_in_editor = gd_take_bool(GD_CALL(&engine, "is_editor_hint"));
  one->settings = (soft_settings){.simulation = {.use_threads = true, .gravity_scale = 1},
      .drive = {.max_turn_speed = 3},
      .collision = {.collision_layer = 1, .collision_mask = 1, .push_bodies = true, .push_limit = 5},
      .display = {.mirror_skeleton = true, .cast_shadow = 1, .layers = 1}};
  gd_free(&engine);
}

static void end(void *self) {
  soft_character *one = self;
  soft_character_unmake(one);
  free(one->clip_player);
  pose_driver_free(one);
  gd_free(&one->resources.asset);
  gd_free(&one->resources.material);
  gd_free(&one->resources.surface_materials);
  gd_free(&one->node);
}

#define ARGUMENT(name, kind)                                                                                 \
  { name, GDEXTENSION_VARIANT_TYPE_##kind, NULL }
static const gd_signal signals[] = {
    {"foot_down", 2, {ARGUMENT("leg", INT), ARGUMENT("position", VECTOR3)}},
    {"foot_up", 2, {ARGUMENT("leg", INT), ARGUMENT("position", VECTOR3)}},
    {"animation_finished", 1, {ARGUMENT("clip", STRING)}},
    {"landed", 1, {ARGUMENT("position", VECTOR3)}},
    {"contact", 5,
        {ARGUMENT("soft_body", INT), ARGUMENT("position", VECTOR3), ARGUMENT("normal", VECTOR3),
            ARGUMENT("impulse", FLOAT), ARGUMENT("with", OBJECT)}},
    {"input_event", 5,
        {{"camera", GDEXTENSION_VARIANT_TYPE_OBJECT, "Node"},
            {"event", GDEXTENSION_VARIANT_TYPE_OBJECT, "InputEvent"}, ARGUMENT("position", VECTOR3),
            ARGUMENT("normal", VECTOR3), ARGUMENT("shape", INT)}},
    {"mouse_entered", 0, {{0}}},
    {"mouse_exited", 0, {{0}}},
    {"contact_ended", 2, {ARGUMENT("soft_body", INT), ARGUMENT("with", OBJECT)}},
    {"struck", 5,
        {ARGUMENT("soft_body", INT), ARGUMENT("position", VECTOR3), ARGUMENT("normal", VECTOR3),
            ARGUMENT("speed", FLOAT), ARGUMENT("with", OBJECT)}},
    {"fell_asleep", 2, {ARGUMENT("soft_body", INT), ARGUMENT("position", VECTOR3)}},
    {"woke", 2, {ARGUMENT("soft_body", INT), ARGUMENT("position", VECTOR3)}},
    {"fell", 0, {{0}}},
    {"rising", 0, {{0}}},
    {"rose", 0, {{0}}},
    {"torn", 2, {ARGUMENT("soft_body", INT), ARGUMENT("position", VECTOR3)}},
    {0},
};

static const gd_constant constants[] = {
    {"Scheme", "SCHEME_AUTOMATIC", SBF_SCHEME_AUTOMATIC},
    {"Scheme", "SCHEME_SYMPLECTIC", SBF_SCHEME_SYMPLECTIC},
    {"Scheme", "SCHEME_POSITION_BASED", SBF_SCHEME_POSITION_BASED},
    {"Scheme", "SCHEME_RELAXATION", SBF_SCHEME_RELAXATION},
    {"Scheme", "SCHEME_EXPLICIT_EULER", SBF_SCHEME_EXPLICIT_EULER},
    {"Scheme", "SCHEME_HEUN", SBF_SCHEME_HEUN},
    {"Scheme", "SCHEME_BLOCK_DESCENT", SBF_SCHEME_BLOCK_DESCENT},
    {"Detail", "DETAIL_AUTOMATIC", SOFT_DETAIL_AUTOMATIC},
    {"Detail", "DETAIL_FULL", SOFT_DETAIL_FULL},
    {"Ground", "GROUND_PHYSICS", SOFT_GROUND_PHYSICS},
    {"Ground", "GROUND_FLAT", SOFT_GROUND_FLAT},
    {0},
};

static const gd_method *const method_tables[] = {soft_character_methods, soft_character_part_methods,
    soft_character_grab_methods, soft_character_animation_methods, soft_character_pose_methods,
    soft_character_movement_methods, NULL};

const gd_class soft_character_class = {
    .name = "SoftCharacter3D",
    .parent = "Node3D",
    .size = sizeof(soft_character),
    .begin = begin,
    .end = end,
    .notify = notify,
    .methods = method_tables,
    .virtuals = soft_character_virtuals,
    .properties = soft_character_properties,
    .signals = signals,
    .constants = constants,
};
