#include <math.h>
#include <string.h>

#include "harness.h"
#include "host_threads.h"
#include "scenes.h"
#include "state/world.h"

static const sbf_scheme schemes[] = {SBF_SCHEME_AUTOMATIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN,
    SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_RELAXATION};
enum { SCHEME_COUNT = 5 };

static scene crowd(sbr_tasks tasks, sbf_scheme scheme) {
  scene s = scene_begin();
  scene_bodies(&s, 3);
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  for (uint32_t i = 0; i < 3; i++) {
    scene_body(&s, i)->attributes.damping_ratio = 0.15f;
    scene_body(&s, i)->attributes.pressure_mode = i ? SBF_PRESSURE_MODE_VOLUME : SBF_PRESSURE_MODE_NONE;
    scene_section(&s, i, (sbf_vec3){0, 0.1f, 0.5f * (float)i}, (sbf_vec3){0.3f, 0.22f, 0.4f}, 2 + i);
  }
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_noise(0.1, 5);
  s.world_definition.tasks = tasks;
  s.model_options.scheme = scheme;
  scene_start(&s);
  for (int i = 0; i < 3; i++) {
    sbr_character_id id;
    s.character_definition.position.x += 1.5;
    s.character_definition.scale = 1 + (float)i;
    ck_assert_int_eq(sbr_character_create(s.world, s.model, &s.character_definition, &id, NULL), SBF_OK);
    sbr_character_set_drive(s.world, id, 0.5f, 0.1f * (float)i, 0.3f);
  }
  return s;
}

START_TEST(any_number_of_threads_gives_the_same_bits)
{
  scene serial = crowd((sbr_tasks){NULL, NULL}, schemes[_i]);
  scene_ticks(&serial, 90);
  uint64_t expected = sbr_world_get_state_hash(serial.world);
  scene_free(&serial);
  for (int threads = 1; threads <= 8; threads = threads == 3 ? 8 : threads + 1) {
    scene s = crowd((sbr_tasks){run_on_threads, &threads}, schemes[_i]);
    scene_ticks(&s, 90);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), expected);
    scene_free(&s);
  }
}
END_TEST

/* ---- Bodies that recover ---- */

static scene walker(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  scene_body(&s, 0)->attributes.damping_ratio = 0.15f;
  scene_section(&s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){0.3f, 0.2f, 0.5f}, 3);
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  return s;
}

START_TEST(invalid_numbers_are_recovered_from)
{
  scene s = walker();
  scene_ticks(&s, 10);
  sbri_positions(sbri_character_of(s.world, s.character))[3].y = NAN;
  scene_ticks(&s, 1);
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(h.finite);
  ck_assert_uint_eq(h.recoveries, 1);
  ck_assert_float_eq_tol(h.volume_ratio, 1, 0.01f);
  scene_ticks(&s, 60);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).recoveries, 1);
  scene_free(&s);
}
END_TEST

START_TEST(an_inverted_body_recovers)
{
  scene s = scene_begin(); /* no pins: its springs are also at rest when inverted */
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){0.3f, 0.2f, 0.5f}, 2);
  s.model_options.free = true;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  for (uint32_t i = 0; i < c->model->slot_count; i++) sbri_positions(c)[i].x *= -1;
  scene_ticks(&s, 1);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).inverted);
  scene_ticks(&s, 80);
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_uint_eq(h.recoveries, 1);
  ck_assert_float_eq_tol(h.volume_ratio, 1, 0.01f);
  scene_free(&s);
}
END_TEST

START_TEST(bodies_follow_bones_that_jump)
{
  scene s = walker();
  scene_ticks(&s, 10);
  sbr_character_set_drive(s.world, s.character, 3000, 0, 0); /* soon metres a tick */
  for (int i = 0; i < 30; i++) {
    scene_ticks(&s, 1);
    sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(h.finite);
    ck_assert_float_lt(h.max_strain, 2);
  }
  sbr_character_set_drive(s.world, s.character, 0, 0, 0);
  scene_ticks(&s, 240);
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_float_eq_tol(h.volume_ratio, 1, 0.05f);
  ck_assert_uint_eq(h.recoveries, 0);
  scene_free(&s);
}
END_TEST

START_TEST(a_frame_of_a_quarter_second_is_survived)
{
  scene s = walker();
  sbr_character_set_drive(s.world, s.character, 1.5f, 0, 2);
  for (int i = 0; i < 40; i++) {
    sbr_world_step(s.world, i % 3 ? 0.25 : 0.001);
    sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(h.finite && !h.inverted);
    ck_assert_float_gt(h.volume_ratio, 0.9f);
  }
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("step");
  TCase *c = tcase_create("step");
  tcase_add_loop_test(c, any_number_of_threads_gives_the_same_bits, 0, SCHEME_COUNT);
  tcase_add_test(c, invalid_numbers_are_recovered_from);
  tcase_add_test(c, an_inverted_body_recovers);
  tcase_add_test(c, bodies_follow_bones_that_jump);
  tcase_add_test(c, a_frame_of_a_quarter_second_is_survived);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
