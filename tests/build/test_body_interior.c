#include "build/body_interior.h"

#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbf_soft_body *body;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbf_polygon_mesh cube = shape_cube(asset, 2, 1, (sbf_vec3){0, 0, 0});
  body = shape_add_body(asset, "cube", &cube, false);
}
static void teardown(void) {
  sbf_asset_free(asset);
}

static sbf_build_interior automatic(void) {
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_AUTOMATIC};
  return sbfi_body_interior(&options, body);
}

START_TEST(bodies_on_a_bone_get_springs_to_their_centre)
{
  ck_assert_int_eq(automatic(), SBF_BUILD_INTERIOR_TETRAHEDRA);
  body->bone = 0;
  ck_assert_int_eq(automatic(), SBF_BUILD_INTERIOR_CENTROID);
  body->derived = 0; /* a section that was cut */
  ck_assert_int_eq(automatic(), SBF_BUILD_INTERIOR_AUTOMATIC);
}
END_TEST

START_TEST(a_sheet_gets_no_interior_points)
{
  body->surface.polygon_sizes.count = 1; /* of its sides */
  body->surface.polygon_points.count = body->surface.polygon_sizes.at[0];
  ck_assert_int_eq(automatic(), SBF_BUILD_INTERIOR_NONE);
  ck_assert(!sbfi_body_is_calibrated(body, SBF_BUILD_INTERIOR_CENTROID));
}
END_TEST

/* Solving the springs takes hundreds of steps each; with many points, minutes. */
START_TEST(a_loose_cloud_of_springs_is_not_calibrated)
{
  sbf_polygon_mesh fine = shape_cube(asset, 16, 1, (sbf_vec3){0, 0, 0});
  ck_assert(sbfi_body_is_calibrated(body, SBF_BUILD_INTERIOR_CENTROID));
  body->surface = fine;
  ck_assert_uint_gt(fine.positions.count, 1000);
  ck_assert(!sbfi_body_is_calibrated(body, SBF_BUILD_INTERIOR_CENTROID));
  ck_assert(sbfi_body_is_calibrated(body, SBF_BUILD_INTERIOR_TETRAHEDRA));
  body->bone = 0;
  ck_assert(sbfi_body_is_calibrated(body, SBF_BUILD_INTERIOR_CENTROID));
}
END_TEST

int main(void) {
  Suite *s = suite_create("body_interior");
  TCase *c = tcase_create("body_interior");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, bodies_on_a_bone_get_springs_to_their_centre);
  tcase_add_test(c, a_sheet_gets_no_interior_points);
  tcase_add_test(c, a_loose_cloud_of_springs_is_not_calibrated);
  suite_add_tcase(s, c);
  return harness_run(s);
}
