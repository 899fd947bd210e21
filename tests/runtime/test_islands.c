#include <math.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"
#include "scenes.h"
#include "state/world.h"

/* Two bodies of one point each, joined by a spring of 50 N/m and 1 m; a third one on its own. */
static scene joined(void) {
  scene s = scene_begin();
  scene_bodies(&s, 3);
  const float masses[] = {1, 3, 1};
  for (uint32_t i = 0; i < 3; i++) {
    const sbf_vec3 position = {2 * (float)i, 0, 0};
    scene_points(&s, i, &position, &masses[i], 1);
  }
  static const sbf_uint2 ends[] = {{{0, 0}}};
  static const float stiffness[] = {50}, rest[] = {1};
  sbf_cross_springs *cross = sbf_asset_allocate(s.asset, 1, sizeof *cross);
  sbf_cross_springs_init(cross);
  cross->body_a = 0, cross->body_b = 1;
  cross->ends = (sbf_uint2_list){ends, 1};
  cross->stiffness = (sbf_f32_list){stiffness, 1};
  cross->rest_lengths = (sbf_f32_list){rest, 1};
  s.asset->cross_springs = (sbf_cross_springs_list){cross, 1};
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  return s;
}

START_TEST(springs_between_bodies_act)
{
  scene s = joined();
  s.model_options.substeps = 16;
  scene_start(&s);
  ck_assert_uint_eq(s.model->island_count, 2);
  ck_assert_uint_eq(s.model->bodies[0].island, s.model->bodies[1].island);
  ck_assert_uint_ne(s.model->bodies[0].island, s.model->bodies[2].island);
  scene_ticks(&s, 20);
  /* Two masses about their common centre: w^2 = k (1/1 + 1/3), the stretch begins at 1 m. */
  double w = sqrt(50 * (1 + 1.0 / 3)), stretch = cos(w * 20 / 60);
  double a = scene_point(&s, 0, 0).x, b = scene_point(&s, 1, 0).x;
  ck_assert_double_eq_tol(b - a - 1, stretch, 0.01);
  ck_assert_double_eq_tol((a + 3 * b) / 4, 1.5, 1e-4);
  ck_assert_double_eq_tol(scene_point(&s, 2, 0).x, 4, 1e-6);
  scene_free(&s);
}
END_TEST

START_TEST(springs_between_levels_that_are_not_simulated_do_nothing)
{
  scene s = joined();
  ((sbf_cross_springs *)(uintptr_t)s.asset->cross_springs.at)->level_b = 1;
  scene_start(&s);
  ck_assert_uint_eq(s.model->island_count, 3);
  scene_ticks(&s, 20);
  ck_assert_double_eq_tol(scene_point(&s, 0, 0).x, 0, 1e-6);
  scene_free(&s);
}
END_TEST

/* Loads do not depend on it: the named levels determine the points. */
START_TEST(springs_to_missing_points_are_refused)
{
  for (int end = 0; end < 2; end++) {
    scene s = joined();
    sbf_uint2 ends[] = {{{0, 0}}};
    ends[0].at[end] = 1000000;
    sbf_cross_springs *cross = (sbf_cross_springs *)(uintptr_t)s.asset->cross_springs.at;
    cross->ends.at = ends;
    sbf_diagnostic error;
    ck_assert_int_eq(sbr_model_create(s.asset, &s.model_options, &s.model, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, SBF_CODE_CROSS_SPRING_POINT);
    ck_assert_ptr_nonnull(strstr(error.message, "1000000"));
    cross->level_b = 1; /* levels that are not simulated need not be valid */
    scene_start(&s);
    scene_free(&s);
  }
}
END_TEST

START_TEST(levels_are_chosen)
{
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}};
  const float masses[] = {1, 1};
  scene_points(&s, 0, positions, masses, 2);
  sbf_level *levels = sbf_asset_allocate(s.asset, 2, sizeof *levels);
  levels[0] = s.asset->soft_bodies.at[0].levels.at[0];
  levels[1] = levels[0];
  levels[1].positions.count = levels[1].masses.count = 1;
  scene_body(&s, 0)->levels = (sbf_level_list){levels, 2};
  const uint32_t wanted[] = {0, 1, 7}, counts[] = {2, 1, 1};
  for (int i = 0; i < 3; i++) {
    s.model_options.level = wanted[i];
    scene_start(&s);
    ck_assert_uint_eq(scene_read(&s, 0, NULL, 0), counts[i]);
    sbr_world_destroy(s.world);
    sbr_model_destroy(s.model);
  }
  s.world = NULL, s.model = NULL;
  scene_free(&s);
}
END_TEST

START_TEST(a_level_that_can_be_stepped_is_preferred)
{
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const float masses[] = {1, 1, 1};
  scene_points(&s, 0, positions, masses, 3);
  sbf_level *levels = sbf_asset_allocate(s.asset, 3, sizeof *levels);
  for (uint32_t i = 0; i < 3; i++) {
    levels[i] = s.asset->soft_bodies.at[0].levels.at[0];
    levels[i].positions.count = levels[i].masses.count = 3 - i;
  }
  levels[1].model = SBF_ELASTIC_MODEL_JIGGLE;
  scene_body(&s, 0)->levels = (sbf_level_list){levels, 3};
  s.model_options.level = 1;
  scene_start(&s);
  ck_assert_uint_eq(scene_read(&s, 0, NULL, 0), 1); /* the coarser */
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 1);
  sbr_world_destroy(s.world);
  sbr_model_destroy(s.model);
  levels[2].model = SBF_ELASTIC_MODEL_JIGGLE;
  scene_start(&s);
  ck_assert_uint_eq(scene_read(&s, 0, NULL, 0), 3); /* else the finer */
  scene_free(&s);
}
END_TEST

START_TEST(bodies_that_are_not_simulated_are_refused)
{
  scene s = scene_begin();
  const sbf_vec3 position = {0, 0, 0};
  sbf_level *level = scene_points(&s, 0, &position, NULL, 1);
  level->model = SBF_ELASTIC_MODEL_JIGGLE;
  sbf_diagnostic error;
  ck_assert_int_eq(sbr_model_create(s.asset, NULL, &s.model, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_LEVEL_NOT_SIMULATED);
  ck_assert_ptr_nonnull(strstr(error.message, "jiggle"));
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("islands");
  TCase *c = tcase_create("islands");
  tcase_add_test(c, springs_between_bodies_act);
  tcase_add_test(c, springs_between_levels_that_are_not_simulated_do_nothing);
  tcase_add_test(c, springs_to_missing_points_are_refused);
  tcase_add_test(c, levels_are_chosen);
  tcase_add_test(c, a_level_that_can_be_stepped_is_preferred);
  tcase_add_test(c, bodies_that_are_not_simulated_are_refused);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
