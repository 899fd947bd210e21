#include <stdlib.h>

#include "detail_scenes.h"
#include "event_log.h"
#include "harness.h"
#include "host_threads.h"
#include "rigid_person.h"

/* Unused memory is freed after a second. */
enum { KEPT = 61, CROWD = 12 };

static size_t bytes_of(const scene *s, uint32_t detail_level) {
  sbr_detail_level detail_levels[LEVELS_OF_DETAIL];
  sbr_model_get_detail_levels(s->model, detail_levels, LEVELS_OF_DETAIL);
  return detail_levels[detail_level].bytes;
}

static scene begin(harness_memory *memory, size_t allowed, uint32_t detail_level) {
  scene s = detail_scene_begin(false);
  harness_memory_init(memory, allowed);
  s.world_definition.allocator = &memory->allocator;
  s.character_definition.detail_level = detail_level;
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 0.5f, 0, 0.8f);
  return s;
}

START_TEST(a_character_stores_only_its_detail_level)
{
  harness_memory memory;
  scene s = begin(&memory, SIZE_MAX, DETAIL_BONES);
  ck_assert_uint_eq(sbr_character_get_detail_level(s.world, s.character), DETAIL_BONES);
  size_t world = memory.held_bytes - bytes_of(&s, DETAIL_BONES);
  ck_assert_uint_lt(10 * bytes_of(&s, DETAIL_BONES), 4 * bytes_of(&s, DETAIL_FINE));
  ck_assert_uint_eq(bytes_of(&s, DETAIL_OFFSCREEN), bytes_of(&s, DETAIL_BONES));
  for (uint32_t r = 1; r < LEVELS_OF_DETAIL; r++) ck_assert_uint_le(bytes_of(&s, r), bytes_of(&s, r - 1));
  static const uint32_t goes[4] = {DETAIL_FINE, DETAIL_COARSE, DETAIL_JIGGLE, DETAIL_OFFSCREEN};
  uint32_t was = DETAIL_BONES;
  for (int i = 0; i < 4; was = goes[i++]) {
    sbr_character_set_detail_level(s.world, s.character, goes[i]);
    scene_ticks(&s, 10);
    ck_assert_uint_eq(memory.held_bytes, world + bytes_of(&s, was) + bytes_of(&s, goes[i]));
    scene_ticks(&s, KEPT);
    ck_assert_uint_eq(memory.held_bytes, world + bytes_of(&s, goes[i]));
  }
  scene_free(&s);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

START_TEST(ticks_allocate_only_at_a_change)
{
  harness_memory memory;
  scene s = begin(&memory, SIZE_MAX, DETAIL_FINE);
  size_t calls = memory.calls;
  scene_ticks(&s, 200);
  ck_assert_uint_eq(memory.calls, calls);
  for (uint32_t n = 0; n < 6; n++) { /* memory of a level that is unused for less than a second is kept */
    sbr_character_set_detail_level(s.world, s.character, n % 2 ? DETAIL_FINE : DETAIL_BONES);
    scene_ticks(&s, 50);
  }
  ck_assert_uint_eq(memory.calls, calls + 1);
  scene_free(&s);
}
END_TEST

/* Failed allocations in the last tick, all of one kind. */
static uint32_t refusals(const scene *s, sbr_memory_use use) {
  sbr_memory_events events = sbr_world_get_memory_events(s->world);
  for (uint32_t i = 0; i < events.refused_count; i++) {
    ck_assert_uint_eq(events.refused[i].character.value, s->character.value);
    ck_assert_int_eq(events.refused[i].use, use);
  }
  return events.refused_count;
}

/* The simulation continues as if nothing was requested, and changes level as soon as memory is available. */
START_TEST(a_failed_allocation_keeps_the_detail_level_and_is_reported)
{
  const uint32_t to = _i ? DETAIL_BONES : DETAIL_FINE, from = _i ? DETAIL_FINE : DETAIL_BONES;
  harness_memory memory, plenty;
  scene s = begin(&memory, SIZE_MAX, from), stays = begin(&plenty, SIZE_MAX, from);
  detail_scene_ticks(&s, &stays, 30);
  memory.allowed = memory.calls;
  sbr_character_set_detail_level(s.world, s.character, to);
  uint32_t refused = 0;
  for (int i = 0; i < 75; i++) {
    detail_scene_ticks(&s, &stays, 1);
    refused += refusals(&s, SBR_MEMORY_DETAIL_LEVEL);
  }
  ck_assert_uint_eq(refused, 3); /* at once, and every half second */
  ck_assert(detail_scene_apart(&s, &stays) == 0);
  ck_assert(sbr_character_get_detail_fade(s.world, s.character) == 0);
  ck_assert((detail_scene_elastic(&s) > 0) == (from == DETAIL_FINE));
  memory.allowed = SIZE_MAX;
  event_log log = {.memory_count = 0};
  scene_ticks_logged(&s, 40, &log);
  ck_assert_uint_eq(log.memory_count, 0);
  ck_assert_uint_eq(log.detail_count, 1);
  ck_assert((detail_scene_elastic(&s) > 0) == (to == DETAIL_FINE));
  scene_free(&s);
  scene_free(&stays);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

typedef struct crowd {
  scene s;
  sbr_character_id ids[CROWD];
} crowd;

/* A row of characters in front of the camera, along its view direction. */
static void check(const crowd *c, double from) {
  const sbr_view view = {{0, 1, from}, {0, 0, 1}, 1, 1.5f, 1080};
  sbr_world_set_views(c->s.world, &view, 1);
}

static crowd crowd_begin(harness_memory *memory, const sbr_tasks *tasks) {
  crowd c = {.s = detail_scene_begin(false)};
  sbr_detail_definition detail = sbr_default_detail_definition();
  detail.offscreen_after_s = -1;
  harness_memory_init(memory, SIZE_MAX);
  c.s.world_definition.allocator = &memory->allocator;
  c.s.world_definition.character_capacity = CROWD;
  if (tasks) c.s.world_definition.tasks = *tasks;
  c.s.character_definition.detail_level = DETAIL_BONES;
  scene_start(&c.s);
  c.ids[0] = c.s.character;
  ck_assert_int_eq(sbr_world_select_detail_levels(c.s.world, &detail, NULL), SBF_OK);
  for (uint32_t i = 0; i < CROWD; i++) {
    sbr_character_definition at = c.s.character_definition;
    at.position.z = 4.0 * i;
    if (i == 0) continue;
    ck_assert_int_eq(sbr_character_create(c.s.world, c.s.model, &at, &c.ids[i], NULL), SBF_OK);
  }
  for (uint32_t i = 0; i < CROWD; i++) sbr_character_set_drive(c.s.world, c.ids[i], 0.3f, 0, 0.1f * (float)i);
  return c;
}

START_TEST(a_distant_crowd_needs_a_fraction_of_the_memory)
{
  harness_memory memory;
  crowd c = crowd_begin(&memory, NULL);
  size_t world = memory.held_bytes - CROWD * bytes_of(&c.s, DETAIL_BONES);
  check(&c, -400);
  scene_ticks(&c.s, 2 * KEPT);
  ck_assert_uint_eq(memory.held_bytes, world + CROWD * bytes_of(&c.s, DETAIL_BONES));
  check(&c, -8);
  scene_ticks(&c.s, 4 * KEPT);
  size_t expected = world, soft = 0;
  for (uint32_t i = 0; i < CROWD; i++) {
    uint32_t detail_level = sbr_character_get_detail_level(c.s.world, c.ids[i]);
    expected += bytes_of(&c.s, detail_level);
    soft += detail_level <= DETAIL_COARSE;
  }
  ck_assert_uint_ge(soft, 2);
  ck_assert_uint_eq(memory.held_bytes, expected);
  check(&c, -400);
  scene_ticks(&c.s, 4 * KEPT);
  ck_assert_uint_eq(memory.held_bytes, world + CROWD * bytes_of(&c.s, DETAIL_BONES));
  scene_free(&c.s);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

/* The camera approaches and leaves. An allocation fails at each of the calls in turn. */
static uint64_t pass(crowd *c, harness_memory *memory, size_t allowed) {
  size_t before = memory->calls;
  check(c, -400);
  scene_ticks(&c->s, 10);
  memory->allowed = allowed == SIZE_MAX ? SIZE_MAX : before + allowed;
  for (int t = 0; t < 90; t++) {
    check(c, -30 + 0.3 * t);
    scene_ticks(&c->s, 1);
  }
  memory->allowed = SIZE_MAX;
  for (uint32_t i = 0; i < CROWD; i++)
    ck_assert(sbr_character_get_body_health(c->s.world, c->ids[i], 0).finite);
  scene_ticks(&c->s, 40);
  return sbr_world_get_state_hash(c->s.world);
}

START_TEST(changes_survive_every_failed_allocation)
{
  harness_memory memory;
  crowd all = crowd_begin(&memory, NULL);
  size_t begun = memory.calls;
  uint64_t end = pass(&all, &memory, SIZE_MAX);
  size_t calls = memory.calls - begun;
  scene_free(&all.s);
  ck_assert_uint_ge(calls, 4);
  for (size_t allowed = 0; allowed <= calls; allowed++) {
    crowd c = crowd_begin(&memory, NULL);
    uint64_t now = pass(&c, &memory, allowed);
    if (allowed == calls) ck_assert_uint_eq(now, end);
    scene_free(&c.s);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

/* Even where some get no memory, as it is asked for by one thread. */
START_TEST(threads_change_nothing)
{
  static int threads = 3;
  const sbr_tasks three = {run_on_threads, &threads};
  for (size_t allowed = 1; allowed; allowed = allowed == 1 ? SIZE_MAX : 0) {
    harness_memory memory, other;
    crowd one = crowd_begin(&memory, NULL), more = crowd_begin(&other, &three);
    ck_assert_uint_eq(pass(&one, &memory, allowed), pass(&more, &other, allowed));
    scene_free(&one.s);
    scene_free(&more.s);
  }
}
END_TEST

/* From a detail level whose memory has been given back, and while it goes over. */
START_TEST(snapshots_restore_any_detail_level)
{
  for (uint32_t fading = 0; fading < 2; fading++) {
    harness_memory memory;
    scene s = begin(&memory, SIZE_MAX, DETAIL_FINE);
    scene_ticks(&s, 40);
    sbr_character_set_detail_level(s.world, s.character, DETAIL_COARSE);
    if (fading) scene_ticks(&s, 6);
    size_t size = sbr_world_get_snapshot_size(s.world);
    unsigned char *kept = malloc(size), *other = malloc(size);
    ck_assert_int_eq(sbr_world_save_snapshot(s.world, kept, size), SBF_OK);
    uint64_t then = sbr_world_get_state_hash(s.world);
    scene_ticks(&s, 2 * KEPT);
    uint64_t end = sbr_world_get_state_hash(s.world);
    sbr_character_set_detail_level(s.world, s.character, DETAIL_BONES);
    scene_ticks(&s, 2 * KEPT);
    ck_assert_uint_eq(sbr_world_get_snapshot_size(s.world), size);
    ck_assert_int_eq(sbr_world_save_snapshot(s.world, other, size), SBF_OK);
    uint64_t bones = sbr_world_get_state_hash(s.world);
    memory.allowed = memory.calls;
    ck_assert_int_eq(sbr_world_restore_snapshot(s.world, kept, size), SBF_FAILED);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), bones);
    memory.allowed = SIZE_MAX;
    ck_assert_int_eq(sbr_world_restore_snapshot(s.world, kept, size), SBF_OK);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), then);
    scene_ticks(&s, 2 * KEPT);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), end);
    ck_assert_int_eq(sbr_world_restore_snapshot(s.world, other, size), SBF_OK);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), bones);
    for (size_t cut = 0; cut < size; cut += 1 + size / 97) /* damaged ones are refused or restored, no more */
      other[cut] ^= 0x55;
    (void)sbr_world_restore_snapshot(s.world, other, size);
    free(kept);
    free(other);
    scene_free(&s);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

