#include "build/geometry/triangle_tree.h"

#include <math.h>

#include "harness.h"
#include "random.h"
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

static uint32_t state = 1;

static double triangle_distance(const sbfi_triangle_tree *tree, uint32_t triangle, sbf_vec3 point) {
  double corners[3][3], weights[3];
  for (int k = 0; k < 3; k++) {
    sbf_vec3 p = tree->positions[tree->triangles[triangle].points[k]];
    corners[k][0] = p.x, corners[k][1] = p.y, corners[k][2] = p.z;
  }
  return sbfi_triangle_closest(
      corners[0], corners[1], corners[2], (double[]){point.x, point.y, point.z}, weights);
}

START_TEST(nearest_as_by_trying_all)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 7, 2, (sbf_vec3){0, 0, 0});
  sbfi_triangle_tree tree;
  ck_assert(sbfi_triangle_tree_build(&tree, &mesh, &arena));
  ck_assert_uint_eq(tree.triangle_count, 2 * 6 * 49);
  for (int i = 0; i < 500; i++) {
    sbf_vec3 p = {
        random_between(&state, -2, 2), random_between(&state, -2, 2), random_between(&state, -2, 2)};
    double min = INFINITY, best = INFINITY;
    uint32_t found = sbfi_triangle_tree_nearest(&tree, p, &min), expected = UINT32_MAX;
    for (uint32_t t = 0; t < tree.triangle_count; t++) {
      double d = triangle_distance(&tree, t, p);
      if (d < best) {
        best = d;
        expected = t;
      }
    }
    ck_assert(min == best);
    ck_assert_uint_eq(found, expected);
  }
}
END_TEST

START_TEST(a_bound_is_respected)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 2, 2, (sbf_vec3){0, 0, 0});
  sbfi_triangle_tree tree;
  ck_assert(sbfi_triangle_tree_build(&tree, &mesh, &arena));
  double min = 0.5;
  ck_assert_uint_eq(sbfi_triangle_tree_nearest(&tree, (sbf_vec3){3, 0, 0}, &min), UINT32_MAX);
  ck_assert(min == 0.5);
  min = 4.5;
  ck_assert_uint_ne(sbfi_triangle_tree_nearest(&tree, (sbf_vec3){3, 0.1f, 0}, &min), UINT32_MAX);
  ck_assert_double_eq_tol(min, 4, 1e-9);
}
END_TEST

START_TEST(rays_hit_the_first_shape)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 3, 2, (sbf_vec3){0, 0, 0});
  sbfi_triangle_tree tree;
  ck_assert(sbfi_triangle_tree_build(&tree, &mesh, &arena));
  for (int i = 0; i < 300; i++) {
    sbf_vec3 p = {
        random_between(&state, -1, 1), random_between(&state, -1, 1), random_between(&state, -1, 1)};
    uint32_t found = sbfi_triangle_tree_pierced(&tree, (sbf_vec3){0, 0, 0}, p, INFINITY);
    ck_assert_uint_ne(found, UINT32_MAX);
    /* Of a cube around the origin the ray meets the face of the largest coordinate. */
    float x = fabsf(p.x), y = fabsf(p.y), z = fabsf(p.z);
    sbf_vec3 a = tree.positions[tree.triangles[found].points[0]],
             b = tree.positions[tree.triangles[found].points[1]],
             c = tree.positions[tree.triangles[found].points[2]];
    if (x > y * 1.001f && x > z * 1.001f) ck_assert(a.x == b.x && b.x == c.x && a.x * p.x > 0);
    if (y > x * 1.001f && y > z * 1.001f) ck_assert(a.y == b.y && b.y == c.y && a.y * p.y > 0);
  }
  /* From outside the nearer of the two faces; none if the ray points away. */
  uint32_t found =
      sbfi_triangle_tree_pierced(&tree, (sbf_vec3){5, 0.1f, 0.2f}, (sbf_vec3){4, 0.1f, 0.2f}, INFINITY);
  ck_assert_float_eq(tree.positions[tree.triangles[found].points[0]].x, 1);
  /* The face is four times as far as the point. */
  const sbf_vec3 from = {5, 0.1f, 0.2f}, through = {4, 0.1f, 0.2f};
  ck_assert_uint_eq(sbfi_triangle_tree_pierced(&tree, from, through, 4.01), found);
  ck_assert_uint_eq(sbfi_triangle_tree_pierced(&tree, from, through, 3.99), UINT32_MAX);
  ck_assert_uint_eq(
      sbfi_triangle_tree_pierced(&tree, (sbf_vec3){5, 0, 0}, (sbf_vec3){6, 0, 0}, INFINITY), UINT32_MAX);
}
END_TEST

START_TEST(closest_points)
{
  const double a[3] = {0, 0, 0}, b[3] = {2, 0, 0}, c[3] = {0, 2, 0};
  double w[3];
  ck_assert_double_eq_tol(sbfi_triangle_closest(a, b, c, (double[]){0.5, 0.5, 3}, w), 9, 1e-12);
  ck_assert_double_eq_tol(w[0], 0.5, 1e-12);
  ck_assert_double_eq_tol(w[1], 0.25, 1e-12);
  ck_assert_double_eq_tol(sbfi_triangle_closest(a, b, c, (double[]){1, -2, 0}, w), 4, 1e-12); /* a side */
  ck_assert_double_eq_tol(w[1], 0.5, 1e-12);
  ck_assert(w[2] == 0);
  ck_assert_double_eq_tol(sbfi_triangle_closest(a, b, c, (double[]){3, -1, 0}, w), 2, 1e-12); /* a corner */
  ck_assert(w[1] == 1);
  /* Without area: a side, and a point. */
  ck_assert_double_eq_tol(sbfi_triangle_closest(a, b, b, (double[]){1, 1, 0}, w), 1, 1e-12);
  ck_assert_double_eq_tol(sbfi_triangle_closest(a, a, a, (double[]){1, 1, 1}, w), 3, 1e-12);
  ck_assert_double_eq_tol(w[0] + w[1] + w[2], 1, 1e-12);
}
END_TEST

START_TEST(empty_mesh)
{
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  sbfi_triangle_tree tree;
  double min = INFINITY;
  ck_assert(sbfi_triangle_tree_build(&tree, &mesh, &arena));
  ck_assert_uint_eq(sbfi_triangle_tree_nearest(&tree, (sbf_vec3){0, 0, 0}, &min), UINT32_MAX);
  ck_assert_uint_eq(
      sbfi_triangle_tree_pierced(&tree, (sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0, 0}, INFINITY), UINT32_MAX);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("triangle_tree");
  TCase *c = tcase_create("triangle_tree");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, nearest_as_by_trying_all);
  tcase_add_test(c, a_bound_is_respected);
  tcase_add_test(c, rays_hit_the_first_shape);
  tcase_add_test(c, closest_points);
  tcase_add_test(c, empty_mesh);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
