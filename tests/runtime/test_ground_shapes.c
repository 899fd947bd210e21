#include <math.h>

#include "harness.h"
#include "sbrun/terrain.h"

static double height(const sbr_ground *g, double x, double z) {
  sbf_vec3 normal;
  double y = g->height(g, x, z, &normal);
  ck_assert_float_eq_tol(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z, 1, 1e-5f);
  return y;
}

START_TEST(a_plane_goes_through_its_point)
{
  sbr_ground g = sbr_ground_plane(1, (sbf_vec3){-0.6f, 0.8f, 0});
  ck_assert_double_eq_tol(height(&g, 0, 5), 1, 1e-9);
  ck_assert_double_eq_tol(height(&g, 4, 0), 4, 1e-6);
}
END_TEST

START_TEST(a_height_field_is_bilinear_and_continues_level)
{
  static const float heights[6] = {0, 1, 2, 0, 1, 4};
  const sbr_height_field field = {heights, 3, 2, 0.5, 10, -1};
  sbr_ground g = sbr_ground_height_field(&field);
  ck_assert_double_eq_tol(height(&g, 10, -1), 0, 1e-9);
  ck_assert_double_eq_tol(height(&g, 10.25, -0.8), 0.5, 1e-9);
  ck_assert_double_eq_tol(height(&g, 11, -0.5), 4, 1e-9);
  ck_assert_double_eq_tol(height(&g, 10.75, -0.75), 2, 1e-9);
  ck_assert_double_eq_tol(height(&g, 99, -9), 2, 1e-9);
}
END_TEST

START_TEST(obstacles_stand_on_their_ground)
{
  sbr_ground base = sbr_ground_slope(45);
  const sbr_obstacle some[3] = {{SBR_OBSTACLE_BOX, {0, 0, -2}, {1, 0.3f, 0.2f}, 1.5707963f},
      {SBR_OBSTACLE_CYLINDER, {5, 1, -2}, {0.5f, 0.25f, 0}, 0},
      {SBR_OBSTACLE_SPHERE, {9, 0, -2}, {1, 0, 0}, 0}};
  const sbr_obstacle_set set = {&base, some, 3};
  sbr_ground g = sbr_ground_with_obstacles(&set);
  ck_assert_double_eq_tol(height(&g, 0, -2.9), 0.3, 1e-6);
  ck_assert_double_eq_tol(height(&g, 0.5, -2), 0, 1e-6);
  ck_assert_double_eq_tol(height(&g, 5.4, -2), 1.25, 1e-6);
  ck_assert_double_eq_tol(height(&g, 9.6, -2), 0.8, 1e-6);
  ck_assert_double_eq_tol(height(&g, 0, 3), 3, 1e-6);
}
END_TEST

static double cast(void *user, sbr_double3 from, double length, sbf_vec3 *normal) {
  ++*(int *)user;
  *normal = (sbf_vec3){0, 1, 0};
  return from.x > 0 && from.y - 2 <= length ? from.y - 2 : -1;
}

START_TEST(rays_are_the_host_s)
{
  int count = 0;
  const sbr_ray_caster caster = {cast, &count, 50, 100, -3};
  sbr_ground g = sbr_ground_from_rays(&caster);
  ck_assert_double_eq_tol(height(&g, 1, 0), 2, 1e-9);
  ck_assert_double_eq_tol(height(&g, -1, 0), -3, 1e-9);
  ck_assert_int_eq(count, 2);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("ground_shapes");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_plane_goes_through_its_point);
  tcase_add_test(tests, a_height_field_is_bilinear_and_continues_level);
  tcase_add_test(tests, obstacles_stand_on_their_ground);
  tcase_add_test(tests, rays_are_the_host_s);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
