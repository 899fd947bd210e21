#include "mechanics/shape_region.h"

#include "harness.h"

enum { POINTS = 7 };
static const double weights[POINTS] = {1, 0.5, 2, 1.2, 0.7, 3, 0.1};
static const sbfi_d3 positions[POINTS] = {{0, 0, 0}, {1, 0.2, 0}, {0.1, 0.9, 0.3}, {-0.2, 0.4, 1.1},
    {0.8, 0.7, 0.6}, {-0.5, -0.3, 0.2}, {0.3, -0.8, -0.4}};
static sbfi_d3 offsets[POINTS];

static void setup(void) {
  sbfi_d3 center = sbfi_region_center(weights, positions, POINTS);
  for (int i = 0; i < POINTS; i++) offsets[i] = sbfi_d3_sub(positions[i], center);
}

static sbfi_region_fit fit_to(const sbfi_d3 *x) {
  sbfi_region_sums sums = {0};
  for (int i = 0; i < POINTS; i++) sbfi_region_add(&sums, weights[i], offsets[i], x[i]);
  return sbfi_region_fit_of(&sums);
}

static double energy(const sbfi_d3 *x) {
  sbfi_region_fit fit = fit_to(x);
  double sum = 0;
  for (int i = 0; i < POINTS; i++) {
    sbfi_d3 off = sbfi_d3_sub(x[i], sbfi_region_goal(&fit, offsets[i]));
    sum += 0.5 * weights[i] * sbfi_d3_dot(off, off);
  }
  return sum;
}

static sbfi_d3 turned(sbfi_d3 v) { /* 0.6 and 0.8 about z, then about x: a rotation by exact numbers */
  sbfi_d3 a = {0.6 * v.x - 0.8 * v.y, 0.8 * v.x + 0.6 * v.y, v.z};
  return (sbfi_d3){a.x + 5, 0.6 * a.y - 0.8 * a.z - 2, 0.8 * a.y + 0.6 * a.z + 1};
}

START_TEST(a_turned_shape_is_found)
{
  sbfi_d3 x[POINTS];
  for (int i = 0; i < POINTS; i++) x[i] = turned(positions[i]);
  sbfi_region_fit fit = fit_to(x);
  for (int i = 0; i < POINTS; i++)
    ck_assert_double_le(sbfi_d3_length(sbfi_d3_sub(x[i], sbfi_region_goal(&fit, offsets[i]))), 1e-12);
  ck_assert_double_le(energy(x), 1e-24);
}
END_TEST

/* No turn nearby holds less, and the moment of the forces vanishes there. */
START_TEST(forces_are_those_of_the_energy)
{
  sbfi_d3 x[POINTS], sum = {0, 0, 0}, moment = {0, 0, 0};
  for (int i = 0; i < POINTS; i++) {
    x[i] = turned(positions[i]);
    x[i].x += 0.3 * sin(i), x[i].y *= 1.2, x[i].z += 0.2 * cos(3 * i);
  }
  sbfi_region_fit fit = fit_to(x);
  const double step = 1e-6;
  for (int i = 0; i < POINTS; i++) {
    sbfi_d3 f = sbfi_d3_scale(sbfi_d3_sub(sbfi_region_goal(&fit, offsets[i]), x[i]), weights[i]);
    sbfi_d3 up[POINTS], down[POINTS];
    for (int k = 0; k < POINTS; k++) up[k] = down[k] = x[k];
    up[i].y += step, down[i].y -= step;
    ck_assert_double_eq_tol((energy(down) - energy(up)) / (2 * step), f.y, 1e-8);
    sum = sbfi_d3_add(sum, f);
    moment = sbfi_d3_add(moment, sbfi_d3_cross(x[i], f));
  }
  ck_assert_double_le(sbfi_d3_length(sum), 1e-12);
  ck_assert_double_le(sbfi_d3_length(moment), 1e-12);
  ck_assert_double_gt(energy(x), 1e-3);
}
END_TEST

START_TEST(a_mirrored_shape_is_turned_not_mirrored)
{
  sbfi_d3 x[POINTS];
  for (int i = 0; i < POINTS; i++) x[i] = (sbfi_d3){-positions[i].x, positions[i].y, positions[i].z};
  sbfi_region_fit fit = fit_to(x);
  double det = sbfi_d3_dot(fit.columns[0], sbfi_d3_cross(fit.columns[1], fit.columns[2]));
  ck_assert_double_eq_tol(det, 1, 1e-12);
  ck_assert_double_gt(energy(x), 1e-3);
}
END_TEST

int main(void) {
  Suite *s = suite_create("shape region");
  TCase *c = tcase_create("shape region");
  tcase_add_checked_fixture(c, setup, NULL);
  tcase_add_test(c, a_turned_shape_is_found);
  tcase_add_test(c, forces_are_those_of_the_energy);
  tcase_add_test(c, a_mirrored_shape_is_turned_not_mirrored);
  suite_add_tcase(s, c);
  return harness_run(s);
}
