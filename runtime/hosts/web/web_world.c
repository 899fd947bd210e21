/* Assets, models, worlds, colliders: made, asked, and freed. */
#include <stdlib.h>
#include <string.h>

#include "web.h"

/* WebAssembly of one page or worker has one thread. */
static sbf_diagnostic failure;

sbf_diagnostic *web_failure(void) {
  return &failure;
}

const char *WEB_CALL(web_failure_message)(void) {
  return failure.message;
}
const char *WEB_CALL(web_failure_code)(void) {
  const sbf_code_info *info = sbf_code_find(failure.code);
  return info ? info->name : "";
}
const char *WEB_CALL(web_failure_path)(void) {
  return failure.path;
}

void *WEB_CALL(web_allocate)(size_t size) {
  return malloc(size ? size : 1);
}
void WEB_CALL(web_free)(void *memory) {
  free(memory);
}

/* ---- Assets and models ---- */

/* `bytes` stay in use until the asset is freed. NULL: web_failure_message says why. */
sbf_asset *WEB_CALL(web_asset_load)(const void *bytes, size_t size) {
  sbf_asset *asset = NULL;
  const sbf_load_options options = {.check_crc = true};
  memset(&failure, 0, sizeof failure);
  return sbf_packed_load_memory(bytes, size, &options, &asset, &failure) == SBF_OK ? asset : NULL;
}
void WEB_CALL(web_asset_free)(sbf_asset *asset) {
  sbf_asset_free(asset);
}

sbr_model *WEB_CALL(web_model_create)(const sbf_asset *asset, uint32_t level, const char *scheme,
    uint32_t substeps, uint32_t loose, uint32_t has_gravity, float x, float y, float z, uint32_t scalar,
    uint32_t has_detail_levels) {
  sbr_model *model = NULL;
  sbr_model_options options = {.level = level,
      .scheme = SBF_SCHEME_COUNT, /* refused, where the name is none */
      .substeps = substeps,
      .free = loose != 0,
      .has_gravity = has_gravity != 0,
      .gravity = {x, y, z},
      .detail_levels = has_detail_levels != 0,
      .instructions = scalar ? SBR_INSTRUCTIONS_SCALAR : SBR_INSTRUCTIONS_AUTOMATIC};
  memset(&failure, 0, sizeof failure);
  for (int i = 0; i < SBF_SCHEME_COUNT; i++)
    if (strcmp(scheme, sbf_scheme_name((sbf_scheme)i)) == 0) options.scheme = (sbf_scheme)i;
  return sbr_model_create(asset, &options, &model, &failure) == SBF_OK ? model : NULL;
}
void WEB_CALL(web_model_free)(sbr_model *model) {
  sbr_model_destroy(model);
}
uint32_t WEB_CALL(web_model_substeps)(const sbr_model *model) {
  return sbr_model_get_substeps(model);
}
const char *WEB_CALL(web_model_instructions)(const sbr_model *model) {
  return sbr_instructions_get_name(sbr_model_get_instructions(model));
}

/* ---- Worlds ---- */

enum ground_kind { GROUND_FLAT, GROUND_SLOPE, GROUND_STAIRS, GROUND_NOISE, GROUND_HEIGHTS };

/* Of heights that stay where they are until web_free of what is returned. */
sbr_height_field *WEB_CALL(web_heights_create)(
    const float *heights, uint32_t columns, uint32_t rows, double cell, double x, double z) {
  sbr_height_field *made = malloc(sizeof *made);
  if (made)
    *made = (sbr_height_field){
        .heights_m = heights, .columns = columns, .rows = rows, .cell_m = cell, .x = x, .z = z};
  return made;
}

/* Of heights `a` is where they are. */
static sbr_ground ground_of(uint32_t kind, double a, double b) {
  switch (kind) {
  case GROUND_HEIGHTS:
    return sbr_ground_height_field((const sbr_height_field *)(uintptr_t)(uint32_t)a);
  case GROUND_SLOPE:
    return sbr_ground_slope(a);
  case GROUND_STAIRS:
    return sbr_ground_stairs(a, b);
  case GROUND_NOISE:
    return sbr_ground_noise(a, (uint32_t)b);
  default:
    return sbr_ground_flat(a);
  }
}

