#include <math.h>
#include <stdlib.h>

#include "build/geometry/winding_number.h"
#include "build/springs/spring_level.h"
#include "build/springs/springs.h"
#include "harness.h"
#include "sbfmt/mechanics.h"
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

static sbf_vec3 end_of(const sbf_polygon_mesh *mesh, const sbfi_lattice_interior *in, uint32_t point) {
  return point < mesh->positions.count ? mesh->positions.at[point]
                                       : in->points[point - mesh->positions.count];
}

/* The arm of a C is bent round: what joins its two ends straight leaves the body. */
static sbf_polygon_mesh make_c(void) {
  sbf_polygon_mesh mesh = shape_cube(asset, 12, 2, (sbf_vec3){0, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)mesh.positions.at;
  for (uint32_t i = 0; i < mesh.positions.count; i++) {
    float angle = 2.6f * at[i].x, radius = 1 + 0.25f * at[i].y;
    at[i] = (sbf_vec3){radius * cosf(angle), radius * sinf(angle), 0.3f * at[i].z};
  }
  return mesh;
}

START_TEST(no_spring_crosses_the_outside_of_a_concave_body)
{
  sbf_polygon_mesh mesh = make_c();
  sbfi_lattice_interior in;
  sbfi_soup soup;
  sbfi_winding winding;
  ck_assert(sbfi_springs_lattice(&in, &mesh, 0, 0.12, (sbfi_progress){0}, &arena));
  ck_assert(sbfi_soup_make(&soup, &mesh, &arena) && sbfi_winding_make(&winding, &soup, &arena));
  ck_assert_uint_gt(in.point_count, 100);
  ck_assert_uint_gt(in.internal.count, 4 * in.point_count);
  uint32_t *joined = calloc(mesh.positions.count, sizeof *joined);
  for (uint32_t s = 0; s < in.internal.count; s++) {
    sbfi_d3 a = sbfi_d3_of(end_of(&mesh, &in, in.internal.at[s].at[0]));
    sbfi_d3 b = sbfi_d3_of(end_of(&mesh, &in, in.internal.at[s].at[1]));
    for (int k = 1; k < 4; k++)
      ck_assert_int_ne(
          sbfi_winding_of_closed(&winding, sbfi_d3_add(a, sbfi_d3_scale(sbfi_d3_sub(b, a), k / 4.0))), 0);
    if (in.internal.at[s].at[1] < mesh.positions.count) joined[in.internal.at[s].at[1]]++;
  }
  for (uint32_t i = 0; i < mesh.positions.count; i++) ck_assert_uint_ge(joined[i], 1);
  free(joined);
}
END_TEST

START_TEST(a_default_cell_size_is_found)
{
  sbf_polygon_mesh cube = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0}), sheet = shape_sheet(asset, 3, 3);
  sbfi_lattice_interior in;
  ck_assert(sbfi_springs_lattice(&in, &cube, 0, 0, (sbfi_progress){0}, &arena));
  ck_assert_uint_ge(in.point_count, 1);
  ck_assert_uint_ge(in.deep_count, 1);
  ck_assert(sbfi_springs_lattice(&in, &sheet, 0, 0, (sbfi_progress){0}, &arena));
  ck_assert_uint_eq(in.point_count, 0);
}
END_TEST

