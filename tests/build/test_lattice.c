#include "build/lattice/lattice.h"

#include <math.h>

#include "harness.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;
static const sbfi_progress silent = {NULL, NULL, 0, 1};

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
}
static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

typedef struct made {
  sbfi_soup soup;
  sbfi_winding winding;
  sbfi_lattice lattice;
  sbf_lattice_measures quality;
} made;

static void wind(made *m, const sbf_polygon_mesh *mesh) {
  ck_assert(sbfi_soup_make(&m->soup, mesh, &arena));
  ck_assert(sbfi_winding_make(&m->winding, &m->soup, &arena));
}

static void check(made *m) {
  const sbfi_tetrahedra *all = &m->lattice.made;
  sbf_lattice_measure(all->positions, all->at, all->count, &m->quality);
  ck_assert_uint_eq(all->flat_count, 0);
  ck_assert_double_ge(m->quality.min_dihedral_deg, 10);
  ck_assert_double_le(m->quality.max_dihedral_deg, 165);
}

static void stuff(made *m, const sbf_polygon_mesh *mesh, double cell) {
  wind(m, mesh);
  ck_assert_int_eq(sbfi_lattice_make(&m->lattice, &m->winding, cell, silent, &arena), SBFI_LATTICE_MADE);
  check(m);
}

START_TEST(a_cube_of_whole_cells_is_reproduced_exactly)
{
  sbf_polygon_mesh cube = shape_cube(asset, 2, 0.6f, (sbf_vec3){0.1f, 2, -3});
  for (int n = 2; n < 7; n++) {
    made m;
    stuff(&m, &cube, 0.6 / n);
    ck_assert_double_eq_tol(m.quality.volume, 0.216, 1e-6);
    ck_assert_double_ge(m.quality.min_dihedral_deg, 44.9);
    /* A middle and a side's corners for each of a cube's inner and half outer pyramids. */
    ck_assert_uint_eq(m.lattice.made.count, (uint32_t)(12 * n * n * n + 4 * 3 * n * n));
  }
}
END_TEST

static sbf_polygon_mesh make_ball(uint32_t n, float radius) {
  sbf_polygon_mesh ball = shape_cube(asset, n, 2, (sbf_vec3){0, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)ball.positions.at;
  for (uint32_t i = 0; i < ball.positions.count; i++) {
    float scale = radius / sqrtf(at[i].x * at[i].x + at[i].y * at[i].y + at[i].z * at[i].z);
    at[i] = (sbf_vec3){at[i].x * scale, at[i].y * scale, at[i].z * scale};
  }
  return ball;
}

/* The volume's error goes with the square of the cell; 0.25 h^2/r^2 is what curvature alone would cost. */
START_TEST(a_ball_is_approximated_within_the_square_of_the_cell)
{
  sbf_polygon_mesh ball = make_ball(24, 0.5f);
  sbf_surface_measures surface;
  sbf_surface_measure(&ball, NULL, &surface);
  for (double cell = 0.2; cell > 0.03; cell /= 1.7) {
    made m;
    stuff(&m, &ball, cell);
    double error = 1 - m.quality.volume / surface.volume;
    ck_assert_double_ge(error, 0);
    ck_assert_double_le(error, 1.2 * cell * cell / 0.25);
  }
}
END_TEST

START_TEST(a_tilted_cube_is_approximated_within_the_square_of_the_cell)
{
  sbf_polygon_mesh cube = shape_cube(asset, 3, 1, (sbf_vec3){0, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)cube.positions.at;
  for (uint32_t i = 0; i < cube.positions.count; i++) {
    sbf_vec3 p = at[i];
    at[i] = (sbf_vec3){0.6f * p.x - 0.8f * p.y, 0.8f * 0.8f * p.x + 0.6f * 0.8f * p.y - 0.6f * p.z,
        0.6f * 0.8f * p.x + 0.6f * 0.6f * p.y + 0.8f * p.z};
  }
  for (double cell = 0.2; cell > 0.04; cell /= 1.9) {
    made m;
    stuff(&m, &cube, cell);
    ck_assert_double_le(m.quality.volume, 1 + 1e-6);
    ck_assert_double_ge(m.quality.volume, 1 - 2.5 * cell * cell);
  }
}
END_TEST

START_TEST(the_requested_count)
{
  sbf_polygon_mesh ball = make_ball(8, 3);
  static const uint32_t wanted[] = {300, 2000, 40000};
  for (int i = 0; i < 3; i++) {
    made m;
    wind(&m, &ball);
    ck_assert_int_eq(
        sbfi_lattice_make_count(&m.lattice, &m.winding, wanted[i], SBFI_LATTICE_TOLERANCE, silent, &arena),
        SBFI_LATTICE_MADE);
    check(&m);
    ck_assert_uint_ge(m.lattice.made.count, wanted[i] * 85 / 100);
    ck_assert_uint_le(m.lattice.made.count, wanted[i] * 115 / 100);
  }
}
END_TEST

START_TEST(an_empty_interior_makes_no_lattice)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 4, 4), none;
  sbf_polygon_mesh_init(&none);
  made m;
  stuff(&m, &sheet, 0.3);
  ck_assert_uint_eq(m.lattice.made.count, 0);
  stuff(&m, &none, 0.3);
  ck_assert_uint_eq(m.lattice.made.count, 0);
  sbf_polygon_mesh cube = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0});
  wind(&m, &cube);
  ck_assert_int_eq(sbfi_lattice_make(&m.lattice, &m.winding, 1e-4, silent, &arena), SBFI_LATTICE_TOO_FINE);
  stuff(&m, &cube, 1e6); /* no point but its own middle is inside a cube of this size */
}
END_TEST

