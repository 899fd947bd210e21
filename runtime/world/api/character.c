/* Public calls that create, move and destroy characters. */
#include <string.h>

#include "base/diagnostic.h"
#include "coupling/body_contact/body_contacts.h"
#include "coupling/ragdoll/ragdoll.h"
#include "math/usable.h"
#include "shapes/ground.h"
#include "soft/soft.h"
#include "state/pose/frames.h"
#include "world/api/api.h"
#include "world/detail/detail_levels.h"

enum { CHARACTER_COOKIE = 0x5b726368 };

sbr_character_definition sbr_default_character_definition(void) {
  return (sbr_character_definition){.cookie = CHARACTER_COOKIE, .scale = 1};
}

static bool reserve_work(sbr_world *world, size_t more) {
  size_t needed = more;
  for (uint32_t i = 0; i < world->character_capacity; i++)
    needed += world->characters[i].model ? world->characters[i].model->detail.base->detail.max_islands : 0;
  if (needed <= world->work.capacity) return true;
  sbri_work *grown = world->allocator.reallocate(
      world->allocator.user, world->work.at, world->work.capacity * sizeof *grown, needed * sizeof *grown);
  if (!grown) return false;
  world->work.at = grown;
  world->work.capacity = needed;
  return true;
}

static double rounded(double metres) {
  return (double)(int64_t)(metres < 0 ? metres - 0.5 : metres + 0.5);
}

/* Sets the origin to whole metres near `position`, and places the gait's state there. */
static void set_origin(const sbr_world *world, sbri_character *c, sbr_double3 position, float heading) {
  double ground = sbri_ground_height(&c->ground, position.x, position.z, NULL);
  sbri_header(c)->origin =
      (sbr_double3){rounded(position.x), rounded(ground + position.y), rounded(position.z)};
  sbr_double3 origin = sbri_header(c)->origin;
  sbri_gait_input input = sbri_gait_input_of(world, c, NULL);
  sbf_vec3 point = {(float)(position.x - origin.x), (float)position.y, (float)(position.z - origin.z)};
  sbri_gait_reset(&c->model->rig, sbri_gait(c), &input, point, heading);
  sbri_gait_pose(&c->model->rig, sbri_gait(c), &input, true, sbri_pose(c));
  sbr_transform root = sbri_current_root_frame(c, &c->ground);
  sbri_pose(c)[sbri_root_frame(c->model)] = root;
  sbri_pose(c)[sbri_anchor_frame(c->model)] = root;
  sbri_rigid_frames_follow(c, sbri_pose(c));
}

/* Bounds by single precision: a tick of the smallest scale is 17 s of a character of scale 1. */
static const float MIN_SCALE = 1e-6f, MAX_SCALE = 1e6f;

static sbf_status check_definition(const sbr_character_definition *definition, sbf_diagnostic *error) {
  if (definition->cookie != CHARACTER_COOKIE)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_character_create: begin the definition with sbr_default_character_definition");
  if (!(definition->scale >= MIN_SCALE && definition->scale <= MAX_SCALE))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_character_create: scale is %g: use one from %g to %g",
        (double)definition->scale, (double)MIN_SCALE, (double)MAX_SCALE);
  const double where[4] = {
      definition->position.x, definition->position.y, definition->position.z, (double)definition->heading};
  if (!sbri_usable(where, 4))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_character_create: position %g %g %g m or heading %g rad is invalid: use finite numbers up to "
        "1e15",
        where[0], where[1], where[2], where[3]);
  return SBF_OK;
}

/* Places the character at rest. */
static void set_initial_position(
    sbr_world *world, sbri_character *c, const sbr_character_definition *definition) {
  set_origin(world, c, definition->position, definition->heading);
  sbri_rigid_reset(c, true);
  sbri_jiggles_reset(c);
  sbri_restore_elements(c);
  sbri_character_reset_to_rest(c);
  sbri_work_list(world);
  world->time.stamp++;
}

sbf_status sbr_character_create(sbr_world *world, const sbr_model *model,
    const sbr_character_definition *definition, sbr_character_id *character, sbf_diagnostic *error) {
  if (!world || !model || !definition || !character)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_character_create: NULL argument");
  *character = (sbr_character_id){0};
  sbf_status status = check_definition(definition, error);
  if (status != SBF_OK) return status;
  uint32_t index = 0;
  while (index < world->character_capacity && world->characters[index].model) index++;
  if (index == world->character_capacity)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_character_create: the world already has its maximum of %u characters: raise character_capacity",
        world->character_capacity);
  uint32_t detail_level = definition->detail_level < model->detail.level_count
                              ? definition->detail_level
                              : model->detail.level_count - 1;
  sbri_character_storage storage;
  if (!sbri_character_storage_create(&world->allocator, model->detail.levels[detail_level], &storage))
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for a character");
  void **body_user_data = NULL;
  if (!reserve_work(world, model->detail.max_islands) || !sbri_body_contacts_reserve(world, model) ||
      !sbri_body_user_data_create(&world->allocator, model, &body_user_data)) {
    sbri_character_storage_free(&world->allocator, &storage);
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for a character");
  }
  sbri_character *c = &world->characters[index];
  *c = (sbri_character){.generation = (c->generation + 1) & 0xffff,
      .hold = definition->hold_pose,
      .scale = definition->scale,
      .time_scale = 1 / sqrtf(definition->scale),
      .ground = definition->ground.height ? definition->ground : world->ground,
      .spare = storage,
      .user_data = definition->user_data,
      .body_user_data = body_user_data};
  sbri_character_storage_swap(c);
  if (!sbri_contact_surfaces_create(world, index)) {
    sbri_body_user_data_free(&world->allocator, model, body_user_data);
    sbri_character_storage_free(&world->allocator, &storage);
    c->model = NULL;
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for a character's surfaces");
  }
  sbri_header(c)->detail_level = sbri_header(c)->next_detail_level = detail_level;
  sbri_header(c)->detail_level_ticks = UINT32_MAX; /* it has not ticked: it may change its level at once */
  set_initial_position(world, c, definition);
  *character = sbri_id_of(world, c);
  sbri_record(world, SBRI_RECORDED_MADE, (const double[]){character->value});
  return SBF_OK;
}

