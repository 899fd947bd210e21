#include "build/lattice/region_level.h"

#include <stdlib.h>

#include "harness.h"
#include "mechanics/shape_region.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
#include "sbfmt/validate.h"
#include "shapes.h"

static sbf_asset *asset, *built;
static const sbf_level *level;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbf_polygon_mesh mesh = shape_bar(asset, 16, 4, 1, 0.25f);
  sbf_soft_body *body = shape_add_body(asset, "bar", &mesh, false);
  body->attributes.young_modulus = 5e4f;
  body->attributes.density = 800;
  const sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_SHAPE_MATCHING, .elements = 3000, .levels = 3};
  sbf_diagnostic error;
  sbf_validate_result result;
  sbf_build_report report;
  ck_assert_msg(sbf_build(asset, &options, &built, &report, &error) == SBF_OK, "%s", error.message);
  ck_assert_int_eq(sbf_validate(built, NULL, &result, NULL), SBF_OK);
  ck_assert_uint_eq(result.errors, 0);
  ck_assert_uint_eq(built->soft_bodies.at[0].levels.count, 1);
  level = built->soft_bodies.at[0].levels.at;
}
static void teardown(void) {
  sbf_asset_free(built);
  sbf_asset_free(asset);
}

START_TEST(each_point_has_a_region_of_its_neighbours)
{
  const sbf_shape_regions *regions = level->regions;
  ck_assert_int_eq(level->model, SBF_ELASTIC_MODEL_SHAPE_MATCHING);
  ck_assert_uint_gt(level->lattice.tetrahedra.count, 1000); /* which carry the surface */
  ck_assert_uint_eq(level->embeddings.count, 1);
  ck_assert_uint_eq(regions->sizes.count, level->positions.count);
  const uint32_t *points = regions->points.at;
  for (uint32_t r = 0; r < regions->sizes.count; points += regions->sizes.at[r++]) {
    bool has_itself = false;
    ck_assert_uint_ge(regions->sizes.at[r], 4);
    ck_assert_uint_le(regions->sizes.at[r], 32);
    for (uint32_t i = 0; i < regions->sizes.at[r]; i++) has_itself = has_itself || points[i] == r;
    ck_assert(has_itself);
  }
}
END_TEST

/* Stretched by a thousandth along an axis, or sheared: the energy of a continuum of E and nu = 0, within the
 * error of the flat regions along the sides of a slender bar: 16 % more along it, less across. */
START_TEST(small_strains_have_the_stress_of_the_modulus)
{
  const sbf_soft_body *body = &built->soft_bodies.at[0];
  const sbf_shape_regions *regions = level->regions;
  uint32_t count = level->positions.count;
  float *masses = calloc(count, sizeof *masses);
  uint32_t *uses = calloc(count, sizeof *uses);
  double mass = sbf_level_masses(body, level, NULL, masses), energy = 0, strain = 1e-3;
  ck_assert_double_eq_tol(mass, 800 / 16.0, 0.5);
  for (uint32_t i = 0; i < regions->points.count; i++) uses[regions->points.at[i]]++;
  const uint32_t *points = regions->points.at;
  for (uint32_t r = 0; r < regions->sizes.count; points += regions->sizes.at[r++]) {
    sbfi_d3 at[64], center;
    double weights[64];
    for (uint32_t i = 0; i < regions->sizes.at[r]; i++) {
      weights[i] = (double)masses[points[i]] / uses[points[i]];
      at[i] = sbfi_d3_of(level->positions.at[points[i]]);
    }
    center = sbfi_region_center(weights, at, regions->sizes.at[r]);
    for (uint32_t i = 0; i < regions->sizes.at[r]; i++) { /* a symmetric strain turns nothing */
      sbfi_d3 p = sbfi_d3_sub(at[i], center), off = {0, 0, 0};
      if (_i < 3)
        (&off.x)[_i] = strain * (&p.x)[_i];
      else
        off = (sbfi_d3){strain * p.y, strain * p.x, 0};
      energy += 0.5 * weights[i] * (double)regions->stiffness * regions->stiffness * sbfi_d3_dot(off, off);
    }
  }
  double expected = 0.5 * 5e4 * strain * strain / 16 * (_i < 3 ? 1 : 2);
  ck_assert_double_eq_tol(energy / expected, 1, 0.2);
  free(masses);
  free(uses);
}
END_TEST

int main(void) {
  Suite *s = suite_create("region_level");
  TCase *c = tcase_create("region_level");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, each_point_has_a_region_of_its_neighbours);
  tcase_add_loop_test(c, small_strains_have_the_stress_of_the_modulus, 0, 4);
  suite_add_tcase(s, c);
  return harness_run(s);
}
