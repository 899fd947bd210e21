/* Events of bodies that meet each other: who, where, how hard; and that they part. */
#include <math.h>
#include <string.h>

#include "collision_scenes.h"
#include "contact_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "world/world.h"

enum { MAX = 256 };

/* Those of the kind. */
static uint32_t events_of(scene *s, sbr_event_kind kind, sbr_event *to) {
  static sbr_event all[MAX];
  uint32_t count = sbr_world_take_events(s->world, all, MAX), kept = 0;
  for (uint32_t i = 0; i < count; i++)
    if (all[i].kind == kind) to[kept++] = all[i];
  return kept;
}

/* A box of 1 kg at 2 m/s against one that rests: 1 kg (1 + e) N s, and they part. */
START_TEST(a_hit_says_who_where_and_how_hard)
{
  scene s = meeting_begin((sbf_vec3){0, 0, 0});
  for (uint32_t i = 0; i < 2; i++) {
    rigid_box(&s, (sbf_vec3){0, 0, (float)i}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
    rigid_body(&s, i)->restitution = 0.5f;
  }
  meeting_start(&s);
  meeting_throw(&s, s.character, 0, (sbf_vec3){0, 0, 2});
  static sbr_event all[MAX];
  scene_ticks(&s, 60);
  uint32_t count = sbr_world_take_events(s.world, all, MAX);
  ck_assert_uint_eq(count, 2);
  const sbr_event *hit = &all[0], *parted = &all[1];
  ck_assert_int_eq(hit->kind, SBR_EVENT_CONTACT_BEGIN);
  ck_assert_int_eq(parted->kind, SBR_EVENT_CONTACT_END);
  for (int i = 0; i < 2; i++) {
    ck_assert_uint_eq(all[i].character.value, s.character.value);
    ck_assert_uint_eq(all[i].other.value, s.character.value);
    ck_assert_int_eq(all[i].rigid_body, 0);
    ck_assert_int_eq(all[i].other_rigid_body, 1);
    ck_assert_uint_eq(all[i].collider.value, 0);
    ck_assert_float_le(all[i].normal.z, -0.999f); /* away from the second */
  }
  ck_assert_float_eq_tol(hit->impulse, 1.5f, 0.02f);
  ck_assert_float_eq_tol(hit->speed, 2, 1e-3f);
  sbr_double3 o = sbr_character_get_origin(s.world, s.character);
  ck_assert_double_eq_tol(hit->position.z - o.z, 0.9, 0.02);
  ck_assert_double_le(fabs(hit->position.x - o.x), 0.101);
  ck_assert_uint_ge(hit->tick, 24); /* 0.8 m at 2 m/s */
  ck_assert_uint_le(hit->tick, 25);
  ck_assert_uint_eq(parted->tick, hit->tick + 1);
  scene_free(&s);
}
END_TEST

/* A tower that settles, lies, falls asleep: each pair begins once, and none parts. */
START_TEST(what_rests_is_told_once)
{
  enum { BOXES = 4 };
  scene s = meeting_begin((sbf_vec3){0, -9.81f, 0});
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.sleep_after_s = 0.5;
  s.character_definition.position.y = 0;
  for (int i = 0; i < BOXES; i++)
    rigid_box(
        &s, (sbf_vec3){0, 0.1f + 0.2005f * (float)i, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1 + (float)(i % 2));
  meeting_start(&s);
  static sbr_event all[MAX];
  scene_ticks(&s, 60);
  uint32_t hits = 0, count = events_of(&s, SBR_EVENT_CONTACT_BEGIN, all);
  for (uint32_t i = 0; i < count; i++) {
    if (!all[i].other.value) continue;
    ck_assert_int_eq(all[i].other_rigid_body, all[i].rigid_body + 1);
    hits++;
  }
  ck_assert_uint_eq(hits, BOXES - 1);
  scene_ticks(&s, 240);
  ck_assert_uint_eq(events_of(&s, SBR_EVENT_CONTACT_BEGIN, all), 0);
  meeting_throw(&s, s.character, BOXES - 1, (sbf_vec3){0, 8, 0}); /* up, off the others */
  scene_ticks(&s, 6);
  ck_assert_uint_eq(events_of(&s, SBR_EVENT_CONTACT_END, all), 1);
  ck_assert_int_eq(all[0].rigid_body, BOXES - 2);
  ck_assert_int_eq(all[0].other_rigid_body, BOXES - 1);
  scene_free(&s);
}
END_TEST

/* A sheet of each of two characters, one falling onto the other's box; the one goes away meanwhile. */
START_TEST(soft_bodies_of_others_are_named)
{
  scene s = meeting_begin((sbf_vec3){0, 0, 0});
  scene_bodies(&s, 1);
  collision_sheet(&s, 0, (sbf_vec3){0, 0.5f, 0}, 0.6f, 8, false);
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  meeting_start(&s);
  sbr_double3 above = s.character_definition.position;
  above.y += 0.7; /* its box, 0.2 m above the sheet of the first */
  sbr_character_id other = meeting_another(&s, above);
  meeting_throw(&s, other, 0, (sbf_vec3){0, -2, 0});
  static sbr_event all[MAX];
  scene_ticks(&s, 8);
  ck_assert_uint_eq(events_of(&s, SBR_EVENT_CONTACT_BEGIN, all), 1);
  ck_assert_uint_eq(all[0].character.value, s.character.value);
  ck_assert_uint_eq(all[0].soft_body, 0);
  ck_assert_int_eq(all[0].rigid_body, -1);
  ck_assert_uint_eq(all[0].other.value, other.value);
  ck_assert_int_eq(all[0].other_rigid_body, 0);
  ck_assert_float_le(all[0].normal.y, -0.9f);
  ck_assert_float_gt(all[0].impulse, 0);
  sbr_character_destroy(s.world, other);
  scene_ticks(&s, 4);
  ck_assert_uint_eq(events_of(&s, SBR_EVENT_CONTACT_END, all), 0);
  scene_free(&s);
}
END_TEST

/* Three heaps of two characters each: their events, field by field, on so many threads. */
static uint32_t heap_events(int threads, sbr_event *to) {
  scene s = meeting_begin((sbf_vec3){0, -9.81f, 0});
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.tasks = (sbr_tasks){.run = run_on_threads, .user = &threads};
  s.character_definition.position.y = 0;
  for (int i = 0; i < 3; i++)
    rigid_box(&s, (sbf_vec3){0.05f * (float)i, 0.15f + 0.25f * (float)i, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  meeting_start(&s);
  for (int i = 1; i < 6; i++) {
    sbr_character_definition d = s.character_definition;
    sbr_character_id id;
    d.position.x = i % 3 * 2.0 + i / 3 * 0.12, d.position.y = i / 3 * 0.8;
    ck_assert(sbr_character_create(s.world, s.model, &d, &id, NULL) == SBF_OK);
  }
  scene_ticks(&s, 120);
  uint32_t count = sbr_world_take_events(s.world, to, MAX);
  scene_free(&s);
  return count;
}

static bool same(const sbr_event *a, const sbr_event *b) {
  return a->kind == b->kind && a->character.value == b->character.value && a->tick == b->tick &&
         !memcmp(&a->position, &b->position, sizeof a->position) && a->soft_body == b->soft_body &&
         a->rigid_body == b->rigid_body && !memcmp(&a->normal, &b->normal, sizeof a->normal) &&
         !memcmp(&a->impulse, &b->impulse, sizeof a->impulse) && a->other.value == b->other.value &&
         a->other_soft_body == b->other_soft_body && a->other_rigid_body == b->other_rigid_body &&
         !memcmp(&a->speed, &b->speed, sizeof a->speed);
}

START_TEST(any_number_of_threads_tells_the_same)
{
  static sbr_event one[MAX], more[MAX];
  uint32_t count = heap_events(1, one);
  ck_assert_uint_ge(count, 30);
  for (int threads = 3; threads <= 8; threads += 5) {
    ck_assert_uint_eq(heap_events(threads, more), count);
    for (uint32_t i = 0; i < count; i++) ck_assert(same(&one[i], &more[i]));
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("tell");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_hit_says_who_where_and_how_hard);
  tcase_add_test(tests, what_rests_is_told_once);
  tcase_add_test(tests, soft_bodies_of_others_are_named);
  tcase_add_test(tests, any_number_of_threads_tells_the_same);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
