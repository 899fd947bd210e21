/* Methods of SoftCharacter3D for scripts, without its properties. */
#include <stdio.h>
#include <stdlib.h>

#include "method_table.h"
#include "physics_parts.h"
#include "sbrun/detail.h"
#include "sbrun/rigid.h"
#include "soft_character.h"

CALL(drive) {
  soft_character *one = self;
  UNUSED;
  double wanted[3];
  for (int i = 0; i < 3; i++) {
    wanted[i] = gd_as_float(arguments[i]);
    if (!soft_character_fits(one, "drive", wanted[i], -SOFT_MAX, SOFT_MAX)) return;
  }
  one->settings.drive.forward_speed = wanted[0];
  one->settings.drive.sideways_speed = wanted[1];
  one->settings.drive.turn_speed = wanted[2];
  soft_character_drive(one);
}

CALL(teleport) {
  soft_character *one = self;
  UNUSED;
  if (!one->world) return;
  soft_character_set_position(one, gd_as_vector3(arguments[0]), (float)gd_as_float(arguments[1]));
  one->placement.is_placed = true;
  soft_character_follow(one);
  physics_parts_move(one->physics.parts, one);
}

CALL(reset_pose) {
  soft_character *one = self;
  UNUSED;
  if (!one->world) return;
  sbr_character_reset(one->world, one->id);
  one->grab.is_active = false;
  soft_character_set_loose_position(one);
  one->is_mesh_stale = true;
}

CALL(get_travelled) {
  soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_float(one->world ? sbr_character_get_distance(one->world, one->id) : 0));
}

CALL(get_state_hash) {
  soft_character *one = self;
  char text[32];
  UNUSED;
  snprintf(text, sizeof text, "%016llx",
      one->world ? (unsigned long long)sbr_world_get_state_hash(one->world) : 0);
  gd_assign(result, gd_string(text));
}

CALL(get_detail_level) {
  const soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_int(one->world ? sbr_character_get_detail_level(one->world, one->id) : 0));
}

CALL(get_leg_count) {
  soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_int(one->world ? sbr_character_get_legs(one->world, one->id, NULL, 0) : 0));
}

CALL(is_leg_planted) {
  soft_character *one = self;
  sbr_leg_state legs[64];
  uint32_t count = one->world ? sbr_character_get_legs(one->world, one->id, legs, 64) : 0;
  int64_t leg = gd_as_int(arguments[0]);
  gd_assign(result, gd_bool(leg >= 0 && leg < count && leg < 64 && legs[leg].planted));
}

/* World positions of a render mesh's vertices, in the file's order. */
CALL(get_skin) {
  soft_character *one = self;
  int64_t mesh = gd_as_int(arguments[0]);
  uint32_t count = one->world && mesh >= 0 && mesh < one->model->asset->render_meshes.count
                       ? sbr_character_get_skin(one->world, one->id, (uint32_t)mesh, NULL, NULL, NULL, 0)
                       : 0;
  gd_assign(result, gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, count));
  sbf_vec3 *points = count ? gd_vector3s(result) : NULL;
  if (!points) return;
  sbr_character_get_skin(one->world, one->id, (uint32_t)mesh, points, NULL, NULL, count);
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  for (uint32_t i = 0; i < count; i++)
    points[i] = (sbf_vec3){(float)(origin.x + (double)points[i].x), (float)(origin.y + (double)points[i].y),
        (float)(origin.z + (double)points[i].z)};
}

static sbr_body_health health_of(soft_character *one, const gd_variant *body) {
  int64_t index = gd_as_int(body);
  sbr_body_health none = {.volume_ratio = 1, .min_element_ratio = 1, .finite = true};
  if (!one->world || index < 0 || index >= one->model->asset->soft_bodies.count) return none;
  return sbr_character_get_body_health(one->world, one->id, (uint32_t)index);
}

CALL(get_volume_ratio) {
  gd_assign(result, gd_float(health_of(self, arguments[0]).volume_ratio));
}

CALL(get_max_strain) {
  gd_assign(result, gd_float(health_of(self, arguments[0]).max_strain));
}

CALL(is_asleep) {
  gd_assign(result, gd_bool(health_of(self, arguments[0]).asleep));
}

CALL(get_substeps_needed) {
  soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_int(one->model ? sbr_model_get_substeps(one->model->model) : 0));
}

/* Knocks the character over; it gets up by itself. */
CALL(knock_over) {
  soft_character *one = self;
  sbr_fall_definition fall = sbr_default_fall_definition();
  UNUSED;
  if (one->world) sbr_character_knock_over(one->world, one->id, &fall);
}

CALL(get_skeleton) {
  soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_copy(&one->skeleton));
}

/* The MeshInstance3D of a render mesh, for materials of surfaces and other properties. */
CALL(get_mesh_instance) {
  soft_character *one = self;
  UNUSED;
  gd_assign(result, character_mesh_instance(one->mesh, gd_as_int(arguments[0])));
}

/* Low and high corner of its bounds at rest, in the node's space, as drawn by the editor. */
CALL(get_rest_bounds) {
  soft_character *one = self;
  sbf_vec3 a = one->bounds.low, b = one->bounds.high;
  UNUSED;
  gd_assign(result, gd_aabb_value((gd_aabb){a, {b.x - a.x, b.y - a.y, b.z - a.z}}));
}

