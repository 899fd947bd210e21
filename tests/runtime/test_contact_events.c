/* Contact events: which bodies, where, how hard, how fast; their order, their end, and what a step keeps. */
#include <math.h>
#include <string.h>

#include "collision_scenes.h"
#include "contact_scenes.h"
#include "event_log.h"
#include "harness.h"
#include "host_threads.h"

static event_log logs[2];

static event_log *empty_log(int index) {
  logs[index] = (event_log){.begin_count = 0};
  return &logs[index];
}

static void check_rigid(const sbr_object *object, sbr_character_id character, int32_t rigid_body) {
  ck_assert_uint_eq(object->character.value, character.value);
  ck_assert_int_eq(object->rigid_body, rigid_body);
  ck_assert_int_eq(object->soft_body, -1);
  ck_assert_uint_eq(object->collider.value, 0);
}

/* A box of 1 kg at 2 m/s against one at rest: 1 kg (1 + e) N s, after which they separate. */
START_TEST(two_bodies_begin_hit_and_end)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  for (uint32_t i = 0; i < 2; i++) {
    rigid_box(&s, (sbf_vec3){0, 0, (float)i}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
    rigid_body(&s, i)->restitution = 0.5f;
  }
  contact_scene_start(&s);
  contact_scene_throw(&s, s.character, 0, (sbf_vec3){0, 0, 2});
  event_log *log = empty_log(0);
  scene_ticks_logged(&s, 60, log);
  ck_assert_uint_eq(log->begin_count, 1);
  ck_assert_uint_eq(log->hit_count, 1);
  ck_assert_uint_eq(log->end_count, 1);
  const sbr_contact_event *all[3] = {&log->begin[0], &log->hit[0], &log->end[0]};
  for (int i = 0; i < 3; i++) {
    check_rigid(&all[i]->a, s.character, 0);
    check_rigid(&all[i]->b, s.character, 1);
    ck_assert_float_le(all[i]->normal.z, -0.999f); /* from b towards a */
  }
  for (int i = 0; i < 2; i++) {
    ck_assert_float_eq_tol(all[i]->impulse, 1.5f, 0.02f);
    ck_assert_float_eq_tol(all[i]->speed, 2, 1e-3f);
    ck_assert_uint_ge(all[i]->tick, 24); /* 0.8 m at 2 m/s */
    ck_assert_uint_le(all[i]->tick, 25);
  }
  sbr_double3 o = sbr_character_get_origin(s.world, s.character);
  ck_assert_double_eq_tol(all[0]->position.z - o.z, 0.9, 0.02);
  ck_assert_double_le(fabs(all[0]->position.x - o.x), 0.101);
  ck_assert_uint_eq(all[2]->tick, all[0]->tick + 1);
  ck_assert(all[2]->impulse == 0 && all[2]->speed == 0);
  scene_free(&s);
}
END_TEST

