#include <math.h>
#include <stdlib.h>

#include "event_log.h"
#include "harness.h"
#include "scenes.h"
#include "state/world.h"

/* A pad that the host may raise under (0, 0), and how often it was asked. */
typedef struct pad {
  double height;
  uint32_t asked;
} pad;
static pad host_pad;

static double pad_height(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  pad *p = (pad *)(uintptr_t)ground->user;
  (void)x;
  (void)z;
  p->asked++;
  *normal = (sbf_vec3){0, 1, 0};
  return p->height;
}

/* A loose box of tetrahedra that falls a little, and a box of springs that a bone holds off the ground. */
static scene make_scene(sbr_ground ground, double sleep_after_s) {
  scene s = scene_begin();
  scene_bodies(&s, 2);
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  lattice_box box =
      lattice_box_make((sbf_vec3){0.6f, 0, -0.1f}, (sbf_vec3){0.3f, 0.2f, 0.2f}, 3, 2, 2, 1000, 4e4f, 0.4f);
  scene_lattice(&s, 0, &box);
  lattice_box_free(&box);
  scene_section(&s, 1, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.3f, 0.2f, 0.4f}, 3);
  for (uint32_t b = 0; b < 2; b++) {
    scene_body(&s, b)->attributes.damping_ratio = 0.3f;
    scene_body(&s, b)->attributes.friction = 0.5f;
    scene_body(&s, b)->attributes.stiffness_damping = 2e-3f;
  }
  s.world_definition.ground = ground;
  s.world_definition.sleep_after_s = sleep_after_s;
  s.character_definition.position.y = 0.05;
  scene_start(&s);
  return s;
}

static double energy(const scene *s) {
  double sum = 0;
  for (uint32_t b = 0; b < 2; b++) {
    sbr_body_health health = sbr_character_get_body_health(s->world, s->character, b);
    sum += health.kinetic_j + health.elastic_j + health.potential_j;
  }
  return sum;
}

static void sleep_all(scene *s) {
  for (int i = 0; i < 1200 && (i == 0 || sbr_world_count_awake_bodies(s->world) > 0); i++) scene_ticks(s, 1);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s->world), 0);
}

/* Stored state of a sleeping body, from which it continues after waking. */
static void expect_no_velocity(const scene *s) {
  sbri_character *c = sbri_character_of(s->world, s->character);
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    const sbri_island *island = &c->model->islands[i];
    const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
    for (uint32_t k = 0; k < 3 * island->free_count; k++) ck_assert_float_eq(velocities[k], 0);
  }
}

START_TEST(resting_bodies_fall_asleep_without_a_jump_of_energy)
{
  scene s = make_scene(sbr_ground_flat(0), 0.5), twin = make_scene(sbr_ground_flat(0), 0);
  double before = 0;
  uint32_t ticks = 0, awake = 2;
  static event_log log;
  for (; ticks < 1200 && awake; ticks++) {
    before = energy(&s);
    scene_ticks_logged(&s, 1, &log);
    scene_ticks(&twin, 1);
    awake = sbr_world_count_awake_bodies(s.world);
  }
  ck_assert_uint_lt(ticks, 1200);
  ck_assert_uint_gt(ticks, 30);
  ck_assert_uint_eq(log.asleep_count, 2);
  double slow = 0.5 * 15 * pow(0.01 * 0.6, 2); /* energy of bodies of 12 and 3 kg at the sleep speed */
  ck_assert_double_le(energy(&s), before + 1e-6);
  ck_assert_double_ge(energy(&s), before - slow);
  double asleep = energy(&s);
  expect_no_velocity(&s);
  sbf_vec3 point = scene_point(&s, 0, 3);
  scene_ticks(&s, 300);
  ck_assert_double_eq(energy(&s), asleep);
  ck_assert_float_eq(scene_point(&s, 0, 3).y, point.y);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).asleep);
  /* After waking it is where it was, and moves like one that never slept. */
  sbr_character_wake(s.world, s.character);
  scene_ticks(&s, 1);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 2);
  ck_assert_uint_eq(sbr_world_get_sleep_events(s.world).awake_count, 2);
  ck_assert_double_le(energy(&s), asleep + 1e-4);
  scene_ticks(&twin, 300);
  for (uint32_t p = 0; p < 10; p++) {
    sbf_vec3 a = scene_point(&s, 0, p), b = scene_point(&twin, 0, p);
    ck_assert_float_eq_tol(a.y, b.y, 1e-3f);
    ck_assert_float_eq_tol(a.x, b.x, 3e-3f);
  }
  scene_free(&s);
  scene_free(&twin);
}
END_TEST

START_TEST(nothing_sleeps_while_sleep_is_disabled)
{
  scene s = make_scene(sbr_ground_flat(0), 0);
  scene_ticks(&s, 600);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 2);
  scene_free(&s);
}
END_TEST

