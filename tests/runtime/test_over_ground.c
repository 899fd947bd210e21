#include <math.h>

#include "animation/gait/gait_state.h"
#include "harness.h"

static const float PI = 3.14159265f;

START_TEST(angles_are_wrapped_into_one_rotation)
{
  for (int turns = -3; turns <= 3; turns++)
    for (float angle = -3.1f; angle < 3.14f; angle += 0.31f)
      ck_assert_float_eq_tol(sbri_wrap_angle(angle + 2 * PI * (float)turns), angle, 1e-5f);
  ck_assert_float_eq(sbri_wrap_angle(PI), PI); /* a cell includes one of its ends, not the other */
  ck_assert_float_eq(sbri_wrap_angle(-PI), PI);
}
END_TEST

START_TEST(a_quarter_rotation_points_from_ahead_to_the_left)
{
  sbf_vec3 left = sbri_rotate_yaw(sbri_vec3(0, 0.5f, 2), 0.5f * PI);
  ck_assert_float_le(sbri_length(sbri_sub(left, sbri_vec3(2, 0.5f, 0))), 1e-6f);
  sbf_vec3 v = {0.3f, -0.2f, 0.7f};
  sbf_vec3 turned = sbri_rotate_yaw(v, 0.8f);
  sbf_vec3 by_rotation = sbri_rotate(sbri_quat_about(sbri_vec3(0, 1, 0), 0.8f), v);
  ck_assert_float_le(sbri_length(sbri_sub(turned, by_rotation)), 1e-6f);
  ck_assert_float_le(sbri_length(sbri_sub(sbri_rotate_yaw(turned, -0.8f), v)), 1e-6f);
}
END_TEST

static double rising(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)ground;
  *normal = sbri_normalize(sbri_vec3(-2, 1, -3), sbri_vec3(0, 1, 0));
  return 2 * x + 3 * z;
}

START_TEST(the_ground_is_found_relative_to_the_origin)
{
  const sbr_ground ground = {rising, NULL, {0}};
  const sbri_gait_input input = {.scale = 1, .ground = &ground, .origin = {1e6, 5e6, 1e6}};
  sbf_vec3 normal, at = sbri_ground_below(&input, sbri_vec3(0.25f, 77, -0.5f), &normal);
  ck_assert(at.x == 0.25f && at.z == -0.5f);
  ck_assert_float_eq(at.y, -1); /* so far out, floats would be 0.5 m apart */
  ck_assert_float_eq_tol(normal.x / normal.y, -2, 1e-5f);
  ck_assert_float_eq(sbri_ground_below(&input, sbri_vec3(0.25f, -77, -0.5f), NULL).y, -1);
}
END_TEST

START_TEST(flat_distances_ignore_height)
{ ck_assert_float_eq(sbri_flat_distance(sbri_vec3(1, -9, 2), sbri_vec3(4, 30, -2)), 5); }
END_TEST

int main(void) {
  Suite *suite = suite_create("over_ground");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, angles_are_wrapped_into_one_rotation);
  tcase_add_test(tests, a_quarter_rotation_points_from_ahead_to_the_left);
  tcase_add_test(tests, the_ground_is_found_relative_to_the_origin);
  tcase_add_test(tests, flat_distances_ignore_height);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