/* Only a contact faster than the threshold is a hit. */
START_TEST(slow_contacts_are_no_hits)
{
  static const float thresholds[3] = {0, 1.9f, 2.1f};
  for (int i = 0; i < 3; i++) {
    scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
    s.world_definition.hit_speed = thresholds[i];
    for (uint32_t b = 0; b < 2; b++)
      rigid_box(&s, (sbf_vec3){0, 0, (float)b}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
    contact_scene_start(&s);
    contact_scene_throw(&s, s.character, 0, (sbf_vec3){0, 0, 2});
    event_log *log = empty_log(0);
    scene_ticks_logged(&s, 60, log);
    ck_assert_uint_eq(log->begin_count, 1);
    ck_assert_int_eq(log->hit_count > 0, i < 2);
    scene_free(&s);
  }
}
END_TEST

/* A box, a sheet of springs or a lattice falls 0.2 m onto the ground or a collider: sqrt(2 g h). */
typedef enum falling { FALLING_RIGID, FALLING_SPRINGS, FALLING_LATTICE } falling;

static event_log *fall(falling what, bool onto_collider, float scale) {
  scene s = contact_scene_begin((sbf_vec3){0, -9.81f, 0});
  s.world_definition.ground = sbr_ground_flat(onto_collider ? -10 : 0);
  s.character_definition.position.y = onto_collider ? 10 : 0;
  s.character_definition.scale = scale;
  if (what == FALLING_RIGID) {
    rigid_box(&s, (sbf_vec3){0, 0.3f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
    rigid_body(&s, 0)->restitution = 0.5f;
  } else {
    scene_bodies(&s, 1);
  }
  if (what == FALLING_SPRINGS) collision_sheet(&s, 0, (sbf_vec3){0, 0.2f, 0}, 0.6f, 4, false);
  if (what == FALLING_LATTICE) {
    lattice_box box = lattice_box_make(
        (sbf_vec3){-0.1f, 0.2f, -0.1f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2, 2, 2, 1000, 3e5f, 0.4f);
    scene_lattice(&s, 0, &box);
    lattice_box_free(&box);
  }
  scene_start(&s);
  sbr_shape *shape = onto_collider ? collision_shape(collision_box(2, 0.5f, 2)) : NULL;
  sbr_collider_id id = {0};
  if (shape) id = collision_collider(&s, shape, (sbr_double3){0, -0.5, 0});
  event_log *log = empty_log(0);
  scene_ticks_logged(&s, 40, log);
  ck_assert_uint_ge(log->begin_count, 1);
  ck_assert_uint_eq(log->begin[0].b.collider.value, id.value);
  ck_assert_uint_eq(log->begin[0].b.character.value, 0);
  ck_assert_uint_eq(log->begin[0].a.character.value, s.character.value);
  ck_assert_int_eq(log->begin[0].a.rigid_body, what == FALLING_RIGID ? 0 : -1);
  ck_assert_int_eq(log->begin[0].a.soft_body, what == FALLING_RIGID ? -1 : 0);
  scene_free(&s);
  sbr_shape_destroy(shape);
  return log;
}

START_TEST(a_fall_hits_ground_and_colliders_at_its_speed)
{
  const float scale = _i >= 6 ? 4 : 1;
  const event_log *log = fall((falling)(_i % 3), _i / 3 % 2, scale);
  const float expected = sqrtf(2 * 9.81f * 0.2f * scale);
  ck_assert_uint_ge(log->hit_count, 1);
  ck_assert_uint_eq(log->hit[0].tick, log->begin[0].tick);
  ck_assert_float_ge(log->hit[0].normal.y, 0.99f);
  ck_assert_float_eq_tol(log->hit[0].speed, expected, 0.17f * scale); /* g dt */
  ck_assert_double_eq_tol(log->hit[0].position.y, 0, 0.02 * (double)scale);
  if (_i % 3 == FALLING_RIGID) { /* it bounces off */
    ck_assert_uint_ge(log->end_count, 1);
    ck_assert_uint_gt(log->end[0].tick, log->begin[0].tick);
    ck_assert_uint_eq(log->end[0].b.collider.value, log->begin[0].b.collider.value);
  }
}
END_TEST

/* A tower comes to rest and falls asleep: each pair begins once, and none ends. */
START_TEST(resting_contacts_are_reported_once)
{
  enum { BOXES = 4 };
  scene s = contact_scene_begin((sbf_vec3){0, -9.81f, 0});
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.sleep_after_s = 0.5;
  s.character_definition.position.y = 0;
  for (int i = 0; i < BOXES; i++)
    rigid_box(
        &s, (sbf_vec3){0, 0.1f + 0.2005f * (float)i, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1 + (float)(i % 2));
  contact_scene_start(&s);
  event_log *log = empty_log(0);
  scene_ticks_logged(&s, 60, log);
  uint32_t pairs = 0;
  for (uint32_t i = 0; i < log->begin_count; i++) {
    if (!log->begin[i].b.character.value) continue;
    ck_assert_int_eq(log->begin[i].b.rigid_body, log->begin[i].a.rigid_body + 1);
    pairs++;
  }
  ck_assert_uint_eq(pairs, BOXES - 1);
  log = empty_log(0);
  scene_ticks_logged(&s, 240, log);
  ck_assert_uint_eq(log->begin_count, 0);
  ck_assert_uint_eq(log->end_count, 0);
  contact_scene_throw(&s, s.character, BOXES - 1, (sbf_vec3){0, 8, 0}); /* up, off the others */
  scene_ticks_logged(&s, 6, log);
  ck_assert_uint_eq(log->end_count, 1);
  ck_assert_int_eq(log->end[0].a.rigid_body, BOXES - 2);
  ck_assert_int_eq(log->end[0].b.rigid_body, BOXES - 1);
  scene_free(&s);
}
END_TEST

/* The box of one character falls onto the sheet of another, and is destroyed meanwhile. */
START_TEST(soft_bodies_of_others_are_named)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  scene_bodies(&s, 1);
  collision_sheet(&s, 0, (sbf_vec3){0, 0.5f, 0}, 0.6f, 8, false);
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  contact_scene_start(&s);
  sbr_double3 above = s.character_definition.position;
  above.y += 0.7; /* its box, 0.2 m above the sheet of the first */
  sbr_character_id other = contact_scene_another(&s, above);
  contact_scene_throw(&s, other, 0, (sbf_vec3){0, -2, 0});
  event_log *log = empty_log(0);
  scene_ticks_logged(&s, 8, log);
  ck_assert_uint_eq(log->begin_count, 1);
  const sbr_contact_event *begin = &log->begin[0];
  ck_assert_uint_eq(begin->a.character.value, s.character.value);
  ck_assert_int_eq(begin->a.soft_body, 0);
  ck_assert_int_eq(begin->a.rigid_body, -1);
  check_rigid(&begin->b, other, 0);
  ck_assert_float_le(begin->normal.y, -0.9f);
  ck_assert_float_gt(begin->impulse, 0);
  sbr_character_destroy(s.world, other);
  scene_ticks_logged(&s, 4, log);
  ck_assert_uint_eq(log->end_count, 0);
  scene_free(&s);
}
END_TEST

/* Three heaps of two characters each. */
static scene heaps(int *threads) {
  scene s = contact_scene_begin((sbf_vec3){0, -9.81f, 0});
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.tasks = (sbr_tasks){.run = run_on_threads, .user = threads};
  s.character_definition.position.y = 0;
  for (int i = 0; i < 3; i++)
    rigid_box(&s, (sbf_vec3){0.05f * (float)i, 0.15f + 0.25f * (float)i, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  return s;
}

static void add_heaps(scene *s) {
  for (int i = 1; i < 6; i++) {
    sbr_character_definition d = s->character_definition;
    sbr_character_id id;
    d.position.x = i % 3 * 2.0 + i / 3 * 0.12, d.position.y = i / 3 * 0.8;
    ck_assert(sbr_character_create(s->world, s->model, &d, &id, NULL) == SBF_OK);
  }
}

static void log_heaps(int threads, event_log *log) {
  scene s = heaps(&threads);
  contact_scene_start(&s);
  add_heaps(&s);
  scene_ticks_logged(&s, 120, log);
  scene_free(&s);
}

static bool is_same_object(const sbr_object *a, const sbr_object *b) {
  return a->character.value == b->character.value && a->soft_body == b->soft_body &&
         a->rigid_body == b->rigid_body && a->collider.value == b->collider.value;
}

static bool is_same(const sbr_contact_event *a, const sbr_contact_event *b) {
  return a->tick == b->tick && is_same_object(&a->a, &b->a) && is_same_object(&a->b, &b->b) &&
         !memcmp(&a->position, &b->position, sizeof a->position) &&
         !memcmp(&a->normal, &b->normal, sizeof a->normal) &&
         !memcmp(&a->impulse, &b->impulse, sizeof a->impulse) &&
         !memcmp(&a->speed, &b->speed, sizeof a->speed);
}

START_TEST(any_number_of_threads_reports_the_same)
{
  const event_log *one = empty_log(0);
  log_heaps(1, &logs[0]);
  ck_assert_uint_ge(one->begin_count, 18);
  ck_assert_uint_ge(one->hit_count, 6);
  for (int threads = 3; threads <= 8; threads += 5) {
    event_log *more = empty_log(1);
    log_heaps(threads, more);
    ck_assert_uint_eq(more->begin_count, one->begin_count);
    ck_assert_uint_eq(more->end_count, one->end_count);
    ck_assert_uint_eq(more->hit_count, one->hit_count);
    for (uint32_t i = 0; i < one->begin_count; i++) ck_assert(is_same(&one->begin[i], &more->begin[i]));
    for (uint32_t i = 0; i < one->end_count; i++) ck_assert(is_same(&one->end[i], &more->end[i]));
    for (uint32_t i = 0; i < one->hit_count; i++) ck_assert(is_same(&one->hit[i], &more->hit[i]));
  }
}
END_TEST

/* A step holds the events of all its ticks, and no others. */
START_TEST(a_step_replaces_the_events_of_the_one_before)
{
  int threads = 1;
  scene ticks = heaps(&threads), steps = heaps(&threads);
  contact_scene_start(&ticks), add_heaps(&ticks);
  contact_scene_start(&steps), add_heaps(&steps);
  uint32_t by_ticks = 0, by_steps = 0;
  for (int i = 0; i < 30; i++) {
    for (int k = 0; k < 4; k++) {
      sbr_world_tick(ticks.world);
      by_ticks += sbr_world_get_contact_events(ticks.world).begin_count;
    }
    sbr_world_step(steps.world, 4.0 / 60);
    sbr_contact_events events = sbr_world_get_contact_events(steps.world);
    by_steps += events.begin_count;
    for (uint32_t e = 1; e < events.begin_count; e++)
      ck_assert_uint_ge(events.begin[e].tick, events.begin[e - 1].tick);
    ck_assert_uint_eq(by_steps, by_ticks);
    if (i % 2) sbr_world_step(steps.world, 0);
    if (i % 2) ck_assert_uint_eq(sbr_world_get_contact_events(steps.world).begin_count, 0);
  }
  ck_assert_uint_ge(by_ticks, 18);
  scene_free(&ticks);
  scene_free(&steps);
}
END_TEST

START_TEST(events_beyond_the_capacity_are_counted)
{
  int threads = 1;
  scene s = heaps(&threads);
  s.world_definition.event_capacity = 2;
  s.world_definition.hit_speed = 1000;
  s.world_definition.longest_frame_s = 10;
  contact_scene_start(&s), add_heaps(&s);
  sbr_world_step(s.world, 2);
  sbr_contact_events events = sbr_world_get_contact_events(s.world);
  ck_assert_uint_eq(events.begin_count, 2);
  ck_assert_uint_ge(sbr_world_count_lost_events(s.world), 16);
  sbr_world_tick(s.world);
  ck_assert_uint_le(sbr_world_count_lost_events(s.world), 20);
  scene_free(&s);
  ck_assert_uint_eq(sbr_world_get_contact_events(NULL).begin_count, 0);
  ck_assert_uint_eq(sbr_world_count_lost_events(NULL), 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("contact_events");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, two_bodies_begin_hit_and_end);
  tcase_add_test(tests, slow_contacts_are_no_hits);
  tcase_add_loop_test(tests, a_fall_hits_ground_and_colliders_at_its_speed, 0, 12);
  tcase_add_test(tests, resting_contacts_are_reported_once);
  tcase_add_test(tests, soft_bodies_of_others_are_named);
  tcase_add_test(tests, any_number_of_threads_reports_the_same);
  tcase_add_test(tests, a_step_replaces_the_events_of_the_one_before);
  tcase_add_test(tests, events_beyond_the_capacity_are_counted);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
