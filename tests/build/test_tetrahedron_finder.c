#include "build/embed/tetrahedron_finder.h"

#include <math.h>

#include "build/lattice/lattice.h"
#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;
static sbfi_lattice lattice;
static sbfi_tetrahedron_finder finder;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
  sbf_polygon_mesh cube = shape_cube(asset, 2, 2, (sbf_vec3){0, 0, 0});
  sbfi_soup soup;
  sbfi_winding winding;
  ck_assert(sbfi_soup_make(&soup, &cube, &arena));
  ck_assert(sbfi_winding_make(&winding, &soup, &arena));
  ck_assert_int_eq(
      sbfi_lattice_make(&lattice, &winding, 0.37, (sbfi_progress){0}, &arena), SBFI_LATTICE_MADE);
  ck_assert(sbfi_tetrahedron_finder_make(
      &finder, lattice.made.positions, lattice.made.at, lattice.made.count, &arena));
}
static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static double least_weight(uint32_t tetrahedron, sbf_vec3 at) {
  double weights[4];
  ck_assert(sbfi_tetrahedron_weigh(
      lattice.made.positions, lattice.made.at[tetrahedron].at, sbfi_d3_of(at), weights));
  ck_assert_double_eq_tol(weights[0] + weights[1] + weights[2] + weights[3], 1, 1e-12);
  return fmin(fmin(weights[0], weights[1]), fmin(weights[2], weights[3]));
}

START_TEST(points_inside_are_found_as_by_looking_at_all)
{
  for (int i = 0; i < 300; i++) {
    sbf_vec3 at = {
        -0.8f + 1.6f * (float)(i % 7) / 6, -0.8f + 1.6f * (float)(i % 11) / 10, -0.8f + (float)i / 200};
    sbfi_found_tetrahedron found = sbfi_tetrahedron_find(&finder, at);
    uint32_t first = 0;
    while (least_weight(first, at) < -1e-9) first++;
    ck_assert_uint_eq(found.tetrahedron, first);
    ck_assert_double_eq(found.distance, 0);
  }
}
END_TEST

/* Every place of the lattice lies within the cube, and comes near to each of its sides. */
START_TEST(points_outside_know_how_far)
{
  for (int i = 0; i < 60; i++) {
    double away = 0.001 * pow(1.3, i);
    sbf_vec3 at = {(float)(1 + away), 0.21f - 0.01f * (float)i, 0.1f};
    sbfi_found_tetrahedron found = sbfi_tetrahedron_find(&finder, at);
    if (at.y > -0.3f) ck_assert_double_eq_tol(found.distance, away, 1e-5 + 1e-6 * away);
    double weight = least_weight(found.tetrahedron, at);
    ck_assert_double_lt(weight, 0);
    ck_assert_double_gt(weight, -6 * (away / 0.37 + 0.3));
  }
}
END_TEST

START_TEST(one_alone)
{
  const sbf_vec3 points[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const sbf_uint4 one = {{0, 1, 2, 3}};
  ck_assert(sbfi_tetrahedron_finder_make(&finder, points, &one, 1, &arena));
  ck_assert_double_eq_tol(sbfi_tetrahedron_find(&finder, (sbf_vec3){-300, 0.1f, 0.1f}).distance, 300, 1e-6);
  ck_assert_double_eq(sbfi_tetrahedron_find(&finder, (sbf_vec3){0.1f, 0.1f, 0.1f}).distance, 0);
}
END_TEST

int main(void) {
  Suite *s = suite_create("tetrahedron_finder");
  TCase *c = tcase_create("tetrahedron_finder");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, points_inside_are_found_as_by_looking_at_all);
  tcase_add_test(c, points_outside_know_how_far);
  tcase_add_test(c, one_alone);
  suite_add_tcase(s, c);
  return harness_run(s);
}
