/* The pinned points of a lattice prevent rotation, at any resolution and in any number of pieces. */
#include "build/lattice/lattice_piece_pins.h"

#include <math.h>
#include <string.h>

#include "base/union_find.h"
#include "build/geometry/line_width.h"
#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbfi_arena arena;

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
}
static void teardown(void) {
  sbfi_arena_free(&arena);
}

/* ---- Points ---- */

START_TEST(lines_and_planes_are_distinguished)
{
  const sbf_vec3 at[] = {{1, 0, 0}, {0, 0, 0}, {4, 0, 0}, {3, 0, 0.5f}};
  const uint32_t list[] = {0, 1, 2, 3};
  sbfi_farthest_line line = sbfi_farthest_line_of(at, list, 3);
  ck_assert_double_eq_tol(line.length, 4, 1e-12);
  ck_assert_double_eq_tol(line.width, 0, 1e-12);
  ck_assert_double_eq_tol(sbfi_line_distance(&line, (sbf_vec3){9, 3, 4}), 5, 1e-12);
  ck_assert_double_gt(sbfi_farthest_line_of(at, list, 4).width, 0.49);
  line = sbfi_farthest_line_of(at, list, 1);
  ck_assert_double_eq(line.length, 0);
  ck_assert_double_eq_tol(sbfi_line_distance(&line, (sbf_vec3){1, 3, 4}), 5, 1e-12);
  ck_assert_double_eq(sbfi_farthest_line_of(at, list, 0).width, 0);
}
END_TEST

/* Two tetrahedra apart from each other, the second deeper at its last point. */
static const sbf_vec3 positions[] = {
    {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1.5f}};
static const sbf_uint4 corners[] = {{{0, 1, 2, 3}}, {{4, 5, 6, 7}}};
static const double depths2[] = {0, 0, 0, 0, 0, 0, 0, 0.01};

static uint32_t hold(const uint8_t *taken, double width, uint32_t *core, uint32_t count) {
  sbf_level level;
  sbf_level_init(&level);
  level.positions = (sbf_vec3_list){positions, 8};
  level.lattice.tetrahedra = (sbf_uint4_list){corners, 2};
  ck_assert(sbfi_lattice_pin_pieces(&level, depths2, taken, width, core, &count, &arena));
  return count;
}

START_TEST(each_piece_is_pinned_at_three_points)
{
  static const uint8_t taken[8] = {0};
  uint32_t core[8] = {0, 1};
  const uint32_t expected[] = {
      0, 1, 2, 4, 5, 7}; /* of 2 and 3, and 5 and 6, as near, the first; 7 is deepest */
  ck_assert_uint_eq(hold(taken, 0.25, core, 2), 6);
  ck_assert_mem_eq(core, expected, sizeof expected);
}
END_TEST

START_TEST(points_pinned_by_others_are_skipped)
{
  static const uint8_t taken[8] = {0, 0, 1, 0, 1, 1, 1, 1};
  uint32_t core[8] = {0, 1};
  ck_assert_uint_eq(hold(taken, 0.25, core, 2), 3);
  ck_assert_uint_eq(core[2], 3);
}
END_TEST

START_TEST(small_pieces_get_no_more_pins)
{
  static const uint8_t taken[8] = {0};
  uint32_t core[8] = {0, 1};
  ck_assert_uint_eq(hold(taken, 10, core, 2), 3); /* of the second piece its deepest alone */
}
END_TEST

/* ---- The example ---- */

