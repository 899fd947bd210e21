#include "build/lattice/lattice_smooth.h"

#include <math.h>
#include <string.h>

#include "build/lattice/lattice.h"
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

static sbfi_lattice stuff(const sbf_polygon_mesh *mesh, double cell) {
  sbfi_soup soup;
  sbfi_winding winding;
  sbfi_lattice lattice;
  const sbfi_progress silent = {NULL, NULL, 0, 1};
  ck_assert(sbfi_soup_make(&soup, mesh, &arena) && sbfi_winding_make(&winding, &soup, &arena));
  ck_assert_int_eq(sbfi_lattice_make(&lattice, &winding, cell, silent, &arena), SBFI_LATTICE_MADE);
  return lattice;
}

/* A cube of one metre, turned so that the grid cuts it anyhow. */
static sbf_polygon_mesh cube_askew(void) {
  sbf_polygon_mesh cube = shape_cube(asset, 3, 1, (sbf_vec3){0, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)cube.positions.at;
  for (uint32_t i = 0; i < cube.positions.count; i++) {
    sbf_vec3 p = at[i];
    at[i] = (sbf_vec3){0.6f * p.x - 0.8f * p.y, 0.8f * 0.8f * p.x + 0.6f * 0.8f * p.y - 0.6f * p.z,
        0.6f * 0.8f * p.x + 0.6f * 0.6f * p.y + 0.8f * p.z};
  }
  return cube;
}

/* A coordinate of a place of the turned cube, turned back. */
static double along(sbf_vec3 p, int axis) {
  static const double ways[3][3] = {{0.6, 0.64, 0.48}, {-0.8, 0.48, 0.36}, {0, -0.6, 0.8}};
  return ways[axis][0] * p.x + ways[axis][1] * p.y + ways[axis][2] * p.z;
}

/* The fastest mode of matter of 1 Pa, 1 kg/m3 and Poisson's ratio 0.4. */
static double fastest(const sbfi_tetrahedra *of) {
  float *masses = sbfi_arena_allocate(&arena, of->point_count, sizeof *masses);
  float *moduli = sbfi_arena_allocate(&arena, of->count, sizeof *moduli);
  float *ratios = sbfi_arena_allocate(&arena, of->count, sizeof *ratios);
  double *scratch = sbfi_arena_allocate(&arena, 6 * (size_t)of->point_count, sizeof *scratch);
  ck_assert(masses && moduli && ratios && scratch);
  for (uint32_t t = 0; t < of->count; t++) {
    sbf_lattice_measures measures;
    sbf_lattice_measure(of->positions, &of->at[t], 1, &measures);
    for (int k = 0; k < 4; k++) masses[of->at[t].at[k]] += (float)measures.volume / 4;
    moduli[t] = 1, ratios[t] = 0.4f;
  }
  return sbf_network_highest(&(sbf_spring_network){.point_count = of->point_count,
                                 .positions = of->positions,
                                 .masses = masses,
                                 .tetrahedron_count = of->count,
                                 .tetrahedra = of->at,
                                 .young_modulus = moduli,
                                 .poisson_ratios = ratios},
      100, scratch);
}

static sbfi_tetrahedra copy_of(const sbfi_tetrahedra *from) {
  sbfi_tetrahedra copy = *from;
  copy.positions = sbfi_arena_copy(&arena, from->positions, from->point_count, sizeof *from->positions);
  ck_assert_ptr_nonnull(copy.positions);
  return copy;
}

START_TEST(a_cut_cube_swings_slower_and_keeps_its_shape)
{
  sbf_polygon_mesh cube = cube_askew();
  for (double cell = 0.2; cell > 0.07; cell /= 1.5) {
    sbfi_lattice lattice = stuff(&cube, cell);
    sbfi_tetrahedra smooth = copy_of(&lattice.made);
    sbfi_tetrahedra again = copy_of(&lattice.made);
    ck_assert(sbfi_lattice_smooth(&smooth, cell, NULL, &arena));
    ck_assert(sbfi_lattice_smooth(&again, cell, NULL, &arena));
    ck_assert_mem_eq(again.positions, smooth.positions, smooth.point_count * sizeof *smooth.positions);
    ck_assert_double_lt(fastest(&smooth), 0.9 * fastest(&lattice.made));
    sbf_lattice_measures before, after;
    sbf_lattice_measure(lattice.made.positions, smooth.at, smooth.count, &before);
    sbf_lattice_measure(smooth.positions, smooth.at, smooth.count, &after);
    ck_assert_uint_eq(after.inverted_count, 0);
    ck_assert_double_ge(after.least_dihedral_deg, fmin(12.8, before.least_dihedral_deg) - 0.1);
    ck_assert_double_le(after.most_dihedral_deg, fmax(160.1, before.most_dihedral_deg) + 0.1);
    ck_assert_double_eq_tol(after.volume / before.volume, 1, 0.25 * cell);
    for (uint32_t i = 0; i < smooth.point_count; i++) {
      sbf_vec3 p = smooth.positions[i], q = lattice.made.positions[i];
      double moved = sqrt(pow(p.x - q.x, 2) + pow(p.y - q.y, 2) + pow(p.z - q.z, 2));
      ck_assert_double_le(moved, 0.3501 * cell);
      for (int axis = 0; axis < 3; axis++) /* 0.03 off three planes is up to so much off one of them */
        ck_assert_double_le(fabs(along(p, axis)), fmax(0.5, fabs(along(q, axis))) + 0.052 * cell);
    }
  }
}
END_TEST

START_TEST(what_the_grid_meets_stays)
{
  sbf_polygon_mesh cube = shape_cube(asset, 2, 0.6f, (sbf_vec3){0.1f, 2, -3});
  sbfi_lattice lattice = stuff(&cube, 0.15);
  sbfi_tetrahedra smooth = copy_of(&lattice.made);
  ck_assert(sbfi_lattice_smooth(&smooth, 0.15, NULL, &arena));
  ck_assert_mem_eq(smooth.positions, lattice.made.positions, smooth.point_count * sizeof *smooth.positions);
}
END_TEST

START_TEST(nothing_is_smooth)
{
  sbfi_tetrahedra none = {.count = 0};
  ck_assert(sbfi_lattice_smooth(&none, 0.1, NULL, &arena));
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  sbf_polygon_mesh cube = cube_askew();
  sbfi_lattice lattice = stuff(&cube, 0.3);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena small;
    sbfi_tetrahedra smooth = copy_of(&lattice.made);
    sbfi_arena_init(&small, &memory.allocator, 0);
    bool good = sbfi_lattice_smooth(&smooth, 0.3, NULL, &small);
    sbfi_arena_free(&small);
    if (good) break;
    ck_assert_mem_eq(smooth.positions, lattice.made.positions, smooth.point_count * sizeof *smooth.positions);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("lattice_smooth");
  TCase *c = tcase_create("lattice_smooth");
  tcase_set_timeout(c, 60);
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_cut_cube_swings_slower_and_keeps_its_shape);
  tcase_add_test(c, what_the_grid_meets_stays);
  tcase_add_test(c, nothing_is_smooth);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return harness_run(s);
}