sbr_world *WEB_CALL(web_world_create)(uint32_t ground, double a, double b, uint32_t has_gravity, float x,
    float y, float z, uint32_t characters, uint32_t colliders, double sleep_after_s,
    uint32_t contact_capacity) {
  sbr_world *world = NULL;
  sbr_world_definition definition = sbr_default_world_definition();
  memset(&failure, 0, sizeof failure);
  definition.ground = ground_of(ground, a, b);
  definition.has_gravity = has_gravity != 0;
  definition.gravity = (sbf_vec3){x, y, z};
  definition.character_capacity = characters;
  definition.collider_capacity = colliders;
  if (sleep_after_s >= 0) definition.sleep_after_s = sleep_after_s;
  if (sbr_world_create(&definition, &world, &failure) != SBF_OK) return NULL;
  if (contact_capacity && sbr_world_enable_body_contacts(world, contact_capacity, &failure) != SBF_OK) {
    sbr_world_destroy(world);
    return NULL;
  }
  return world;
}
void WEB_CALL(web_world_free)(sbr_world *world) {
  sbr_world_destroy(world);
}
void WEB_CALL(web_world_step)(sbr_world *world, double seconds) {
  sbr_world_step(world, seconds);
}
double WEB_CALL(web_world_ticks)(const sbr_world *world) {
  return (double)sbr_world_get_tick_count(world);
}
uint32_t WEB_CALL(web_world_awake)(const sbr_world *world) {
  return sbr_world_count_awake_bodies(world);
}
void WEB_CALL(web_world_hash)(const sbr_world *world, uint32_t *halves) {
  uint64_t hash = sbr_world_get_state_hash(world);
  halves[0] = (uint32_t)(hash >> 32);
  halves[1] = (uint32_t)hash;
}
size_t WEB_CALL(web_world_snapshot_size)(const sbr_world *world) {
  return sbr_world_get_snapshot_size(world);
}
uint32_t WEB_CALL(web_world_snapshot_save)(const sbr_world *world, void *bytes, size_t size) {
  return sbr_world_save_snapshot(world, bytes, size) == SBF_OK;
}
uint32_t WEB_CALL(web_world_snapshot_restore)(sbr_world *world, const void *bytes, size_t size) {
  return sbr_world_restore_snapshot(world, bytes, size) == SBF_OK;
}
/* Heights and normals (x, y, z) of the ground of a world made alike, at `count` places (x, z). */
void WEB_CALL(web_ground_heights)(uint32_t kind, double a, double b, const float *coordinates, uint32_t count,
    float *heights, sbf_vec3 *normals) {
  sbr_ground ground = ground_of(kind, a, b);
  for (uint32_t i = 0; i < count; i++)
    heights[i] = (float)ground.height(
        &ground, (double)coordinates[2 * i], (double)coordinates[2 * i + 1], &normals[i]);
}

/* An event as eighteen numbers: kind, character, leg, soft body, rigid body, collider, tick, impulse, place
 * (3), normal (3), the other's character, soft body and rigid body, speed. Returns how many there were,
 * `capacity` at most. */
uint32_t WEB_CALL(web_world_events)(sbr_world *world, double *to, uint32_t capacity) {
  sbr_event event;
  uint32_t count = 0;
  for (; count < capacity && sbr_world_take_events(world, &event, 1); count++, to += 18) {
    const double numbers[18] = {event.kind, event.character.value, event.leg, event.soft_body,
        event.rigid_body, event.collider.value, (double)event.tick, (double)event.impulse, event.position.x,
        event.position.y, event.position.z, (double)event.normal.x, (double)event.normal.y,
        (double)event.normal.z, event.other.value, event.other_soft_body, event.other_rigid_body,
        (double)event.speed};
    memcpy(to, numbers, sizeof numbers);
  }
  return count;
}

/* The first thing on a way: eleven doubles, as in sbr_hit. */
uint32_t WEB_CALL(web_world_ray)(const sbr_world *world, double x, double y, double z, float along_x,
    float along_y, float along_z, double length, double *to) {
  sbr_hit hit;
  if (!sbr_world_cast_ray(
          world, (sbr_double3){x, y, z}, (sbf_vec3){along_x, along_y, along_z}, length, UINT32_MAX, &hit))
    return 0;
  const double numbers[11] = {hit.collider.value, hit.character.value, hit.rigid_body, hit.soft_body,
      hit.position.x, hit.position.y, hit.position.z, (double)hit.normal.x, (double)hit.normal.y,
      (double)hit.normal.z, hit.distance};
  memcpy(to, numbers, sizeof numbers);
  return 1;
}

/* ---- Colliders ---- */

enum collider_kind { COLLIDER_SPHERE, COLLIDER_BOX, COLLIDER_CAPSULE };

sbr_shape *WEB_CALL(web_shape_create)(uint32_t kind, float radius, float x, float y, float z) {
  sbr_shape *shape = NULL;
  sbr_shape_definition definition = sbr_default_shape_definition();
  memset(&failure, 0, sizeof failure);
  definition.kind = kind == COLLIDER_BOX       ? SBR_SHAPE_BOX
                    : kind == COLLIDER_CAPSULE ? SBR_SHAPE_CAPSULE
                                               : SBR_SHAPE_SPHERE;
  definition.radius = radius;
  definition.half_sizes = (sbf_vec3){x, y, z};
  return sbr_shape_create(NULL, &definition, &shape, &failure) == SBF_OK ? shape : NULL;
}
void WEB_CALL(web_shape_free)(sbr_shape *shape) {
  sbr_shape_destroy(shape);
}
uint32_t WEB_CALL(web_collider_create)(sbr_world *world, const sbr_shape *shape, double x, double y, double z,
    float friction, float restitution) {
  sbr_collider_id collider = {0};
  sbr_collider_definition definition = sbr_default_collider_definition();
  memset(&failure, 0, sizeof failure);
  definition.shape = shape;
  definition.position = (sbr_double3){x, y, z};
  definition.friction = friction;
  definition.restitution = restitution;
  return sbr_collider_create(world, &definition, &collider, &failure) == SBF_OK ? collider.value : 0;
}
void WEB_CALL(web_collider_free)(sbr_world *world, uint32_t collider) {
  sbr_collider_destroy(world, (sbr_collider_id){collider});
}
void WEB_CALL(web_collider_move)(sbr_world *world, uint32_t collider, uint32_t at_once, double x, double y,
    double z, float qx, float qy, float qz, float qw) {
  (at_once ? sbr_collider_set_transform : sbr_collider_move)(
      world, (sbr_collider_id){collider}, (sbr_double3){x, y, z}, (sbf_quat){qx, qy, qz, qw});
}