/* Of every piece of the lattice; points in no tetrahedron are no piece of it. */
static void check_held(const sbf_level *level, const char *name) {
  uint32_t points = level->positions.count;
  uint32_t *parents = sbfi_arena_allocate(&arena, points, sizeof *parents);
  uint32_t *list = sbfi_arena_allocate(&arena, points, sizeof *list);
  uint8_t *pinned = sbfi_arena_allocate(&arena, points, 1), *used = sbfi_arena_allocate(&arena, points, 1);
  sbf_level_pinned_points(level, pinned);
  sbfi_sets_begin(parents, points);
  for (uint32_t t = 0; t < level->lattice.tetrahedra.count; t++)
    for (int k = 0; k < 4; k++) {
      used[level->lattice.tetrahedra.at[t].at[k]] = 1;
      sbfi_sets_join(parents, level->lattice.tetrahedra.at[t].at[0], level->lattice.tetrahedra.at[t].at[k]);
    }
  for (uint32_t root = 0; root < points; root++) {
    uint32_t count = 0;
    if (parents[root] != root || !used[root]) continue;
    for (uint32_t i = 0; i < points; i++)
      if (pinned[i] && sbfi_set_root(parents, i) == root) list[count++] = i;
    double width = sbfi_farthest_line_of(level->positions.at, list, count).width;
    ck_assert_msg(width >= 0.249 * (double)level->cell, "%s: %u tetrahedra, %u points hold %g cells", name,
        level->lattice.tetrahedra.count, count, width / (double)level->cell);
  }
}

static int unsettled;
static void note(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  unsettled += diagnostic->code == SBF_CODE_LEVEL_UNSETTLED;
}

static sbf_asset *build(uint32_t elements, uint32_t levels, bool calibrate) {
  sbf_asset *lizard = sbf_asset_create(NULL), *built;
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA,
      .elements = elements,
      .levels = levels,
      .without_calibration = !calibrate,
      .report = note};
  unsettled = 0;
  shape_sections_of_obj(lizard, harness_source("examples/lizard/lizard.obj"));
  ck_assert_int_eq(sbf_build(lizard, &options, &built, NULL, NULL), SBF_OK);
  sbf_asset_free(lizard);
  return built;
}

/* At 60 elements the trunk's sections had one or two points, at 1000 the separate toe of each foot had
 * one. */
START_TEST(no_section_of_the_lizard_rotates_about_its_pins)
{
  static const uint32_t elements[] = {20, 60, 1000};
  sbf_asset *built = build(elements[_i], 1, false);
  ck_assert_uint_gt(built->soft_bodies.count, 20);
  for (uint32_t b = 0; b < built->soft_bodies.count; b++)
    for (uint32_t l = 0; l < built->soft_bodies.at[b].levels.count; l++)
      check_held(&built->soft_bodies.at[b].levels.at[l], built->soft_bodies.at[b].name);
  sbf_asset_free(built);
}
END_TEST

/* They were 10^11 m and more. */
START_TEST(every_error_is_less_than_an_eighth_of_its_section)
{
  sbf_asset *built = build(60, 2, true);
  ck_assert_int_eq(unsettled, 0);
  for (uint32_t b = 0; b < built->soft_bodies.count; b++) {
    const sbf_soft_body *body = &built->soft_bodies.at[b];
    const sbf_vec3_list *at = &body->surface.positions;
    double longest = 0;
    for (uint32_t i = 1; i < at->count; i++) {
      double x = (double)at->at[i].x - at->at[0].x, y = (double)at->at[i].y - at->at[0].y,
             z = (double)at->at[i].z - at->at[0].z;
      longest = fmax(longest, sqrt(x * x + y * y + z * z));
    }
    for (uint32_t l = 0; l < body->levels.count; l++) {
      ck_assert_float_gt(body->levels.at[l].simulation.error, 0);
      ck_assert_msg((double)body->levels.at[l].simulation.error < longest / 8, "%s, level %u: %g m",
          body->name, l, (double)body->levels.at[l].simulation.error);
    }
  }
  sbf_asset_free(built);
}
END_TEST

int main(void) {
  Suite *s = suite_create("lattice_hold");
  TCase *c = tcase_create("lattice_hold");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, lines_and_planes_are_distinguished);
  tcase_add_test(c, each_piece_is_pinned_at_three_points);
  tcase_add_test(c, points_pinned_by_others_are_skipped);
  tcase_add_test(c, small_pieces_get_no_more_pins);
  tcase_add_loop_test(c, no_section_of_the_lizard_rotates_about_its_pins, 0, 3);
  tcase_add_loop_test(c, every_error_is_less_than_an_eighth_of_its_section, 0, HARNESS_FEW(1, 0));
  suite_add_tcase(s, c);
  return harness_run(s);
}