/* Mean fall of a cube's free points under its weight. */
static double sag_of(sbfi_spring_interior interior, uint32_t n, double cell, uint32_t *springs) {
  sbf_polygon_mesh mesh = shape_cube(asset, n, 0.2f, (sbf_vec3){0.3f, 1, 0});
  sbf_soft_body *body = shape_add_body(asset, "cube", &mesh, true);
  body->attributes.young_modulus = 5e4f;
  sbfi_spring_recipe recipe = {.interior = interior, .cell = cell};
  sbfi_spring_counts counts;
  sbfi_interior_map map;
  sbf_level level;
  ck_assert(sbfi_spring_level_make(&level, body, &recipe, asset, &map, &counts, &arena));
  uint32_t points = level.positions.count, free_points = 0;
  uint8_t *pinned = sbfi_arena_allocate(&arena, points, 1);
  float *masses = sbfi_arena_allocate(&arena, points, sizeof *masses);
  double *forces = sbfi_arena_allocate(&arena, 3 * points, sizeof *forces), sum = 0;
  double *moved = sbfi_arena_allocate(&arena, 3 * points, sizeof *moved);
  double *work = sbfi_arena_allocate(&arena, 10 * points, sizeof *work);
  *springs = 0;
  for (uint32_t s = 0; s < level.springs.count; s++) *springs += level.springs.at[s].ends.count;
  sbf_uint2 *ends = sbfi_arena_allocate(&arena, *springs, sizeof *ends);
  float *stiffness = sbfi_arena_allocate(&arena, *springs, sizeof *stiffness);
  for (uint32_t s = 0, next = 0; s < level.springs.count; s++)
    for (uint32_t k = 0; k < level.springs.at[s].ends.count; k++) {
      ends[next] = level.springs.at[s].ends.at[k];
      stiffness[next++] = level.springs.at[s].stiffness.at[k];
    }
  sbf_level_pinned_points(&level, pinned);
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, pinned, masses), 8, 1e-3);
  sbf_spring_network network = {.point_count = points,
      .spring_count = *springs,
      .positions = level.positions.at,
      .masses = masses,
      .ends = ends,
      .stiffness = stiffness};
  for (uint32_t i = 0; i < points; i++) forces[3 * i + 1] = -9.81 * masses[i];
  ck_assert_double_lt(sbf_network_static(&network, forces, 1e-8, 5000, moved, work), 1e-4);
  for (uint32_t i = 0; i < points; i++) {
    if (!(masses[i] > 0)) continue;
    sum -= moved[3 * i + 1];
    free_points++;
  }
  return sum / free_points;
}

/* Pinned in its inner half, it sags by about as much as the centroid's cube pinned at its core. */
START_TEST(a_lattice_supports_its_weight)
{
  uint32_t few, many;
  double coarse = sag_of(SBFI_INTERIOR_LATTICE, 6, 0.04, &few);
  double fine = sag_of(SBFI_INTERIOR_LATTICE, 12, 0.02, &many);
  ck_assert_uint_gt(many, few);
  ck_assert_double_gt(coarse, 2e-4);
  ck_assert_double_lt(coarse, 6e-3);
  ck_assert_double_eq_tol(fine / coarse, 1, 0.4);
}
END_TEST

START_TEST(brute_joins_all)
{
  sbf_polygon_mesh cube = shape_cube(asset, 2, 1, (sbf_vec3){0, 0, 0});
  sbf_uint2 known[] = {{{0, 1}}, {{5, 3}}};
  sbfi_surface_springs surface = {.structural = {known, 2}};
  sbfi_spring_list list;
  ck_assert(sbfi_springs_brute(&list, cube.positions.count, &surface, &arena));
  ck_assert_uint_eq(list.count, 26 * 25 / 2 - 2);
  ck_assert_uint_eq(list.at[0].at[1], 2);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  sbf_polygon_mesh cube = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0});
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena small;
    sbfi_arena_init(&small, &memory.allocator, 0);
    sbfi_lattice_interior in;
    bool good = sbfi_springs_lattice(&in, &cube, 0, 0.3, (sbfi_progress){0}, &small);
    sbfi_arena_free(&small);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (good) break;
    ck_assert_uint_lt(allowed, 200);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("springs_lattice");
  TCase *c = tcase_create("springs_lattice");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, no_spring_crosses_the_outside_of_a_concave_body);
  tcase_add_test(c, a_default_cell_size_is_found);
  tcase_add_test(c, a_lattice_supports_its_weight);
  tcase_add_test(c, brute_joins_all);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return harness_run(s);
}
