#include "build/embed/tetrahedron_finder.h"

#include <math.h>

#include "build/geometry/triangle_tree.h"
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
      &finder, lattice.made.positions, lattice.made.at, lattice.made.count, 1000, &arena));
}
static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static double min_weight(uint32_t tetrahedron, sbf_vec3 at) {
  double weights[4];
  ck_assert(sbfi_tetrahedron_weigh(
      lattice.made.positions, lattice.made.at[tetrahedron].at, sbfi_d3_of(at), weights));
  ck_assert_double_eq_tol(weights[0] + weights[1] + weights[2] + weights[3], 1, 1e-12);
  return fmin(fmin(weights[0], weights[1]), fmin(weights[2], weights[3]));
}

static double size_of_weights(uint32_t tetrahedron, sbf_vec3 at) {
  double weights[4], size = 0;
  ck_assert(sbfi_tetrahedron_weigh(
      lattice.made.positions, lattice.made.at[tetrahedron].at, sbfi_d3_of(at), weights));
  for (int k = 0; k < 4; k++) size += weights[k] * weights[k];
  return size;
}

/* Of a point outside, by all four sides. */
static double distance_from(uint32_t tetrahedron, sbf_vec3 at) {
  double corners[4][3], unused[3], min = INFINITY;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 p = lattice.made.positions[lattice.made.at[tetrahedron].at[k]];
    corners[k][0] = p.x, corners[k][1] = p.y, corners[k][2] = p.z;
  }
  for (int k = 0; k < 4; k++)
    min = fmin(min, sbfi_triangle_closest(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4],
                        (double[]){at.x, at.y, at.z}, unused));
  return sqrt(min);
}

START_TEST(points_inside_are_found_as_by_looking_at_all)
{
  for (int i = 0; i < 300; i++) {
    sbf_vec3 at = {
        -0.8f + 1.6f * (float)(i % 7) / 6, -0.8f + 1.6f * (float)(i % 11) / 10, -0.8f + (float)i / 200};
    sbfi_found_tetrahedron found = sbfi_tetrahedron_find(&finder, at);
    uint32_t first = 0;
    while (min_weight(first, at) < -1e-9) first++;
    ck_assert_uint_eq(found.tetrahedron, first);
    ck_assert_double_eq(found.distance, 0);
  }
}
END_TEST

/* Every place of the lattice lies within the cube, and comes near to each of its sides. */
START_TEST(points_outside_have_a_distance)
{
  for (int i = 0; i < 60; i++) {
    double away = 0.001 * pow(1.3, i);
    sbf_vec3 at = {(float)(1 + away), 0.21f - 0.01f * (float)i, 0.1f};
    sbfi_found_tetrahedron found = sbfi_tetrahedron_find(&finder, at);
    if (at.y > -0.3f) ck_assert_double_eq_tol(found.distance, away, 1e-5 + 1e-6 * away);
    double weight = min_weight(found.tetrahedron, at);
    ck_assert_double_lt(weight, 0);
    ck_assert_double_gt(weight, -6 * (away / 0.37 + 0.3));
  }
}
END_TEST

/* Near and far, inside and outside: precomputed values change no result. */
START_TEST(few_searches_find_as_much_as_many)
{
  sbfi_tetrahedron_finder few;
  ck_assert(sbfi_tetrahedron_finder_make(
      &few, lattice.made.positions, lattice.made.at, lattice.made.count, 0, &arena));
  ck_assert_ptr_null(few.solved);
  ck_assert_ptr_nonnull(finder.solved);
  for (int i = 0; i < 500; i++) {
    float out = 0.8f + 0.002f * (float)i;
    sbf_vec3 at = {out * (float)(i % 5 - 2) / 2, out * (float)(i % 7 - 3) / 3, out * (float)(i % 11 - 5) / 5};
    sbfi_found_tetrahedron a = sbfi_tetrahedron_find(&finder, at), b = sbfi_tetrahedron_find(&few, at);
    ck_assert_uint_eq(a.tetrahedron, b.tetrahedron);
    ck_assert_double_eq(a.distance, b.distance);
  }
}
END_TEST

/* Of points outside too, compared with a search of all: none is nearer, and none at almost the same distance
 * has smaller weights. */
START_TEST(points_outside_have_the_smallest_weights)
{
  for (int i = 0; i < 300; i++) {
    float out = 1.01f + 0.004f * (float)i;
    sbf_vec3 at = {out * (float)(i % 5 - 2) / 2, out * (float)(i % 3 - 1), out};
    sbfi_found_tetrahedron found = sbfi_tetrahedron_find(&finder, at);
    double min = INFINITY;
    for (uint32_t t = 0; t < lattice.made.count; t++) min = fmin(min, distance_from(t, at));
    ck_assert_double_eq_tol(found.distance, min, 1e-9);
    ck_assert_double_le(distance_from(found.tetrahedron, at), min + finder.radius / 2 + 1e-9);
    for (uint32_t t = 0; t < lattice.made.count; t++)
      if (distance_from(t, at) < min + finder.radius / 2 - 1e-9)
        ck_assert_double_ge(size_of_weights(t, at), size_of_weights(found.tetrahedron, at) - 1e-9);
  }
}
END_TEST

START_TEST(one_alone)
{
  const sbf_vec3 points[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const sbf_uint4 one = {{0, 1, 2, 3}};
  ck_assert(sbfi_tetrahedron_finder_make(&finder, points, &one, 1, 2, &arena));
  ck_assert_double_eq_tol(sbfi_tetrahedron_find(&finder, (sbf_vec3){-300, 0.1f, 0.1f}).distance, 300, 1e-6);
  ck_assert_double_eq(sbfi_tetrahedron_find(&finder, (sbf_vec3){0.1f, 0.1f, 0.1f}).distance, 0);
}
END_TEST

int main(void) {
  Suite *s = suite_create("tetrahedron_finder");
  TCase *c = tcase_create("tetrahedron_finder");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, points_inside_are_found_as_by_looking_at_all);
  tcase_add_test(c, points_outside_have_a_distance);
  tcase_add_test(c, few_searches_find_as_much_as_many);
  tcase_add_test(c, points_outside_have_the_smallest_weights);
  tcase_add_test(c, one_alone);
  suite_add_tcase(s, c);
  return harness_run(s);
}