/* Lines of the bones in the present pose, in world space, two points each. */
CALL(get_bone_lines) {
  soft_character *one = self;
  uint32_t count = one->world ? one->model->asset->bones.count : 0;
  sbr_transform *bones = count ? malloc(count * sizeof *bones) : NULL;
  UNUSED;
  gd_assign(result, gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, bones ? 2 * (int64_t)count : 0));
  if (!bones) return;
  sbf_vec3 *line = gd_vector3s(result);
  sbr_double3 o = sbr_character_get_origin(one->world, one->id);
  sbr_character_get_bones(one->world, one->id, bones, count);
  for (uint32_t i = 0; i < count; i++) {
    sbf_quat q = bones[i].rotation;
    float length = one->model->asset->bones.at[i].length * one->scale;
    sbf_vec3 p = bones[i].position;
    p = (sbf_vec3){(float)o.x + p.x, (float)o.y + p.y, (float)o.z + p.z};
    line[2 * i] = p; /* its tail, along the bone's +Y */
    line[2 * i + 1] = (sbf_vec3){p.x + length * 2 * (q.x * q.y - q.w * q.z),
        p.y + length * (1 - 2 * (q.x * q.x + q.z * q.z)), p.z + length * 2 * (q.y * q.z + q.w * q.x)};
  }
  free(bones);
}

const gd_method soft_character_methods[] = {
    {"drive", drive, NOTHING, 3, {WITH("forward", FLOAT), WITH("sideways", FLOAT), WITH("turn", FLOAT)}},
    {"teleport", teleport, NOTHING, 2, {WITH("position", VECTOR3), WITH("heading", FLOAT)}},
    {"reset_pose", reset_pose, NOTHING, 0, {{0}}},
    {"knock_over", knock_over, NOTHING, 0, {{0}}},
    {"get_travelled", get_travelled, ANSWER(FLOAT), 0, {{0}}},
    {"get_detail_level", get_detail_level, ANSWER(INT), 0, {{0}}},
    {"get_leg_count", get_leg_count, ANSWER(INT), 0, {{0}}},
    {"is_leg_planted", is_leg_planted, ANSWER(BOOL), 1, {WITH("leg", INT)}},
    {"get_skin", get_skin, ANSWER(PACKED_VECTOR3_ARRAY), 1, {WITH("render_mesh", INT)}},
    {"get_volume_ratio", get_volume_ratio, ANSWER(FLOAT), 1, {WITH("soft_body", INT)}},
    {"get_max_strain", get_max_strain, ANSWER(FLOAT), 1, {WITH("soft_body", INT)}},
    {"is_asleep", is_asleep, ANSWER(BOOL), 1, {WITH("soft_body", INT)}},
    {"get_soft_mass", soft_character_get_soft_mass, ANSWER(FLOAT), 1, {WITH("soft_body", INT)}},
    {"get_soft_velocity", soft_character_get_soft_velocity, ANSWER(VECTOR3), 1, {WITH("soft_body", INT)}},
    {"get_soft_angular_velocity", soft_character_get_soft_angular_velocity, ANSWER(VECTOR3), 1,
        {WITH("soft_body", INT)}},
    {"set_soft_velocity", soft_character_set_soft_velocity, NOTHING, 3,
        {WITH("soft_body", INT), WITH("velocity", VECTOR3), WITH("angular_velocity", VECTOR3)}},
    {"apply_soft_impulse", soft_character_apply_soft_impulse, NOTHING, 3,
        {WITH("soft_body", INT), WITH("vertex", INT), WITH("impulse", VECTOR3)}},
    {"apply_soft_force", soft_character_apply_soft_force, NOTHING, 4,
        {WITH("soft_body", INT), WITH("vertex", INT), WITH("force", VECTOR3), WITH("seconds", FLOAT)}},
    {"get_nearest_vertex", soft_character_get_nearest_vertex, ANSWER(INT), 2,
        {WITH("soft_body", INT), WITH("position", VECTOR3)}},
    {"grab_vertex", soft_character_grab_vertex, NOTHING, 3,
        {WITH("soft_body", INT), WITH("vertex", INT), WITH("target", VECTOR3)}},
    {"release_vertex", soft_character_release_vertex, ANSWER(BOOL), 2,
        {WITH("soft_body", INT), WITH("vertex", INT)}},
    {"get_grab_force", soft_character_get_grab_force, ANSWER(VECTOR3), 2,
        {WITH("soft_body", INT), WITH("vertex", INT)}},
    {"get_pin_reactions", soft_character_get_pin_reactions, ANSWER(PACKED_VECTOR3_ARRAY), 1,
        {WITH("soft_body", INT)}},
    {"get_stress", soft_character_get_stress, ANSWER(PACKED_VECTOR3_ARRAY), 1, {WITH("soft_body", INT)}},
    {"get_substeps_needed", get_substeps_needed, ANSWER(INT), 0, {{0}}},
    {"get_state_hash", get_state_hash, ANSWER(STRING), 0, {{0}}},
    {"get_skeleton", get_skeleton, NODE("Skeleton3D"), 0, {{0}}},
    {"get_mesh_instance", get_mesh_instance, NODE("MeshInstance3D"), 1, {WITH("render_mesh", INT)}},
    {"get_rest_bounds", get_rest_bounds, ANSWER(AABB), 0, {{0}}},
    {"get_bone_lines", get_bone_lines, ANSWER(PACKED_VECTOR3_ARRAY), 0, {{0}}},
    {"_asset_changed", soft_character_asset_changed, NOTHING, 0, {{0}}},
    {0},
};
