#include <math.h>

#include "harness.h"
#include "shapes/ground.h"

static const double pi = 3.14159265358979323846;

/* The normal from the heights around a position. */
static sbf_vec3 slope_normal(const sbr_ground *g, double x, double z) {
  const double d = 1e-5;
  double sx = (sbri_ground_height(g, x + d, z, NULL) - sbri_ground_height(g, x - d, z, NULL)) / (2 * d);
  double sz = (sbri_ground_height(g, x, z + d, NULL) - sbri_ground_height(g, x, z - d, NULL)) / (2 * d);
  double s = 1 / sqrt(1 + sx * sx + sz * sz);
  return (sbf_vec3){(float)(-sx * s), (float)s, (float)(-sz * s)};
}

static void expect_normal(const sbr_ground *g, double x, double z) {
  sbf_vec3 normal, expected = slope_normal(g, x, z);
  sbri_ground_height(g, x, z, &normal);
  ck_assert_float_eq_tol(normal.x, expected.x, 1e-4f);
  ck_assert_float_eq_tol(normal.y, expected.y, 1e-4f);
  ck_assert_float_eq_tol(normal.z, expected.z, 1e-4f);
}

START_TEST(flat_ground)
{
  sbr_ground g = sbr_ground_flat(0.25);
  double height;
  ck_assert_double_eq(sbri_ground_height(&g, 3, -8, NULL), 0.25);
  ck_assert(sbri_ground_is_flat(&g, &height));
  ck_assert_double_eq(height, 0.25);
  expect_normal(&g, 1, 1);
}
END_TEST

START_TEST(a_slope_rises_forward_from_the_origin)
{
  sbr_ground g = sbr_ground_slope(30);
  ck_assert_double_eq_tol(sbri_ground_height(&g, 5, 2, NULL), 2 * tan(pi / 6), 1e-6);
  ck_assert_double_eq(sbri_ground_height(&g, 5, -2, NULL), 0);
  expect_normal(&g, 0, 1);
  expect_normal(&g, 0, -1);
  g = sbr_ground_slope(90); /* cut to 45 degrees */
  ck_assert_double_eq_tol(sbri_ground_height(&g, 0, 1, NULL), 1, 1e-6);
}
END_TEST

START_TEST(stairs)
{
  sbr_ground g = sbr_ground_stairs(0.1, 0.3);
  const double positions[] = {-1, 0.29, 0.31, 0.59, 0.61, 3.01}, heights[] = {0, 0, 0.1, 0.1, 0.2, 1.0};
  for (int i = 0; i < 6; i++)
    ck_assert_double_eq_tol(sbri_ground_height(&g, 7, positions[i], NULL), heights[i], 1e-12);
  g = sbr_ground_stairs(0.1, 0);
  ck_assert_double_eq(sbri_ground_height(&g, 0, 9, NULL), 0);
}
END_TEST

START_TEST(noise_is_bounded_smooth_and_flat_at_the_origin)
{
  sbr_ground g = sbr_ground_noise(0.2, 7), other = sbr_ground_noise(0.2, 8);
  double low = 1, high = -1, before = 0, differences = 0;
  for (int i = 0; i < 40000; i++) {
    double x = (i % 200) * 0.11 - 11, z = (i / 200) * 0.13 - 13;
    double y = sbri_ground_height(&g, x, z, NULL);
    low = fmin(low, y), high = fmax(high, y);
    differences += fabs(y - sbri_ground_height(&other, x, z, NULL));
  }
  ck_assert_double_ge(low, -0.1);
  ck_assert_double_le(high, 0.1);
  ck_assert_double_gt(high - low, 0.08);
  ck_assert_double_gt(differences, 100);
  ck_assert_double_eq_tol(sbri_ground_height(&g, 0, 0, NULL), 0, 1e-12);
  for (int i = 0; i < 10000; i++) { /* without jumps, over cell borders as well */
    double y = sbri_ground_height(&g, -5 + i * 0.001, 3.21 - i * 0.0007, NULL);
    if (i) ck_assert_double_lt(fabs(y - before), 0.001);
    before = y;
  }
  for (int i = 0; i < 50; i++) expect_normal(&g, i * 0.17 - 4, i * 0.11 - 2);
  ck_assert_double_eq(sbri_ground_height(&g, 1e18, 2, NULL), sbri_ground_height(&g, 1e18, 2, NULL));
}
END_TEST

static double hill(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  *normal = (sbf_vec3){0, 1, 0};
  return *(const double *)ground->user * (x + z);
}

START_TEST(a_ground_of_the_host)
{
  const double factor = 0.5;
  sbr_ground g = {hill, &factor, {0, 0, 0, 0}};
  double height;
  ck_assert_double_eq(sbri_ground_height(&g, 1, 3, NULL), 2);
  ck_assert(!sbri_ground_is_flat(&g, &height));
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("ground");
  TCase *c = tcase_create("ground");
  tcase_add_test(c, flat_ground);
  tcase_add_test(c, a_slope_rises_forward_from_the_origin);
  tcase_add_test(c, stairs);
  tcase_add_test(c, noise_is_bounded_smooth_and_flat_at_the_origin);
  tcase_add_test(c, a_ground_of_the_host);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