bool sbr_character_is_valid(const sbr_world *world, sbr_character_id character) {
  return sbri_character_of(world, character) != NULL;
}

void sbr_character_set_user_data(sbr_world *world, sbr_character_id character, void *user_data) {
  sbri_character *c = sbri_character_of(world, character);
  if (c) c->user_data = user_data;
}

void *sbr_character_get_user_data(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return c ? c->user_data : NULL;
}

void sbr_character_destroy(sbr_world *world, sbr_character_id character) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  sbri_record(world, SBRI_RECORDED_DESTROY, (const double[]){character.value});
  sbri_contact_surfaces_free(world, (uint32_t)(c - world->characters));
  sbri_pair_reports_remove(world, (uint32_t)(c - world->characters));
  sbri_rigid_work_free(&world->allocator, c);
  sbri_body_user_data_free(&world->allocator, c->model, c->body_user_data);
  sbri_character_storage_free(&world->allocator, &(sbri_character_storage){c->model, c->state, c->scratch});
  sbri_character_storage_free(&world->allocator, &c->spare);
  *c = (sbri_character){.generation = c->generation};
  sbri_work_list(world);
}

void sbr_character_set_drive(
    sbr_world *world, sbr_character_id character, float forward, float sideways, float turn) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  if (!sbri_record(world, SBRI_RECORDED_DRIVE,
          (const double[]){character.value, (double)forward, (double)sideways, (double)turn}))
    return;
  sbri_character_wake(c);
  sbri_header(c)->forward = forward;
  sbri_header(c)->sideways = sideways;
  sbri_header(c)->turn = turn;
}

void sbr_character_set_vertical_speed(sbr_world *world, sbr_character_id character, float up) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  if (!sbri_record(world, SBRI_RECORDED_VERTICAL, (const double[]){character.value, (double)up})) return;
  sbri_character_wake(c);
  sbri_header(c)->up = up;
}

void sbr_character_displace(sbr_world *world, sbr_character_id character, sbf_vec3 by, float turn) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  if (!sbri_record(world, SBRI_RECORDED_DISPLACE,
          (const double[]){character.value, (double)by.x, (double)by.y, (double)by.z, (double)turn}))
    return;
  sbri_character_wake(c);
  sbri_header(c)->displacement = sbri_add(sbri_header(c)->displacement, by);
  sbri_header(c)->rotation += turn;
}

void sbr_character_set_paused(sbr_world *world, sbr_character_id character, bool paused) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  sbri_record(world, SBRI_RECORDED_PAUSE, (const double[]){character.value, paused});
  sbri_header(c)->paused = paused;
}

void sbr_character_teleport(
    sbr_world *world, sbr_character_id character, sbr_double3 position, float heading) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  if (!sbri_record(world, SBRI_RECORDED_TELEPORT,
          (const double[]){character.value, position.x, position.y, position.z, (double)heading}))
    return;
  sbri_character_wake(c);
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_previous_deltas(c));
  sbri_header(c)->displacement = sbri_vec3(0, 0, 0), sbri_header(c)->rotation = 0;
  set_origin(world, c, position, heading);
  sbri_rigid_move_with_pose(c);
  sbri_jiggles_reset(c);
  sbri_fade_end(c);
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  for (uint32_t i = 0; i < c->model->island_count; i++) sbri_island_move_with_frames(c, i);
  sbri_character_stop(c);
  world->time.stamp++;
}

void sbr_character_reset(sbr_world *world, sbr_character_id character) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  sbri_record(world, SBRI_RECORDED_RESET, (const double[]){character.value});
  sbf_vec3 position;
  float heading;
  sbri_character_wake(c);
  sbri_gait_get_placement(sbri_gait(c), &position, &heading);
  sbr_double3 origin = sbri_header(c)->origin;
  sbri_header(c)->forward = sbri_header(c)->sideways = sbri_header(c)->turn = sbri_header(c)->up = 0;
  memset(sbri_loads(c), 0, SBR_LOAD_CAPACITY * sizeof(sbri_load));
  set_origin(world, c,
      (sbr_double3){origin.x + (double)position.x, position.y, origin.z + (double)position.z}, heading);
  sbri_rigid_reset(c, false);
  sbri_jiggles_reset(c);
  sbri_fade_end(c);
  sbri_restore_elements(c);
  sbri_character_reset_to_rest(c);
  world->time.stamp++;
}

void sbr_character_wake(sbr_world *world, sbr_character_id character) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c) return;
  sbri_record(world, SBRI_RECORDED_WAKE, (const double[]){character.value});
  sbri_character_wake(c);
  for (uint32_t i = 0; i < c->model->island_count; i++) sbri_island_wake(c, i);
}
