#include <math.h>

#include "harness.h"
#include "scenes.h"
#include "state/world.h"

START_TEST(energies_of_a_stretched_falling_pair)
{
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {2, 0, 0}};
  const float masses[] = {1, 3}, stiffness = 100, rest = 1.5f;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1);
  ((sbf_spring_set *)(uintptr_t)level->springs.at)->rest_lengths = (sbf_f32_list){&rest, 1};
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(10);
  scene_start(&s);
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_double_eq_tol(h.elastic_j, 0.5 * 100 * 0.25, 1e-9);
  ck_assert_double_eq_tol(h.kinetic_j, 0, 1e-12);
  ck_assert_double_eq_tol(h.potential_j, 4 * 9.81 * 10, 1e-3);
  ck_assert_float_eq_tol(h.max_strain, 0.5f / 1.5f, 1e-6f);
  ck_assert(h.finite && !h.inverted && h.recoveries == 0);
  ck_assert_float_eq(h.volume_ratio, 1);
  scene_free(&s);
}
END_TEST

static scene section(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 2);
  scene_start(&s);
  return s;
}

START_TEST(volume_is_measured_against_rest)
{
  scene s = section();
  ck_assert_float_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 1, 1e-5f);
  sbri_character *c = sbri_character_of(s.world, s.character);
  for (uint32_t i = 0; i < c->model->slot_count; i++) sbri_positions(c)[i].x *= 1.1f;
  ck_assert_float_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 1.1f, 1e-5f);
  for (uint32_t i = 0; i < c->model->slot_count; i++) sbri_positions(c)[i].x *= -1;
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_float_eq_tol(h.volume_ratio, -1.1f, 1e-5f);
  ck_assert(h.inverted);
  sbri_velocities(c)[5] = INFINITY;
  ck_assert(!sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

START_TEST(health_of_missing_characters_is_zero)
{
  scene s = section();
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 3);
  ck_assert(!h.finite && h.volume_ratio == 0);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("health");
  TCase *c = tcase_create("health");
  tcase_add_test(c, energies_of_a_stretched_falling_pair);
  tcase_add_test(c, volume_is_measured_against_rest);
  tcase_add_test(c, health_of_missing_characters_is_zero);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
