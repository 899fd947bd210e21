#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"
#include "scenes.h"
#include "soft/solvers/scheme.h"
#include "state/world.h"

static scene section(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 2);
  return s;
}

START_TEST(calls_are_checked)
{
  scene s = section();
  sbf_diagnostic error;
  ck_assert_int_eq(sbr_model_create(NULL, NULL, &s.model, &error), SBF_FAILED);
  ck_assert_int_eq(sbr_model_create(s.asset, NULL, NULL, NULL), SBF_FAILED);
  const sbr_model_options zeros = {.level = 0};
  ck_assert_int_eq(sbr_model_create(s.asset, &zeros, &s.model, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "sbr_default_model_options"));
  s.model_options.scheme = (sbf_scheme)SBF_SCHEME_COUNT;
  ck_assert_int_eq(sbr_model_create(s.asset, &s.model_options, &s.model, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "position_based"));
  ck_assert_ptr_null(s.model);
  sbr_model_destroy(NULL);
  ck_assert_uint_eq(sbr_model_get_substeps(NULL), 1);
  ck_assert_uint_eq(sbr_model_get_body_substeps(NULL, 0), 0);
  scene_free(&s);
}
END_TEST

START_TEST(numbers_too_large_to_simulate_are_refused)
{
  static const sbf_vec3 near = {0, 1e6f, 0}, far = {0, -2e6f, 0};
  const float kg = 1;
  sbf_diagnostic error;
  for (int i = 0; i < 3; i++) {
    scene s = scene_begin();
    scene_points(&s, 0, i == 1 ? &far : &near, &kg, 1);
    if (i == 2) scene_body(&s, 0)->attributes.density = 2e15f;
    sbf_status status = sbr_model_create(s.asset, &s.model_options, &s.model, &error);
    ck_assert_int_eq(status, i == 0 ? SBF_OK : SBF_BAD_INPUT);
    if (i > 0) {
      ck_assert_int_eq(error.code, SBF_CODE_VALUE_OUT_OF_RANGE);
      ck_assert_msg(strstr(error.message, i == 1 ? "1e+06 m" : "1e+15 kg/m^3"), "%s", error.message);
      ck_assert_str_eq(error.path,
          i == 1 ? "/sbf/soft_body[1]/level[1]/positions" : "/sbf/soft_body[1]/attributes/@density");
      ck_assert_ptr_null(s.model);
    }
    sbr_model_destroy(s.model);
    sbf_asset_free(s.asset);
  }
}
END_TEST

START_TEST(scheme_and_substeps_come_from_the_call_or_the_level)
{
  scene s = section();
  sbf_simulation *stated = (sbf_simulation *)(uintptr_t)&s.asset->soft_bodies.at[0].levels.at[0].simulation;
  stated->scheme = SBF_SCHEME_RELAXATION;
  stated->substeps = 7;
  const struct {
    sbf_scheme asked;
    uint32_t substeps_asked;
    sbf_scheme scheme;
    uint32_t substeps;
  } cases[] = {{SBF_SCHEME_AUTOMATIC, 0, SBF_SCHEME_RELAXATION, 7},
      {SBF_SCHEME_SYMPLECTIC, 0, SBF_SCHEME_SYMPLECTIC, 0},
      {SBF_SCHEME_SYMPLECTIC, 9, SBF_SCHEME_SYMPLECTIC, 9}};
  for (int i = 0; i < 3; i++) {
    s.model_options.scheme = cases[i].asked;
    s.model_options.substeps = cases[i].substeps_asked;
    scene_start(&s);
    ck_assert_int_eq(s.model->islands[0].scheme->kind, cases[i].scheme);
    ck_assert_uint_eq(s.model->islands[0].stepping.substeps, cases[i].substeps);
    sbr_world_destroy(s.world);
    sbr_model_destroy(s.model);
  }
  s.world = NULL, s.model = NULL;
  scene_free(&s);
}
END_TEST

