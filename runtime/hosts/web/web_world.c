/* Assets, models, worlds and colliders: creation, reads and destruction. */
#include <stdlib.h>
#include <string.h>

#include "sbfmt/gltf.h"
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

/* `bytes` must stay until the asset is freed. NULL: see web_failure_message. */
sbf_asset *WEB_CALL(web_asset_load)(const void *bytes, size_t size) {
  sbf_asset *asset = NULL;
  const sbf_load_options options = {.check_crc = true, .with_images = true};
  memset(&failure, 0, sizeof failure);
  sbf_status (*load)(const void *, size_t, const sbf_load_options *, sbf_asset **, sbf_diagnostic *) =
      sbf_gltf_is_begun(bytes, size) ? sbf_gltf_load_memory : sbf_packed_load_memory;
  return load(bytes, size, &options, &asset, &failure) == SBF_OK ? asset : NULL;
}
void WEB_CALL(web_asset_free)(sbf_asset *asset) {
  sbf_asset_free(asset);
}

sbr_model *WEB_CALL(web_model_create)(const sbf_asset *asset, uint32_t level, const char *scheme,
    uint32_t substeps, uint32_t loose, uint32_t has_gravity, float x, float y, float z, uint32_t scalar,
    uint32_t has_detail_levels) {
  sbr_model *model = NULL;
  sbr_model_options options = sbr_default_model_options();
  options.level = level;
  options.scheme = SBF_SCHEME_COUNT; /* refused if the name is unknown */
  options.substeps = substeps;
  options.free = loose != 0;
  options.has_gravity = has_gravity != 0;
  options.gravity = (sbf_vec3){x, y, z};
  options.detail_levels = has_detail_levels != 0;
  options.instructions = scalar ? SBR_INSTRUCTIONS_SCALAR : SBR_INSTRUCTIONS_AUTOMATIC;
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

/* A ground of heights in memory that must stay until web_free of the result. */
sbr_height_field *WEB_CALL(web_heights_create)(
    const float *heights, uint32_t columns, uint32_t rows, double cell, double x, double z) {
  sbr_height_field *made = malloc(sizeof *made);
  if (made)
    *made = (sbr_height_field){
        .heights_m = heights, .columns = columns, .rows = rows, .cell_m = cell, .x = x, .z = z};
  return made;
}

/* For heights, `a` is their address. */
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
/* Heights and normals (x, y, z) of the same ground as in a world, at `count` positions (x, z). */
void WEB_CALL(web_ground_heights)(uint32_t kind, double a, double b, const float *coordinates, uint32_t count,
    float *heights, sbf_vec3 *normals) {
  sbr_ground ground = ground_of(kind, a, b);
  for (uint32_t i = 0; i < count; i++)
    heights[i] = (float)ground.height(
        &ground, (double)coordinates[2 * i], (double)coordinates[2 * i + 1], &normals[i]);
}

/* ---- Events ---- */

/* An event as twenty numbers. Numbers that its kind does not have are 0, or -1 for bodies. */
enum { EVENT_NUMBERS = 20 };

typedef struct event_list {
  double *to;
  uint32_t count, capacity;
} event_list;

/* The numbers of the next event, or NULL without capacity. */
static double *add_event(
    event_list *list, uint32_t kind, sbr_character_id character, uint64_t tick, sbr_double3 position) {
  if (list->count == list->capacity) return NULL;
  double *to = list->to + EVENT_NUMBERS * (size_t)list->count++;
  const double numbers[EVENT_NUMBERS] = {kind, character.value, 0, -1, -1, 0, (double)tick, 0, position.x,
      position.y, position.z, 0, 0, 0, 0, -1, -1, 0, 0, 0};
  memcpy(to, numbers, sizeof numbers);
  return to;
}

static void add_contacts(event_list *list, uint32_t kind, const sbr_contact_event *events, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    const sbr_contact_event *e = &events[i];
    double *to = add_event(list, kind, e->a.character, e->tick, e->position);
    if (!to) return;
    to[3] = e->a.soft_body, to[4] = e->a.rigid_body, to[5] = e->b.collider.value, to[7] = (double)e->impulse;
    to[11] = (double)e->normal.x, to[12] = (double)e->normal.y, to[13] = (double)e->normal.z;
    to[14] = e->b.character.value, to[15] = e->b.soft_body, to[16] = e->b.rigid_body;
    to[17] = (double)e->speed;
  }
}

static void add_feet(event_list *list, uint32_t kind, const sbr_foot_event *events, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    double *to = add_event(list, kind, events[i].character, events[i].tick, events[i].position);
    if (to) to[2] = events[i].leg;
  }
}

static void add_soft_bodies(
    event_list *list, uint32_t kind, const sbr_soft_body_event *events, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    double *to = add_event(list, kind, events[i].character, events[i].tick, events[i].position);
    if (to) to[3] = events[i].soft_body;
  }
}

/* Writes the events of the last step, kind after kind, and returns their number, at most `capacity`. The
 * kinds' numbers are those of modules/events.js. */
uint32_t WEB_CALL(web_world_events)(const sbr_world *world, double *numbers, uint32_t capacity) {
  event_list list = {.to = numbers, .capacity = capacity};
  sbr_foot_events feet = sbr_world_get_foot_events(world);
  add_feet(&list, 0, feet.down, feet.down_count);
  add_feet(&list, 1, feet.up, feet.up_count);
  add_feet(&list, 2, feet.landed, feet.landed_count);
  sbr_tear_events tears = sbr_world_get_tear_events(world);
  add_soft_bodies(&list, 3, tears.torn, tears.torn_count);
  add_soft_bodies(&list, 4, tears.unsplit, tears.unsplit_count);
  sbr_sleep_events sleep = sbr_world_get_sleep_events(world);
  add_soft_bodies(&list, 5, sleep.asleep, sleep.asleep_count);
  add_soft_bodies(&list, 6, sleep.awake, sleep.awake_count);
  sbr_contact_events contacts = sbr_world_get_contact_events(world);
  add_contacts(&list, 7, contacts.begin, contacts.begin_count);
  add_contacts(&list, 8, contacts.end, contacts.end_count);
  add_contacts(&list, 9, contacts.hit, contacts.hit_count);
  const sbr_double3 nowhere = {0, 0, 0};
  sbr_detail_events detail = sbr_world_get_detail_events(world);
  for (uint32_t i = 0; i < detail.changed_count; i++) {
    const sbr_detail_event *e = &detail.changed[i];
    double *to = add_event(&list, 10, e->character, e->tick, nowhere);
    if (to) to[18] = e->from, to[19] = e->to;
  }
  sbr_memory_events memory = sbr_world_get_memory_events(world);
  for (uint32_t i = 0; i < memory.refused_count; i++)
    (void)add_event(&list, 11, memory.refused[i].character, memory.refused[i].tick, nowhere);
  return list.count;
}

/* First hit of a ray: eleven doubles, as in sbr_hit. */
uint32_t WEB_CALL(web_world_ray)(const sbr_world *world, double x, double y, double z, float along_x,
    float along_y, float along_z, double length, double *to) {
  sbr_hit hit;
  if (!sbr_world_cast_ray(
          world, (sbr_double3){x, y, z}, (sbf_vec3){along_x, along_y, along_z}, length, NULL, &hit))
    return 0;
  const double numbers[11] = {hit.object.collider.value, hit.object.character.value, hit.object.rigid_body,
      hit.object.soft_body, hit.position.x, hit.position.y, hit.position.z, (double)hit.normal.x,
      (double)hit.normal.y, (double)hit.normal.z, hit.distance};
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
