#include "build/geometry/surface_distance.h"

#include <math.h>

#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static sbfi_progress silent(void) {
  return sbfi_progress_whole(NULL, NULL);
}

static double distance_between(const sbf_polygon_mesh *a, const sbf_polygon_mesh *b) {
  sbfi_triangle_tree trees[2];
  double there, back;
  ck_assert(sbfi_triangle_tree_build(&trees[0], a, &arena) && sbfi_triangle_tree_build(&trees[1], b, &arena));
  ck_assert(sbfi_surface_distance(&there, &trees[0], &trees[1], silent()));
  ck_assert(sbfi_surface_distance(&back, &trees[1], &trees[0], silent()));
  ck_assert_double_eq_tol(there, back, 0.06 * there + 1e-9);
  return there;
}

START_TEST(cubes_in_each_other)
{
  sbf_polygon_mesh outer = shape_cube(asset, 5, 2, (sbf_vec3){0, 0, 0}),
                   inner = shape_cube(asset, 3, 1, (sbf_vec3){0, 0, 0}),
                   beside = shape_cube(asset, 4, 2, (sbf_vec3){0.5f, 0, 0});
  double far = distance_between(&outer, &inner); /* the outer's corners from the inner's */
  ck_assert_double_ge(far, sqrt(0.75) * (1 - 1e-7));
  ck_assert_double_le(far, sqrt(0.75) * 1.05);
  far = distance_between(&outer, &beside);
  ck_assert_double_ge(far, 0.5 * (1 - 1e-7));
  ck_assert_double_le(far, 0.525);
}
END_TEST

/* The greatest distance is at no corner of either: the middle of a roof's ridge cut short. */
START_TEST(far_from_all_corners)
{
  static const sbf_vec3 points[] = {{-1, 0, 0}, {1, 0, 0}, {-1, 0, 1}, {1, 0, 1}, {0, 0.4f, 0}, {0, 0.4f, 1}};
  static const uint32_t flat_sizes[] = {4}, flat_points[] = {0, 2, 3, 1};
  static const uint32_t roof_sizes[] = {4, 4}, roof_points[] = {0, 2, 5, 4, 4, 5, 3, 1};
  sbf_polygon_mesh flat, roof;
  sbf_polygon_mesh_init(&flat);
  flat.positions = (sbf_vec3_list){points, 6};
  roof = flat;
  flat.polygon_sizes = (sbf_u32_list){flat_sizes, 1};
  flat.polygon_points = (sbf_u32_list){flat_points, 4};
  roof.polygon_sizes = (sbf_u32_list){roof_sizes, 2};
  roof.polygon_points = (sbf_u32_list){roof_points, 8};
  double far = distance_between(&flat, &roof);
  ck_assert_double_ge(far, 0.4 * (1 - 1e-6));
  ck_assert_double_le(far, 0.42);
  /* From below only: the flat sheet's middle is nearer to the slopes than the ridge is to the sheet. */
  static const uint32_t half_sizes[] = {3}, half_points[] = {0, 2, 3};
  sbf_polygon_mesh half = flat;
  half.polygon_sizes = (sbf_u32_list){half_sizes, 1};
  half.polygon_points = (sbf_u32_list){half_points, 3};
  far = distance_between(&flat, &half); /* the corner left out, from the diagonal */
  ck_assert_double_eq_tol(far, 2 / sqrt(5), 0.05 * 2 / sqrt(5));
}
END_TEST

START_TEST(one_surface_in_two_cuts)
{
  sbf_polygon_mesh coarse = shape_sheet(asset, 4, 4), fine = shape_triangulated(asset, &coarse);
  double far = distance_between(&coarse, &fine);
  ck_assert_double_le(far, 0.02); /* a hundredth of a triangle */
  coarse.polygon_sizes.count = coarse.polygon_points.count = 0;
  ck_assert(distance_between(&coarse, &fine) == 0);
}
END_TEST

static bool count_down(void *user, double done) {
  ck_assert(done >= 0 && done <= 1);
  return --*(int *)user >= 0;
}

START_TEST(cancelled)
{
  sbf_polygon_mesh a = shape_cube(asset, 20, 2, (sbf_vec3){0, 0, 0}),
                   b = shape_cube(asset, 21, 2, (sbf_vec3){0, 0, 0});
  sbfi_triangle_tree trees[2];
  double far;
  ck_assert(
      sbfi_triangle_tree_build(&trees[0], &a, &arena) && sbfi_triangle_tree_build(&trees[1], &b, &arena));
  int calls = 0, allowed = 0;
  for (;; allowed++) {
    calls = allowed;
    bool whole = sbfi_surface_distance(&far, &trees[0], &trees[1], sbfi_progress_whole(count_down, &calls));
    if (whole) break;
  }
  ck_assert_int_eq(allowed, 8); /* 4,800 and 5,292 triangles, twice each and both ways, every 4096th */
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("surface_distance");
  TCase *c = tcase_create("surface_distance");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, cubes_in_each_other);
  tcase_add_test(c, far_from_all_corners);
  tcase_add_test(c, one_surface_in_two_cuts);
  tcase_add_test(c, cancelled);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
