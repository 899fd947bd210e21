/* A lattice without a static solution states no error, and the build reports it. */
#include <math.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "shapes.h"

static sbf_asset *asset;
static sbf_build_report report;
static int noted, noted_off;
static char said[1024];

static void setup(void) {
  asset = sbf_asset_create(NULL);
}
static void teardown(void) {
  sbf_asset_free(asset);
}

static void note(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  noted_off += diagnostic->code == SBF_CODE_LEVEL_OFF;
  if (diagnostic->code != SBF_CODE_LEVEL_UNSETTLED && diagnostic->code != SBF_CODE_LEVEL_OFF) return;
  noted++;
  memcpy(said, diagnostic->message,
      sizeof diagnostic->message < sizeof said ? sizeof diagnostic->message : sizeof said);
}

/* A bar of 1.6 x 0.4 x 0.4 m along +X, of 10 MPa, pinned at those points nearest to the places. */
static sbf_asset *build_bar(const sbf_vec3 *positions, uint32_t count, uint32_t elements, uint32_t levels) {
  sbf_polygon_mesh bar = shape_bar(asset, 32, 8, 1.6f, 0.4f);
  sbf_soft_body *body = shape_add_body(asset, "bar", &bar, false);
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  uint32_t *points = sbf_asset_allocate(asset, count, sizeof *points);
  for (uint32_t p = 0; p < count; p++) {
    float min = 1e9f;
    for (uint32_t i = 0; i < bar.positions.count; i++) {
      sbf_vec3 at = bar.positions.at[i];
      float x = at.x - positions[p].x, y = at.y - positions[p].y, z = at.z - positions[p].z;
      float squared = x * x + y * y + z * z;
      if (squared >= min) continue;
      min = squared;
      points[p] = i;
    }
  }
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){points, count};
  body->pins = (sbf_pin_set_list){pins, 1};
  body->attributes.young_modulus = 1e7f;
  sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = elements, .levels = levels, .report = note};
  sbf_asset *built;
  noted = noted_off = 0;
  ck_assert_int_eq(sbf_build(asset, &options, &built, &report, NULL), SBF_OK);
  return built;
}

/* A body that can rotate freely is not calibrated. */
START_TEST(a_body_pinned_at_one_point_causes_a_warning)
{
  const sbf_vec3 position = {0, 0.2f, 0.2f};
  sbf_asset *built = build_bar(&position, 1, 300, 2);
  ck_assert_int_eq(noted, 1);
  ck_assert_ptr_nonnull(strstr(said, "\"bar\""));
  ck_assert_uint_eq(report.lattice_calibration.count, 0);
  for (uint32_t l = 0; l < built->soft_bodies.at[0].levels.count; l++) {
    const sbf_level *level = &built->soft_bodies.at[0].levels.at[l];
    ck_assert_float_eq(level->simulation.error, 0);
    ck_assert_ptr_null(level->calibration);
    ck_assert_uint_eq(level->lattice.reference_modulus.count, 0);
  }
  sbf_asset_free(built);
}
END_TEST

/* Three points of the skin that a coarse lattice has but one or two near to. */
static const sbf_vec3 close_places[] = {{0, -0.1f, -0.1f}, {0, 0, 0.1f}, {0, 0.1f, -0.1f}};

START_TEST(the_finest_is_kept_without_an_error)
{
  sbf_asset *built = build_bar(close_places, 3, 40, 1);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_int_eq(noted, 1);
  ck_assert_ptr_nonnull(strstr(said, "not stated"));
  ck_assert_uint_eq(report.lattice_calibration.count, 0);
  ck_assert_float_eq(level->simulation.error, 0);
  ck_assert_float_gt(level->simulation.cost, 0);
  ck_assert_ptr_null(level->calibration);
  ck_assert_uint_eq(level->lattice.young_modulus.count, 0);
  sbf_asset_free(built);
}
END_TEST

START_TEST(a_coarser_level_is_left_out)
{
  sbf_asset *built = build_bar(close_places, 3, 600, 3);
  const sbf_level_list *levels = &built->soft_bodies.at[0].levels;
  ck_assert_int_eq(noted, 1);
  ck_assert_ptr_nonnull(strstr(said, "left out"));
  ck_assert_uint_eq(levels->count, 2);
  ck_assert_int_eq(levels->at[1].model, SBF_ELASTIC_MODEL_JIGGLE);
  ck_assert_float_gt(levels->at[0].simulation.error, 0);
  ck_assert_float_lt(levels->at[0].simulation.error, 1.7f);
  sbf_asset_free(built);
}
END_TEST

/* Pinned at four corners of its end: a coarse one would otherwise yield by 30 % along its axis. */
static const sbf_vec3 corners[] = {{0, -0.2f, -0.2f}, {0, 0.2f, -0.2f}, {0, -0.2f, 0.2f}, {0, 0.2f, 0.2f}};

START_TEST(the_finest_level_is_kept_with_a_warning)
{
  sbf_asset *built = build_bar(corners, 4, 400, 1);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_int_eq(noted_off, 1);
  ck_assert_ptr_nonnull(strstr(said, "the file states each"));
  ck_assert_float_gt(fabsf(level->calibration->load_errors.at[0]), 0.25f);
  ck_assert_float_lt(fabsf(level->calibration->load_errors.at[1]), 0.1f);
  sbf_asset_free(built);
}
END_TEST

START_TEST(an_inaccurate_coarser_level_is_left_out)
{
  sbf_asset *built = build_bar(corners, 4, 1600, 3);
  const sbf_level_list *levels = &built->soft_bodies.at[0].levels;
  ck_assert_int_eq(noted_off, 1);
  ck_assert_ptr_nonnull(strstr(said, "left out"));
  ck_assert_uint_eq(levels->count, 2);
  ck_assert_int_eq(levels->at[1].model, SBF_ELASTIC_MODEL_JIGGLE);
  sbf_asset_free(built);
}
END_TEST

int main(void) {
  Suite *s = suite_create("unsettled_levels");
  TCase *c = tcase_create("unsettled_levels");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_body_pinned_at_one_point_causes_a_warning);
  tcase_add_test(c, the_finest_is_kept_without_an_error);
  tcase_add_test(c, a_coarser_level_is_left_out);
  tcase_add_test(c, the_finest_level_is_kept_with_a_warning);
  tcase_add_test(c, an_inaccurate_coarser_level_is_left_out);
  suite_add_tcase(s, c);
  return harness_run(s);
}
