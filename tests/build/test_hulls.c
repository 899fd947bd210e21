#include "build/geometry/hulls.h"

#include <math.h>

#include "harness.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena scratch;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&scratch, NULL, 0);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&scratch);
}

static void check_convex(const sbf_polygon_mesh *hull, const sbf_vec3 *points, uint32_t count) {
  sbf_surface_measures m;
  sbf_surface_measure(hull, NULL, &m);
  ck_assert_double_gt(m.volume, 0);
  ck_assert_double_lt(m.opening, 1e-6);
  for (uint32_t i = 0; i < count; i++) ck_assert(sbfi_hull_contains(hull, points[i]));
}

START_TEST(cube_has_six_faces)
{
  sbf_polygon_mesh cube = shape_cube(asset, 4, 2, (sbf_vec3){5, 0, -3}), hull;
  ck_assert_int_eq(
      sbfi_hull_make(cube.positions.at, cube.positions.count, asset, &hull, &scratch), SBFI_HULL_MADE);
  ck_assert_uint_eq(hull.positions.count, 8);
  ck_assert_uint_eq(hull.polygon_sizes.count, 6);
  for (uint32_t p = 0; p < 6; p++) ck_assert_uint_eq(hull.polygon_sizes.at[p], 4);
  ck_assert_int_eq(hull.target, SBF_MESH_TARGET_COLLISION_DETECTION);
  check_convex(&hull, cube.positions.at, cube.positions.count);
  sbf_surface_measures m;
  sbf_surface_measure(&hull, NULL, &m);
  ck_assert_double_eq_tol(m.volume, 8, 1e-5);
  ck_assert(sbfi_hull_contains(&hull, (sbf_vec3){5.9f, 0.9f, -3.9f}));
  ck_assert(!sbfi_hull_contains(&hull, (sbf_vec3){6.1f, 0, -3}));
}
END_TEST

START_TEST(points_keep_their_order)
{
  sbf_polygon_mesh cube = shape_cube(asset, 3, 1, (sbf_vec3){0, 0, 0}), hull;
  ck_assert_int_eq(
      sbfi_hull_make(cube.positions.at, cube.positions.count, asset, &hull, &scratch), SBFI_HULL_MADE);
  uint32_t next = 0, corner = 0, last = 0;
  for (uint32_t i = 0; i < cube.positions.count && next < 8; i++) {
    sbf_vec3 a = cube.positions.at[i], b = hull.positions.at[next];
    next += a.x == b.x && a.y == b.y && a.z == b.z;
  }
  ck_assert_uint_eq(next, 8);
  for (uint32_t p = 0; p < hull.polygon_sizes.count; corner += hull.polygon_sizes.at[p++]) {
    uint32_t first = hull.polygon_points.at[corner];
    for (uint32_t k = 1; k < hull.polygon_sizes.at[p]; k++)
      ck_assert_uint_gt(hull.polygon_points.at[corner + k], first);
    ck_assert_uint_ge(first, last);
    last = first;
  }
}
END_TEST

START_TEST(ball)
{
  /* Points on a sphere along a spiral, and some inside. */
  enum { OUTSIDE = 200, ALL = 260 };
  sbf_vec3 points[ALL];
  for (int i = 0; i < ALL; i++) {
    double z = 1 - 2 * (i % OUTSIDE + 0.5) / OUTSIDE, r = sqrt(1 - z * z), turn = 2.399963229728653 * i;
    double size = i < OUTSIDE ? 1 : 0.5;
    points[i] = (sbf_vec3){(float)(size * r * cos(turn)), (float)(size * r * sin(turn)), (float)(size * z)};
  }
  sbf_polygon_mesh hull;
  ck_assert_int_eq(sbfi_hull_make(points, ALL, asset, &hull, &scratch), SBFI_HULL_MADE);
  ck_assert_uint_eq(hull.positions.count, OUTSIDE);
  ck_assert_uint_eq(hull.polygon_sizes.count, 2 * OUTSIDE - 4);
  check_convex(&hull, points, ALL);
}
END_TEST

START_TEST(flat_input)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 5, 5), hull;
  sbf_vec3 line[10], same[10];
  for (int i = 0; i < 10; i++) {
    line[i] = (sbf_vec3){(float)i, 2 * (float)i, 3};
    same[i] = (sbf_vec3){1, 2, 3};
  }
  ck_assert_int_eq(
      sbfi_hull_make(sheet.positions.at, sheet.positions.count, asset, &hull, &scratch), SBFI_HULL_FLAT);
  ck_assert_int_eq(sbfi_hull_make(line, 10, asset, &hull, &scratch), SBFI_HULL_FLAT);
  ck_assert_int_eq(sbfi_hull_make(same, 10, asset, &hull, &scratch), SBFI_HULL_FLAT);
  ck_assert_int_eq(sbfi_hull_make(line, 3, asset, &hull, &scratch), SBFI_HULL_FLAT);
  ck_assert_int_eq(sbfi_hull_make(NULL, 0, asset, &hull, &scratch), SBFI_HULL_FLAT);
}
END_TEST

START_TEST(thin_but_not_flat)
{
  sbf_vec3 points[8];
  for (int i = 0; i < 8; i++)
    points[i] = (sbf_vec3){(float)(i & 1), (float)(i >> 1 & 1), 0.001f * (float)(i >> 2)};
  sbf_polygon_mesh hull;
  ck_assert_int_eq(sbfi_hull_make(points, 8, asset, &hull, &scratch), SBFI_HULL_MADE);
  ck_assert_uint_eq(hull.polygon_sizes.count, 6);
  check_convex(&hull, points, 8);
}
END_TEST

START_TEST(the_lizards_sections)
{
  const char *path = harness_shared("lizard/liz.obj");
  if (!path) return;
  shape_sections_of_obj(asset, path);
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_vec3_list *points = &asset->soft_bodies.at[b].surface.positions;
    sbf_polygon_mesh hull, again;
    ck_assert_int_eq(sbfi_hull_make(points->at, points->count, asset, &hull, &scratch), SBFI_HULL_MADE);
    check_convex(&hull, points->at, points->count);
    ck_assert_int_eq(sbfi_hull_make(points->at, points->count, asset, &again, &scratch), SBFI_HULL_MADE);
    ck_assert_uint_eq(hull.polygon_points.count, again.polygon_points.count);
    ck_assert_mem_eq(
        hull.polygon_points.at, again.polygon_points.at, hull.polygon_points.count * sizeof(uint32_t));
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("hulls");
  TCase *c = tcase_create("hulls");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, cube_has_six_faces);
  tcase_add_test(c, points_keep_their_order);
  tcase_add_test(c, ball);
  tcase_add_test(c, flat_input);
  tcase_add_test(c, thin_but_not_flat);
  tcase_add_test(c, the_lizards_sections);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
