#include "mechanics/linear_statics.h"

#include <math.h>
#include <string.h>

#include "harness.h"
#include "lattice_box.h"
#include "mechanics/network.h"

static sbfi_arena arena;

static lattice_box box;
static sbf_spring_network network;

/* A bar of 20 x 3 x 3 cells, pinned at x = 0: many points, so smooth errors decay slowly. */
static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
  box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){2, 0.3f, 0.3f}, 20, 3, 3, 1000, 1e6f, 0.3f);
  lattice_box_hold(&box);
  network = lattice_box_network(&box);
}
static void teardown(void) {
  lattice_box_free(&box);
  sbfi_arena_free(&arena);
}

enum { POINTS = 21 * 4 * 4 };

static void weigh(double *forces, int axis) {
  ck_assert_uint_eq(box.point_count, POINTS);
  for (uint32_t i = 0; i < POINTS; i++) forces[3 * i + (uint32_t)axis] = box.masses[i];
}

/* The same answer as without a preconditioner, in a tenth of the steps that Gauss-Seidel alone would take. */
START_TEST(a_bar_bends_in_few_steps)
{
  static double forces[3 * POINTS], moved[3 * POINTS], wanted[3 * POINTS], scratch[10 * POINTS];
  sbfi_linear_statics linear;
  weigh(forces, 1);
  ck_assert_double_lt(sbf_network_static(&network, forces, 1e-10, 20000, wanted, scratch), 1e-8);
  ck_assert(sbfi_linear_statics_make(&linear, &network, &arena));
  ck_assert(linear.coarse);
  uint32_t steps = sbfi_linear_statics_solve(&linear, forces, 1e-6, moved);
  linear.coarse = false;
  static double alone[3 * POINTS];
  uint32_t without = sbfi_linear_statics_solve(&linear, forces, 1e-6, alone);
  ck_assert_uint_lt(steps, 50);
  ck_assert_uint_gt(without, 2 * steps);
  for (size_t i = 0; i < 3 * POINTS; i++)
    ck_assert_double_eq_tol(
        moved[i], wanted[i], 1e-5 * fabs(wanted[3 * lattice_box_point(&box, 20, 3, 3) + 1]));
}
END_TEST

START_TEST(a_solution_is_a_start_for_the_next)
{
  static double forces[3 * POINTS], moved[3 * POINTS];
  sbfi_linear_statics linear;
  weigh(forces, 2);
  ck_assert(sbfi_linear_statics_make(&linear, &network, &arena));
  ck_assert_uint_gt(sbfi_linear_statics_solve(&linear, forces, 1e-4, moved), 5);
  ck_assert_uint_eq(sbfi_linear_statics_solve(&linear, forces, 1e-4, moved), 0);
}
END_TEST

START_TEST(half_the_modulus_gives_twice_as_much)
{
  static double forces[3 * POINTS], before[3 * POINTS], after[3 * POINTS];
  sbfi_linear_statics linear;
  weigh(forces, 2);
  ck_assert(sbfi_linear_statics_make(&linear, &network, &arena));
  sbfi_linear_statics_solve(&linear, forces, 1e-7, before);
  for (uint32_t t = 0; t < network.tetrahedron_count; t++) box.young_modulus[t] /= 2;
  sbfi_linear_statics_refresh(&linear);
  sbfi_linear_statics_solve(&linear, forces, 1e-7, after);
  size_t tip = 3 * lattice_box_point(&box, 20, 3, 3) + 2;
  ck_assert_double_eq_tol(after[tip] / before[tip], 2, 1e-5);
}
END_TEST

enum { FEW = 9 * 3 * 3 };

static lattice_box make_small_bar(void) {
  return lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){2, 0.3f, 0.3f}, 8, 2, 2, 1000, 1e6f, 0.3f);
}

static void compare_small(lattice_box *small, const double *forces) {
  static double moved[3 * FEW], wanted[3 * FEW], scratch[10 * FEW];
  sbf_spring_network of = lattice_box_network(small);
  sbfi_linear_statics linear;
  double max = 0;
  memset(moved, 0, sizeof moved);
  ck_assert_double_lt(sbf_network_static(&of, forces, 1e-12, 20000, wanted, scratch), 1e-10);
  ck_assert(sbfi_linear_statics_make_direct(&linear, &of, &arena));
  ck_assert(linear.is_direct);
  ck_assert_uint_eq(linear.direct.null_count, 0);
  ck_assert_uint_eq(sbfi_linear_statics_solve(&linear, forces, 1e-8, moved), 1);
  for (size_t i = 0; i < 3 * FEW; i++) max = fmax(max, fabs(wanted[i]));
  for (size_t i = 0; i < 3 * FEW; i++) ck_assert_double_eq_tol(moved[i], wanted[i], 1e-6 * max);
}