/* Real surfaces, and the expected volume of their lattice of 20,000: for closed ones their own, within the
 * error of curvature, for the others an estimate by eye. */
static const struct {
  const char *name;
  double volume, tolerance;
} real[] = {
    {"spot/spot.obj", 0.718259, 0.02},
    {"bunny/bunny_902.obj", 0.832353, 0.03},
    {"armadillo/armadillo_25k.obj", 237.773, 0.03},
    {"soup/suzanne.obj", 2.2, 0.1},
    {"soup/spider.obj", 136000, 0.09},
    {"bunny/bunny_holes.obj", 0.00075, 0.04},
};

START_TEST(real_surfaces)
{
  made m;
  const char *path = harness_shared(real[_i].name);
  if (!path) return;
  sbf_polygon_mesh mesh = shape_of_obj(asset, path);
  wind(&m, &mesh);
  ck_assert_int_eq(
      sbfi_lattice_make_count(&m.lattice, &m.winding, 20000, SBFI_LATTICE_TOLERANCE, silent, &arena),
      SBFI_LATTICE_MADE);
  check(&m);
  ck_assert_uint_ge(m.lattice.made.count, 19000);
  ck_assert_uint_le(m.lattice.made.count, 21000);
  ck_assert_double_eq_tol(m.quality.volume / real[_i].volume, 1, real[_i].tolerance);
}
END_TEST

static bool stop_at(void *user, double done) {
  int *left = user;
  ck_assert(done >= 0 && done <= 1);
  return --*left >= 0;
}

START_TEST(it_can_be_cancelled)
{
  sbf_polygon_mesh cube = shape_cube(asset, 2, 1, (sbf_vec3){0, 0, 0});
  made m;
  wind(&m, &cube);
  for (int allowed = 0;; allowed++) {
    int left = allowed;
    sbfi_progress progress = sbfi_progress_whole(stop_at, &left);
    if (sbfi_lattice_make_count(&m.lattice, &m.winding, 200, SBFI_LATTICE_TOLERANCE, progress, &arena) ==
        SBFI_LATTICE_MADE) {
      ck_assert_int_ge(allowed, 5);
      break;
    }
  }
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  sbf_polygon_mesh cube = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0});
  made m;
  wind(&m, &cube);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena small;
    sbfi_arena_init(&small, &memory.allocator, 0);
    sbfi_lattice_outcome outcome = sbfi_lattice_make(&m.lattice, &m.winding, 0.4, silent, &small);
    sbfi_arena_free(&small);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (outcome == SBFI_LATTICE_MADE) break;
    ck_assert_int_eq(outcome, SBFI_LATTICE_NO_MEMORY);
    ck_assert_uint_lt(allowed, 200);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("lattice");
  TCase *c = tcase_create("lattice");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_cube_of_whole_cells_is_reproduced_exactly);
  tcase_add_test(c, a_ball_is_approximated_within_the_square_of_the_cell);
  tcase_add_test(c, a_tilted_cube_is_approximated_within_the_square_of_the_cell);
  tcase_add_test(c, the_requested_count);
  tcase_add_test(c, an_empty_interior_makes_no_lattice);
  tcase_add_loop_test(c, real_surfaces, 0, (int)(sizeof real / sizeof *real));
  tcase_add_test(c, it_can_be_cancelled);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return harness_run(s);
}