/* A scheme in the file is a hint, a requested one is not. */
START_TEST(a_scheme_that_cannot_step_a_level_is_refused)
{
  scene s = section();
  sbf_level *level = (sbf_level *)(uintptr_t)s.asset->soft_bodies.at[0].levels.at;
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  ck_assert_ptr_null(sbri_scheme_refuses(&sbri_relaxation, s.model, island));
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  ck_assert_ptr_nonnull(sbri_scheme_refuses(&sbri_relaxation, s.model, island));
  level->model = SBF_ELASTIC_MODEL_SPRINGS;
  ck_assert_ptr_null(sbri_scheme_of(SBF_SCHEME_AUTOMATIC));
  level->simulation.scheme = SBF_SCHEME_BLOCK_DESCENT; /* which does not step what tears */
  scene_body(&s, 0)->attributes.tear_strain = 0.5f;
  sbr_model *model;
  ck_assert_int_eq(sbr_model_create(s.asset, NULL, &model, NULL), SBF_OK);
  ck_assert_ptr_eq(model->islands[0].scheme, &sbri_symplectic);
  sbr_model_destroy(model);
  scene_free(&s);
}
END_TEST

START_TEST(points_of_a_block_have_about_as_many_springs)
{
  scene s = section();
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  ck_assert_uint_eq(island->free_count, 32); /* 26 and padding */
  ck_assert_uint_eq(island->slot_count % SBRI_BLOCK, 0);
  uint32_t visits = 0;
  for (uint32_t i = 0; i < island->springs.count; i++)
    visits += (island->springs.at[i].a < island->free_count) + (island->springs.at[i].b < island->free_count);
  uint32_t cells = island->cells.begins[island->free_count / SBRI_BLOCK];
  ck_assert_uint_le(SBRI_BLOCK * cells, visits + visits / 3); /* little of it padding */
  for (uint32_t slot = 26; slot < 32; slot++) ck_assert_float_eq(island->masses[slot], 0);
  scene_free(&s);
}
END_TEST

START_TEST(freed_bodies_have_their_whole_mass)
{
  double masses[2] = {0, 0};
  for (int free = 0; free < 2; free++) {
    scene s = section();
    s.model_options.free = free;
    scene_start(&s);
    const sbri_island *island = &s.model->islands[0];
    for (uint32_t i = 0; i < island->free_count; i++) masses[free] += (double)island->masses[i];
    ck_assert(s.model->bodies[0].is_pinned != free);
    scene_free(&s);
  }
  ck_assert_double_eq_tol(masses[0], 72, 0.01); /* 0.4 x 0.3 x 0.6 m of water */
  ck_assert_double_eq_tol(masses[1], 72, 0.01);
}
END_TEST

/* Of points inside, stiffness and mass are in one proportion: the middle one, on which all of the surface
 * pulls, is as heavy as that. */
START_TEST(unpinned_interior_points_divide_their_mass_by_stiffness)
{
  scene s = section();
  s.model_options.free = true;
  scene_start(&s);
  const sbri_body *body = &s.model->bodies[0];
  const sbri_island *island = &s.model->islands[0];
  uint32_t surface = body->surface.skin.vertex_count, points = body->level->positions.count;
  double proportion = 0;
  ck_assert_uint_gt(points, surface + 1);
  for (uint32_t point = surface; point < points; point++) {
    uint32_t slot = body->slots.from_point[point];
    double stiffness = 0;
    for (uint32_t i = 0; i < island->springs.count; i++)
      if (island->springs.at[i].a == slot || island->springs.at[i].b == slot)
        stiffness += (double)island->springs.at[i].stiffness_n_m;
    if (point == surface) proportion = stiffness / (double)island->masses[slot];
    ck_assert_double_eq_tol(stiffness / (double)island->masses[slot], proportion, 1e-3 * proportion);
  }
  ck_assert_float_gt(island->masses[body->slots.from_point[surface]],
      2 * island->masses[body->slots.from_point[surface + 1]]);
  scene_free(&s);
}
END_TEST

START_TEST(an_empty_asset_makes_an_empty_model)
{
  scene s = scene_begin();
  s.asset->soft_bodies.count = 0;
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 0);
  scene_ticks(&s, 60);
  ck_assert_double_gt(sbr_character_get_distance(s.world, s.character), 0.5);
  ck_assert_uint_ne(sbr_world_get_state_hash(s.world), 0);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("runtime model");
  TCase *c = tcase_create("runtime model");
  tcase_add_test(c, calls_are_checked);
  tcase_add_test(c, numbers_too_large_to_simulate_are_refused);
  tcase_add_test(c, scheme_and_substeps_come_from_the_call_or_the_level);
  tcase_add_test(c, a_scheme_that_cannot_step_a_level_is_refused);
  tcase_add_test(c, points_of_a_block_have_about_as_many_springs);
  tcase_add_test(c, freed_bodies_have_their_whole_mass);
  tcase_add_test(c, unpinned_interior_points_divide_their_mass_by_stiffness);
  tcase_add_test(c, an_empty_asset_makes_an_empty_model);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
