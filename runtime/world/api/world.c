/* Public calls that create, step and destroy worlds. */
#include <math.h>
#include <string.h>

#include "base/diagnostic.h"
#include "coupling/body_contact/body_contacts.h"
#include "math/usable.h"
#include "world/api/api.h"
#include "world/detail/choose.h"
#include "world/step.h"

enum {
  WORLD_COOKIE = 0x5b72776f,
  DEFAULT_CAPACITY = 16,
  DEFAULT_COLLIDERS = 64,
  DEFAULT_EVENTS = 256,
  MAX_CHARACTERS = 65534,
  MAX_COLLIDERS = 65534,
  MAX_EVENTS = 1 << 20
};
/* Maximum length of a frame. */
static const double LONGEST_S = 3600;

sbr_world_definition sbr_default_world_definition(void) {
  return (sbr_world_definition){.cookie = WORLD_COOKIE,
      .ground = sbr_ground_flat(0),
      .gravity = {0, -9.81f, 0},
      .control_tick_s = 1.0 / 60,
      .longest_frame_s = 0.25,
      .character_capacity = DEFAULT_CAPACITY,
      .sleep_after_s = 0.5,
      .event_capacity = DEFAULT_EVENTS,
      .hit_speed = 1};
}

static int64_t units_of(double seconds) {
  return (int64_t)(seconds * SBRI_TIME_UNITS + 0.5);
}

sbf_status sbr_world_create(
    const sbr_world_definition *definition, sbr_world **world, sbf_diagnostic *error) {
  if (!definition || !world)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_world_create: NULL argument");
  *world = NULL;
  if (definition->cookie != WORLD_COOKIE)
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "sbr_world_create: begin the definition with sbr_default_world_definition");
  double tick = definition->control_tick_s != 0 ? definition->control_tick_s : 1.0 / 60;
  double longest = definition->longest_frame_s != 0 ? definition->longest_frame_s : 0.25;
  uint32_t capacity = definition->character_capacity ? definition->character_capacity : DEFAULT_CAPACITY;
  uint32_t colliders = definition->collider_capacity ? definition->collider_capacity : DEFAULT_COLLIDERS;
  uint32_t events = definition->event_capacity ? definition->event_capacity : DEFAULT_EVENTS;
  if (!(tick >= 1e-4 && tick <= 1) || !(longest > 0 && longest <= LONGEST_S) || capacity > MAX_CHARACTERS ||
      colliders > MAX_COLLIDERS || events > MAX_EVENTS || !(definition->hit_speed >= 0))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_world_create: out of range: tick %g s (0.0001 to 1), longest frame %g s (up to 3600), capacity "
        "%u or %u (up to %d), event_capacity %u (up to %d) or hit_speed %g m/s (at least 0)",
        tick, longest, capacity, colliders, (int)MAX_CHARACTERS, events, (int)MAX_EVENTS,
        (double)definition->hit_speed);
  const double gravity[3] = {
      (double)definition->gravity.x, (double)definition->gravity.y, (double)definition->gravity.z};
  if ((definition->has_gravity && !sbri_usable(gravity, 3)) || !sbri_usable(&definition->sleep_after_s, 1))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_world_create: gravity %g %g %g m/s^2 or sleep_after_s %g is invalid: use finite numbers",
        gravity[0], gravity[1], gravity[2], definition->sleep_after_s);
  sbf_allocator allocator = sbfi_allocator_or_default(definition->allocator);
  sbr_world *made = sbfi_allocate(&allocator, sizeof *made);
  sbri_character *characters = sbfi_allocate(&allocator, capacity * sizeof *characters);
  sbri_collider_set set;
  sbri_events lists;
  bool has_set = sbri_collider_set_make(&set, colliders, &allocator);
  bool has_events = sbri_events_create(&lists, events, &allocator);
  if (!made || !characters || !has_set || !has_events) {
    if (has_events) sbri_events_free(&lists, &allocator);
    if (has_set) sbri_collider_set_free(&set, &allocator);
    sbfi_free(&allocator, made, sizeof *made);
    sbfi_free(&allocator, characters, capacity * sizeof *characters);
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the world");
  }
  memset(characters, 0, capacity * sizeof *characters);
  *made = (sbr_world){.allocator = allocator,
      .tasks = definition->tasks,
      .ground = definition->ground.height ? definition->ground : sbr_ground_flat(0),
      .has_gravity = definition->has_gravity,
      .gravity = definition->gravity,
      .time.tick_s = tick,
      .time.tick_units = units_of(tick),
      .time.longest_units = units_of(longest),
      .sleep_ticks =
          definition->sleep_after_s > 0 ? 1 + (uint32_t)(fmin(definition->sleep_after_s, 1e6) / tick) : 0,
      .time.stamp = 1,
      .colliders = set,
      .events = lists,
      .hit_speed = definition->hit_speed,
      .characters = characters,
      .character_capacity = capacity,
      .user_data = definition->user_data};
  *world = made;
  return SBF_OK;
}

void sbr_world_destroy(sbr_world *world) {
  if (!world) return;
  sbr_world_set_recording(world, NULL);
  for (uint32_t i = 0; i < world->character_capacity; i++)
    if (world->characters[i].model) sbr_character_destroy(world, sbri_id_of(world, &world->characters[i]));
  sbf_allocator allocator = world->allocator;
  sbri_collider_set_free(&world->colliders, &allocator);
  sbri_events_free(&world->events, &allocator);
  sbri_body_contacts_free(world);
  sbri_detail_free(world);
  sbfi_free(&allocator, world->work.at, world->work.capacity * sizeof *world->work.at);
  sbfi_free(&allocator, world->characters, world->character_capacity * sizeof *world->characters);
  sbfi_free(&allocator, world, sizeof *world);
}

void sbr_world_set_user_data(sbr_world *world, void *user_data) {
  if (world) world->user_data = user_data;
}

void *sbr_world_get_user_data(const sbr_world *world) {
  return world ? world->user_data : NULL;
}

void sbr_world_step(sbr_world *world, double seconds) {
  if (!world) return;
  sbri_events_clear(&world->events);
  if (!(seconds > 0) || !sbri_usable(&seconds, 1)) return;
  if (seconds > LONGEST_S) seconds = LONGEST_S;
  sbri_record(world, SBRI_RECORDED_STEP, &seconds);
  double longest = (double)world->time.longest_units / SBRI_TIME_UNITS;
  world->time.ahead_units -= units_of(seconds < longest ? seconds : longest);
  while (world->time.ahead_units < -SBRI_TIME_SLACK) {
    sbri_step_tick(world);
    world->time.ahead_units += world->time.tick_units;
  }
  world->time.stamp++;
  sbri_record_hash(world);
}

void sbr_world_tick(sbr_world *world) {
  if (!world) return;
  sbri_events_clear(&world->events);
  sbri_record(world, SBRI_RECORDED_TICK, NULL);
  sbri_step_tick(world);
  world->time.stamp++;
  sbri_record_hash(world);
}

uint64_t sbr_world_get_tick_count(const sbr_world *world) {
  return world ? world->time.ticks : 0;
}

uint32_t sbr_world_count_awake_bodies(const sbr_world *world) {
  return world ? world->awake_count : 0;
}