/* Few points: one factorisation, and the answer of conjugate gradients. */
START_TEST(a_small_bar_bends_at_once)
{
  static double forces[3 * FEW];
  lattice_box small = make_small_bar();
  lattice_box_hold(&small);
  ck_assert_uint_eq(small.point_count, FEW);
  for (uint32_t i = 0; i < FEW; i++) forces[3 * i + 1] = small.masses[i], forces[3 * i] = -forces[3 * i + 1];
  compare_small(&small, forces);
  lattice_box_free(&small);
}
END_TEST

/* Nothing resists its motion as a whole: no factorisation, but an answer to balanced forces. */
START_TEST(a_small_unpinned_bar)
{
  static double forces[3 * FEW], moved[3 * FEW];
  lattice_box small = make_small_bar();
  sbf_spring_network of = lattice_box_network(&small);
  sbfi_linear_statics linear;
  for (uint32_t y = 0; y < 3; y++)
    for (uint32_t z = 0; z < 3; z++) {
      forces[3 * lattice_box_point(&small, 0, y, z)] = -1;
      forces[3 * lattice_box_point(&small, 8, y, z)] = 1;
    }
  ck_assert(sbfi_linear_statics_make_direct(&linear, &of, &arena));
  ck_assert_uint_eq(linear.direct.null_count, 6);
  sbfi_linear_statics_solve(&linear, forces, 1e-8, moved);
  double longer =
      moved[3 * lattice_box_point(&small, 8, 1, 1)] - moved[3 * lattice_box_point(&small, 0, 1, 1)];
  ck_assert_double_eq_tol(longer, 9 * 2 / (0.3 * 0.3 * 1e6), 0.1 * 2e-4);
  lattice_box_free(&small);
}
END_TEST

/* Refreshed moduli are factorised again. */
START_TEST(a_small_bar_of_twice_the_modulus)
{
  static double forces[3 * FEW], before[3 * FEW], after[3 * FEW];
  lattice_box small = make_small_bar();
  lattice_box_hold(&small);
  sbf_spring_network of = lattice_box_network(&small);
  sbfi_linear_statics linear;
  size_t tip = 3 * lattice_box_point(&small, 8, 2, 2) + 2;
  for (uint32_t i = 0; i < FEW; i++) forces[3 * i + 2] = small.masses[i];
  ck_assert(sbfi_linear_statics_make_direct(&linear, &of, &arena));
  sbfi_linear_statics_solve(&linear, forces, 1e-7, before);
  for (uint32_t t = 0; t < of.tetrahedron_count; t++) small.young_modulus[t] *= 2;
  sbfi_linear_statics_refresh(&linear);
  sbfi_linear_statics_solve(&linear, forces, 1e-7, after);
  ck_assert_double_eq_tol(after[tip] / before[tip], 0.5, 1e-9);
  lattice_box_free(&small);
}
END_TEST

/* A point on one spring is free to swing: it stays near, and keeps no other from its place. */
START_TEST(a_point_on_one_spring)
{
  static const sbf_vec3 at[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  static const sbf_uint2 ends[2] = {{{0, 1}}, {{1, 2}}};
  static const float stiffness[2] = {100, 100}, weights[3] = {0, 1, 1};
  sbf_spring_network pendulum = {.point_count = 3,
      .spring_count = 2,
      .positions = at,
      .masses = weights,
      .ends = ends,
      .stiffness = stiffness};
  sbfi_linear_statics linear;
  double forces[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, moved[9] = {0};
  ck_assert(sbfi_linear_statics_make(&linear, &pendulum, &arena));
  sbfi_linear_statics_solve(&linear, forces, 1e-8, moved);
  ck_assert_double_gt(moved[7], 0);
  ck_assert_double_lt(moved[7], 1);
  ck_assert_double_eq_tol(moved[4], 0, 1e-12);
}
END_TEST

int main(void) {
  Suite *s = suite_create("linear_statics");
  TCase *c = tcase_create("linear_statics");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_bar_bends_in_few_steps);
  tcase_add_test(c, a_solution_is_a_start_for_the_next);
  tcase_add_test(c, half_the_modulus_gives_twice_as_much);
  tcase_add_test(c, a_small_bar_bends_at_once);
  tcase_add_test(c, a_small_unpinned_bar);
  tcase_add_test(c, a_small_bar_of_twice_the_modulus);
  tcase_add_test(c, a_point_on_one_spring);
  suite_add_tcase(s, c);
  return harness_run(s);
}
