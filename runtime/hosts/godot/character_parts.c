/* Methods of SoftCharacter3D for its parts in the physics space and its contacts. */
#include <string.h>

#include "contact_list.h"
#include "method_table.h"
#include "physics_parts.h"

void soft_character_apply_part_settings(soft_character *one) {
  if (!one->world || one->is_in_editor) return;
  if (!one->settings.collision.collision_layer) {
    physics_parts_free(one->physics.parts);
    one->physics.parts = NULL;
  } else if (!one->physics.parts) {
    one->physics.parts = physics_parts_make(one);
    physics_bodies_except(one->physics.bodies, one->physics.parts);
    if (one->placement.is_placed) physics_parts_move(one->physics.parts, one);
  }
  physics_parts_apply_settings(one->physics.parts, one);
}

int32_t soft_character_bone(const soft_character *one, const gd_variant *wanted) {
  char name[256];
  gd_as_text(wanted, name, sizeof name);
  for (uint32_t i = 0; one->model && name[0] && i < one->model->asset->bones.count; i++)
    if (!strcmp(one->model->asset->bones.at[i].name, name) ||
        !strcmp(one->model->asset->bones.at[i].id, name))
      return (int32_t)i;
  return -1;
}

static gd_variant bone_name(const soft_character *one, int32_t bone) {
  if (!one->model || bone < 0 || bone >= (int32_t)one->model->asset->bones.count) return gd_string("");
  const sbf_bone *of = &one->model->asset->bones.at[bone];
  return gd_string(of->name[0] ? of->name : of->id);
}

CALL(get_bone_of_shape) {
  const soft_character *one = self;
  gd_assign(result, bone_name(one, physics_parts_owner(one->physics.parts, gd_as_int(arguments[0])).bone));
}

CALL(get_soft_body_of_shape) {
  const soft_character *one = self;
  gd_assign(result, gd_int(physics_parts_owner(one->physics.parts, gd_as_int(arguments[0])).soft_body));
}

CALL(get_rid) {
  const soft_character *one = self;
  UNUSED;
  gd_assign(result, physics_parts_rid(one->physics.parts));
}

/* ---- Contacts ---- */

static int32_t bone_of(const soft_character *one, const sbr_object *object) {
  const sbf_asset *asset = one->model->asset;
  if (object->soft_body >= 0) return asset->soft_bodies.at[object->soft_body].bone;
  return object->rigid_body >= 0 ? asset->rigid_bodies.at[object->rigid_body].bone : -1;
}

static gd_variant described(const soft_character *one, const sbr_contact_event *e, bool is_first) {
  const sbr_object *mine = is_first ? &e->a : &e->b, *others = is_first ? &e->b : &e->a;
  soft_character *other = shared_world_member(one->shared, others->character);
  float side = is_first ? 1 : -1;
  gd_variant made = gd_empty(GDEXTENSION_VARIANT_TYPE_DICTIONARY);
  gd_set_key(&made, "soft_body", gd_int(mine->soft_body));
  gd_set_key(&made, "bone", bone_name(one, bone_of(one, mine)));
  gd_set_key(&made, "position",
      gd_vector3((sbf_vec3){(float)e->position.x, (float)e->position.y, (float)e->position.z}));
  gd_set_key(
      &made, "normal", gd_vector3((sbf_vec3){side * e->normal.x, side * e->normal.y, side * e->normal.z}));
  gd_set_key(&made, "impulse", gd_float((double)e->impulse));
  gd_set_key(&made, "with",
      other ? gd_object(gd_as_object(&other->node))
            : physics_bodies_object(one->physics.bodies, others->collider));
  return made;
}

CALL(get_contacts) {
  const soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY));
  const contact_list *list = one->world ? shared_world_contacts(one->shared) : NULL;
  for (uint32_t i = 0; list && i < list->count; i++) {
    const sbr_contact_event *e = &list->each[i];
    if (e->a.character.value == one->id.value)
      GD_DO(result, "push_back", described(one, e, true));
    else if (e->b.character.value == one->id.value)
      GD_DO(result, "push_back", described(one, e, false));
  }
}

/* ---- Picking ---- */

CALL(report_picked) {
  const soft_character *one = self;
  UNUSED;
  GD_DO(&one->node, "emit_signal", gd_name("input_event"), gd_copy(arguments[0]), gd_copy(arguments[1]),
      gd_copy(arguments[2]), gd_copy(arguments[3]), gd_copy(arguments[4]));
}

CALL(report_mouse_entered) {
  const soft_character *one = self;
  UNUSED;
  GD_DO(&one->node, "emit_signal", gd_name("mouse_entered"));
}

CALL(report_mouse_exited) {
  const soft_character *one = self;
  UNUSED;
  GD_DO(&one->node, "emit_signal", gd_name("mouse_exited"));
}

const gd_method soft_character_part_methods[] = {
    {"get_bone_of_shape", get_bone_of_shape, ANSWER(STRING), 1, {WITH("shape", INT)}},
    {"get_soft_body_of_shape", get_soft_body_of_shape, ANSWER(INT), 1, {WITH("shape", INT)}},
    {"get_rid", get_rid, ANSWER(RID), 0, {{0}}},
    {"get_contacts", get_contacts, ANSWER(ARRAY), 0, {{0}}},
    {"_picked", report_picked, NOTHING, 5,
        {WITH("camera", OBJECT), WITH("event", OBJECT), WITH("position", VECTOR3), WITH("normal", VECTOR3),
            WITH("shape", INT)}},
    {"_mouse_entered", report_mouse_entered, NOTHING, 0, {{0}}},
    {"_mouse_exited", report_mouse_exited, NOTHING, 0, {{0}}},
    {0},
};
