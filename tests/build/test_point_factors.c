#include "build/materials/point_factors.h"

#include <stdlib.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;
static sbf_soft_body *body;
static sbf_weight_map maps[2];
static float moduli[1000], densities[1000];

/* A cube of 1 m whose modulus falls to a tenth from its bottom to its top. */
static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbf_polygon_mesh cube = shape_cube(asset, 4, 1, (sbf_vec3){0, 0, 0});
  body = shape_add_body(asset, "cube", &cube, false);
  for (int m = 0; m < 2; m++) sbf_weight_map_init(&maps[m]);
  uint32_t count = cube.positions.count;
  for (uint32_t i = 0; i < count; i++) {
    moduli[i] = 0.55f - 0.9f * cube.positions.at[i].y;
    densities[i] = cube.positions.at[i].y > 0 ? 2 : 1;
  }
  maps[0].property = SBF_WEIGHT_PROPERTY_YOUNG_MODULUS;
  maps[0].values = (sbf_f32_list){moduli, count};
  maps[1].property = SBF_WEIGHT_PROPERTY_DENSITY;
  maps[1].values = (sbf_f32_list){densities, count};
  body->weight_maps = (sbf_weight_map_list){maps, 2};
}

static void teardown(void) {
  sbf_asset_free(asset);
}

static sbf_asset *build(sbf_build_interior interior, double cell) {
  sbf_asset *built;
  sbf_diagnostic error;
  sbf_build_options options = {.interior = interior, .cell_m = cell, .without_calibration = true};
  ck_assert_int_eq(sbf_build(asset, &options, &built, NULL, &error), SBF_OK);
  return built;
}

/* Beta three times as large on the right as on the left. */
START_TEST(tetrahedra_are_damped_as_painted)
{
  static float dampings[1000];
  for (uint32_t i = 0; i < body->surface.positions.count; i++)
    dampings[i] = body->surface.positions.at[i].x > 0 ? 3 : 1;
  maps[0].property = SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING;
  maps[0].values.at = dampings;
  body->attributes.stiffness_damping = 0.002f;
  sbf_asset *built = build(SBF_BUILD_INTERIOR_TETRAHEDRA, 0.2);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  const sbf_tetrahedron_mesh *lattice = &level->lattice;
  ck_assert_uint_eq(lattice->stiffness_damping.count, lattice->tetrahedra.count);
  for (uint32_t t = 0; t < lattice->tetrahedra.count; t++) {
    double side = 0;
    for (int k = 0; k < 4; k++) side += level->positions.at[lattice->tetrahedra.at[t].at[k]].x / 4;
    if (side < -0.35) ck_assert_float_eq_tol(lattice->stiffness_damping.at[t], 0.002f, 2e-4f);
    if (side > 0.35) ck_assert_float_eq_tol(lattice->stiffness_damping.at[t], 0.006f, 2e-4f);
  }
  sbf_asset_free(built);
}
END_TEST

START_TEST(tetrahedra_use_weights_painted_nearby)
{
  sbf_asset *built = build(SBF_BUILD_INTERIOR_TETRAHEDRA, 0.2);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  const sbf_tetrahedron_mesh *lattice = &level->lattice;
  ck_assert_uint_eq(lattice->young_modulus.count, lattice->tetrahedra.count);
  ck_assert_uint_eq(lattice->densities.count, lattice->tetrahedra.count);
  ck_assert_mem_eq(lattice->young_modulus.at, lattice->reference_modulus.at, 4 * lattice->tetrahedra.count);
  double modulus = body->attributes.young_modulus, sum = 0;
  for (uint32_t t = 0; t < lattice->tetrahedra.count; t++) {
    double height = 0;
    for (int k = 0; k < 4; k++) height += level->positions.at[lattice->tetrahedra.at[t].at[k]].y / 4;
    /* On the sides the map is linear in height; deep inside the nearest place may be above or below. */
    if (height < -0.3 || height > 0.3)
      ck_assert_double_eq_tol(lattice->young_modulus.at[t], modulus * (0.55 - 0.9 * height), 0.21 * modulus);
  }
  /* The upper quarter is twice as dense, the one below gets there; not multiplied by the map again. */
  float *masses = malloc(level->positions.count * sizeof *masses);
  sum = sbf_level_masses(&built->soft_bodies.at[0], level, NULL, masses);
  ck_assert_double_eq_tol(sum, 1.375 * body->attributes.density, 0.02 * body->attributes.density);
  free(masses);
  sbf_asset_free(built);
}
END_TEST

START_TEST(the_nearest_interior_point_counts)
{
  static const sbf_vec3 middle = {0, 0, 0};
  sbfi_arena scratch;
  float *factors;
  sbf_level level;
  sbf_level_init(&level);
  const sbf_vec3 positions[] = {{0.1f, 0.05f, 0}, {0, 0.5f, 0}, {0.45f, 0.25f, 0.1f}};
  level.positions = (sbf_vec3_list){positions, 3};
  body->interior = (sbf_vec3_list){&middle, 1};
  moduli[maps[0].values.count] = 5;
  maps[0].values.count++;
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert(sbfi_point_factors(body, &level, SBF_WEIGHT_PROPERTY_YOUNG_MODULUS, &scratch, &factors));
  ck_assert_float_eq_tol(factors[0], 5, 1e-6f);
  ck_assert_float_eq_tol(factors[1], 0.1f, 1e-5f);
  ck_assert_float_eq_tol(factors[2], 0.325f, 1e-5f); /* between two points of the side */
  ck_assert(sbfi_point_factors(body, &level, SBF_WEIGHT_PROPERTY_FRICTION, &scratch, &factors));
  ck_assert_ptr_null(factors);
  sbfi_arena_free(&scratch);
}
END_TEST

START_TEST(springs_state_painted_damping)
{
  body->attributes.stiffness_damping = 0.01f;
  maps[0].property = SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING;
  sbf_asset *built = build(SBF_BUILD_INTERIOR_NONE, 0);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  const sbf_spring_set *set = &level->springs.at[0];
  ck_assert_uint_eq(set->damping.count, set->ends.count);
  for (uint32_t s = 0; s < set->ends.count; s++) {
    double factor = (moduli[set->ends.at[s].at[0]] + moduli[set->ends.at[s].at[1]]) / 2;
    ck_assert_double_eq_tol(set->damping.at[s] / (0.01 * set->stiffness.at[s]), factor, 1e-5);
  }
  sbf_asset_free(built);
  body->weight_maps.count = 0;
  built = build(SBF_BUILD_INTERIOR_NONE, 0);
  ck_assert_uint_eq(built->soft_bodies.at[0].levels.at[0].springs.at[0].damping.count, 0);
  sbf_asset_free(built);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("point_factors");
  TCase *c = tcase_create("point_factors");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, tetrahedra_are_damped_as_painted);
  tcase_add_test(c, tetrahedra_use_weights_painted_nearby);
  tcase_add_test(c, the_nearest_interior_point_counts);
  tcase_add_test(c, springs_state_painted_damping);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
