#include <math.h>

#include "harness.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

START_TEST(stated_mass_is_used)
{
  sbf_rigid_body body;
  sbf_rigid_measures is;
  sbf_rigid_body_init(&body);
  body.mass = 3;
  body.center = (sbf_vec3){1, 2, 3};
  body.inertia = (sbf_vec3){0.1f, 0.2f, 0.25f};
  sbf_rigid_body_measure(&body, &is);
  ck_assert_double_eq(is.mass, 3);
  ck_assert(is.center.y == 2 && is.inertia.z == 0.25f);
}
END_TEST

START_TEST(a_mass_without_a_shape_is_a_ball)
{
  sbf_rigid_body body;
  sbf_rigid_measures is;
  sbf_rigid_body_init(&body);
  body.mass = 1000.0f * 4.18879020f * 0.001f; /* of water, a decimetre in radius */
  sbf_rigid_body_measure(&body, &is);
  ck_assert_double_eq_tol((double)is.inertia.x, 0.4 * is.mass * 0.01, 1e-6);
  body.mass = 0;
  sbf_rigid_body_measure(&body, &is);
  ck_assert_double_eq(is.mass, 0);
}
END_TEST

START_TEST(a_hull_is_filled_evenly)
{
  static const uint32_t corners[24] = {
      0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  static const uint32_t sizes[6] = {4, 4, 4, 4, 4, 4};
  sbf_vec3 points[8];
  for (int i = 0; i < 8; i++) points[i] = (sbf_vec3){i & 1 ? 0.4f : 0, i & 2 ? 0.2f : 0, i & 4 ? 0.6f : 0};
  sbf_polygon_mesh hull;
  sbf_polygon_mesh_init(&hull);
  hull.positions = (sbf_vec3_list){points, 8};
  hull.polygon_sizes = (sbf_u32_list){sizes, 6};
  hull.polygon_points = (sbf_u32_list){corners, 24};
  sbf_rigid_body body;
  sbf_rigid_measures is;
  sbf_rigid_body_init(&body);
  body.hull = &hull;
  body.density = 500;
  sbf_rigid_body_measure(&body, &is);
  ck_assert_double_eq_tol(is.mass, 24, 1e-5);
  ck_assert_float_eq_tol(is.center.z, 0.3f, 1e-6f);
  /* The least about the longest side, which is z. */
  ck_assert_float_eq_tol(is.inertia.x, 24 * (0.16f + 0.04f) / 12, 1e-5f);
  ck_assert_float_eq_tol(is.inertia.z, 24 * (0.16f + 0.36f) / 12, 1e-5f);
  body.mass = 48;
  sbf_rigid_body_measure(&body, &is);
  ck_assert_double_eq(is.mass, 48);
  ck_assert_float_eq_tol(is.inertia.x, 48 * 0.2f / 12, 1e-5f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid_mass");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, stated_mass_is_used);
  tcase_add_test(tests, a_mass_without_a_shape_is_a_ball);
  tcase_add_test(tests, a_hull_is_filled_evenly);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