/* What rigid parts are solved in is there while some are simulated. */
START_TEST(rigid_parts_stand_still_without_memory)
{
  harness_memory memory;
  scene s = person();
  harness_memory_init(&memory, SIZE_MAX);
  s.world_definition.allocator = &memory.allocator;
  scene_start(&s);
  size_t pinned = memory.held_bytes;
  memory.allowed = memory.calls;
  uint32_t refused = 0;
  for (int i = 0; i < 45; i++) {
    scene_ticks(&s, 1);
    refused += refusals(&s, SBR_MEMORY_RIGID_BODIES);
  }
  ck_assert_uint_eq(refused, 2);
  ck_assert(person_fastest(&s) == 0);
  ck_assert_uint_eq(memory.held_bytes, pinned);
  memory.allowed = SIZE_MAX;
  event_log log = {.memory_count = 0};
  scene_ticks_logged(&s, 45, &log);
  ck_assert_uint_eq(log.memory_count, 0);
  ck_assert(person_fastest(&s) > 0.01f);
  size_t more = memory.held_bytes, calls = memory.calls;
  ck_assert_uint_gt(more, pinned);
  sbr_character_set_rigid_mode(s.world, s.character, -1, SBR_RIGID_KINEMATIC);
  scene_ticks(&s, KEPT / 2);
  sbr_character_set_rigid_mode(s.world, s.character, -1, SBR_RIGID_PASSIVE);
  scene_ticks(&s, 10);
  ck_assert_uint_eq(memory.calls, calls);
  sbr_character_set_rigid_mode(s.world, s.character, -1, SBR_RIGID_KINEMATIC);
  scene_ticks(&s, KEPT);
  ck_assert_uint_eq(memory.held_bytes, pinned);
  scene_free(&s);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

int main(void) {
  Suite *s = suite_create("rooms");
  TCase *c = tcase_create("rooms");
  tcase_add_test(c, a_character_stores_only_its_detail_level);
  tcase_add_test(c, ticks_allocate_only_at_a_change);
  tcase_add_loop_test(c, a_failed_allocation_keeps_the_detail_level_and_is_reported, 0, 2);
  tcase_add_test(c, a_distant_crowd_needs_a_fraction_of_the_memory);
  tcase_add_test(c, changes_survive_every_failed_allocation);
  tcase_add_test(c, threads_change_nothing);
  tcase_add_test(c, snapshots_restore_any_detail_level);
  tcase_add_test(c, rigid_parts_stand_still_without_memory);
  suite_add_tcase(s, c);
  return harness_run(s);
}