static void drive(scene *s) {
  sbr_character_set_drive(s->world, s->character, 0.5f, 0, 0);
}
static void turn_bone(scene *s) { /* as a clip or a hand would */
  sbr_character_set_drive(s->world, s->character, 0, 0, 1);
}
static void teleport(scene *s) {
  sbr_character_teleport(s->world, s->character, (sbr_double3){3, 0, 2}, 1);
}
static void raise_ground(scene *s) {
  (void)s;
  host_pad.height = 0.02;
}
static void lower_ground(scene *s) {
  (void)s;
  host_pad.height = -0.02;
}
static void call_host(scene *s) {
  sbr_character_wake(s->world, s->character);
}
static void reset(scene *s) {
  sbr_character_reset(s->world, s->character);
}

START_TEST(moving_a_sleeping_body_wakes_it)
{
  static const struct {
    void (*act)(scene *);
    uint32_t awake; /* with or without the loose body */
  } causes[] = {{drive, 1}, {turn_bone, 1}, {teleport, 2}, {raise_ground, 1}, {lower_ground, 1},
      {call_host, 2}, {reset, 2}};
  host_pad = (pad){0, 0};
  scene s = make_scene((sbr_ground){pad_height, &host_pad, {0}}, 0.5);
  sleep_all(&s);
  scene_ticks(&s, 20);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 0);
  float before = scene_point(&s, 0, 3).y;
  uint32_t max = 0;
  causes[_i].act(&s);
  for (int i = 0; i < 6; i++) {
    scene_ticks(&s, 1);
    max = sbr_world_count_awake_bodies(s.world) > max ? sbr_world_count_awake_bodies(s.world) : max;
  }
  ck_assert_uint_ge(max, causes[_i].awake);
  scene_ticks(&s, 300);
  float moved = scene_point(&s, 0, 3).y - before;
  if (causes[_i].act == raise_ground) ck_assert_float_eq_tol(moved, 0.02f, 0.003f);
  if (causes[_i].act == lower_ground) ck_assert_float_eq_tol(moved, -0.02f, 0.003f);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 1).finite);
  scene_free(&s);
}
END_TEST

/* Number of tasks of bodies, and of calls of the ground. */
static uint32_t handed_out;
static void count_tasks(void *user, sbr_task *task, void *context, uint32_t count) {
  (void)user;
  handed_out += count;
  for (uint32_t i = count; i-- > 0;) task(context, i);
}

START_TEST(a_sleeping_character_costs_no_work)
{
  host_pad = (pad){0, 0};
  scene s = make_scene((sbr_ground){pad_height, &host_pad, {0}}, 0.5);
  sleep_all(&s);
  scene_ticks(&s, 10);
  s.world->tasks = (sbr_tasks){count_tasks, NULL};
  ck_assert_uint_eq(sbri_character_of(s.world, s.character)->model->island_count, 2);
  uint32_t looked = 0;
  for (int i = 0; i < 12; i++) {
    handed_out = host_pad.asked = 0;
    scene_ticks(&s, 1);
    uint32_t of_characters = s.world->character_capacity;
    looked += handed_out > of_characters || host_pad.asked > 0;
  }
  ck_assert_uint_eq(looked, 3); /* every fourth tick it checks what the host may have changed */
  /* Over a ground that cannot change it checks nothing. */
  s.world->ground = sbr_ground_flat(0);
  scene_ticks(&s, 8);
  handed_out = host_pad.asked = 0;
  scene_ticks(&s, 60);
  ck_assert_uint_eq(handed_out, 60 * s.world->character_capacity);
  scene_free(&s);
}
END_TEST

START_TEST(threads_and_snapshots_agree_about_sleep)
{
  scene s = make_scene(sbr_ground_flat(0), 0.5), other = make_scene(sbr_ground_flat(0), 0.5);
  other.world->tasks = (sbr_tasks){count_tasks, NULL}; /* which runs tasks in reverse order */
  size_t size = sbr_world_get_snapshot_size(s.world);
  void *bytes = malloc(size);
  for (int i = 0; i < 400; i++) {
    if (i == 50) ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
    scene_ticks(&s, 1);
    scene_ticks(&other, 1);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), sbr_world_get_state_hash(other.world));
  }
  sleep_all(&s);
  sleep_all(&other);
  uint64_t end = sbr_world_get_state_hash(s.world);
  uint64_t ticks = sbr_world_get_tick_count(s.world);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
  ck_assert_uint_eq(sbr_world_get_tick_count(s.world), 50);
  scene_ticks(&s, (uint32_t)(ticks - 50));
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), end);
  free(bytes);
  scene_free(&s);
  scene_free(&other);
}
END_TEST

int main(void) {
  Suite *s = suite_create("sleep");
  TCase *c = tcase_create("sleep");
  tcase_add_test(c, resting_bodies_fall_asleep_without_a_jump_of_energy);
  tcase_add_test(c, nothing_sleeps_while_sleep_is_disabled);
  tcase_add_loop_test(c, moving_a_sleeping_body_wakes_it, 0, 7);
  tcase_add_test(c, a_sleeping_character_costs_no_work);
  tcase_add_test(c, threads_and_snapshots_agree_about_sleep);
  suite_add_tcase(s, c);
  return harness_run(s);
}
