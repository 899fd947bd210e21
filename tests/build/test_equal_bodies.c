#include "build/equal_bodies.h"

#include <stdio.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;
static uint32_t off_count;

static void setup(void) {
  asset = sbf_asset_create(NULL);
}
static void teardown(void) {
  sbf_asset_free(asset);
}

static sbf_soft_body *add_cube(const char *name, float side, sbf_vec3 centre) {
  sbf_polygon_mesh cube = shape_cube(asset, 3, side, centre);
  return shape_add_body(asset, name, &cube, false);
}

static uint32_t find(uint32_t number, sbfi_d3 *offset) {
  sbfi_arena arena;
  sbfi_equal_bodies all;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_equal_bodies_make(&all, asset->soft_bodies.at, asset->soft_bodies.count, &arena));
  for (uint32_t i = 0; i < number; i++) sbfi_equal_bodies_add(&all, i);
  uint32_t found = sbfi_equal_bodies_find(&all, number, offset);
  sbfi_arena_free(&arena);
  return found;
}

START_TEST(a_copy_elsewhere_is_found)
{
  sbfi_d3 offset;
  add_cube("other", 0.3f, (sbf_vec3){0, 1, 0});
  add_cube("a", 0.2f, (sbf_vec3){0, 1, 0});
  add_cube("b", 0.2f, (sbf_vec3){3, 0.5f, -2});
  ck_assert_uint_eq(find(2, &offset), 1);
  ck_assert_double_eq_tol(offset.x, 3, 1e-6);
  ck_assert_double_eq_tol(offset.y, -0.5, 1e-6);
  ck_assert_double_eq_tol(offset.z, -2, 1e-6);
}
END_TEST

enum { BONE = 4, PINS, CHANGES };

/* The properties by which one body differs from the other. */
static void change(sbf_soft_body *body, int what) {
  /* The surface is the asset's, made here. */
  sbf_vec3 *points = (sbf_vec3 *)(uintptr_t)body->surface.positions.at;
  uint32_t *corners = (uint32_t *)(uintptr_t)body->surface.polygon_points.at;
  if (what == 0) points[5].x += 0.001f;
  if (what == 1) body->attributes.poisson_ratio += 0.01f;
  if (what == 2) body->attributes.friction += 0.1f;
  if (what == 3) {
    uint32_t first = corners[0];
    corners[0] = corners[1], corners[1] = corners[2], corners[2] = corners[3], corners[3] = first;
  }
  if (what == BONE) body->bone = 0;
  if (what == PINS) {
    sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
    sbf_pin_set_init(pins);
    body->pins = (sbf_pin_set_list){pins, 1};
  }
}

START_TEST(different_bodies_are_not_equal)
{
  sbfi_d3 offset;
  add_cube("a", 0.2f, (sbf_vec3){0, 1, 0});
  change(add_cube("b", 0.2f, (sbf_vec3){3, 1, 0}), _i);
  ck_assert_uint_eq(find(1, &offset), UINT32_MAX);
}
END_TEST

/* Bones and pins hold at a position of their own. */
START_TEST(pinned_bodies_equal_no_other)
{
  sbfi_d3 offset;
  change(add_cube("a", 0.2f, (sbf_vec3){0, 1, 0}), _i);
  change(add_cube("b", 0.2f, (sbf_vec3){3, 1, 0}), _i);
  ck_assert_uint_eq(find(1, &offset), UINT32_MAX);
}
END_TEST

static void count_off(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  off_count += diagnostic->code == SBF_CODE_LEVEL_OFF;
}

/* One calibration for all equal bodies, one more for the different cube. */
START_TEST(copies_have_one_calibration)
{
  enum { BODIES = 12, OTHER = 7 };
  for (uint32_t i = 0; i < BODIES; i++) {
    char *name = sbf_asset_allocate(asset, 16, 1);
    snprintf(name, 16, "c%u", (unsigned)i);
    add_cube(name, i == OTHER ? 0.3f : 0.2f, (sbf_vec3){(float)i, 1, 0});
  }
  sbf_build_options options = {.elements = 40, .report = count_off};
  sbf_build_report report;
  sbf_asset *built = NULL;
  sbf_diagnostic error;
  off_count = 0;
  ck_assert_msg(sbf_build(asset, &options, &built, &report, &error) == SBF_OK, "%s", error.message);
  const sbf_level *first = &built->soft_bodies.at[0].levels.at[0];
  uint32_t tetrahedra = 0;
  for (uint32_t i = 0; i < BODIES; i++) {
    const sbf_level *level = &built->soft_bodies.at[i].levels.at[0];
    ck_assert_ptr_nonnull(level->calibration);
    ck_assert_uint_eq(level->embeddings.count, 1);
    tetrahedra += level->lattice.tetrahedra.count;
    ck_assert((level->calibration == first->calibration) == (i != OTHER));
    if (i == OTHER) continue;
    ck_assert_uint_eq(level->positions.count, first->positions.count);
    for (uint32_t p = 0; p < first->positions.count; p++) {
      ck_assert_float_eq_tol(level->positions.at[p].x, first->positions.at[p].x + (float)i, 2e-6f);
      ck_assert_float_eq(level->positions.at[p].y, first->positions.at[p].y);
    }
  }
  ck_assert_uint_eq(report.bodies, BODIES);
  ck_assert_uint_eq(report.lattice_calibration.count, BODIES);
  ck_assert_uint_eq(report.lattices.tetrahedra, tetrahedra);
  uint64_t angles = 0;
  for (int k = 0; k < SBF_DIHEDRAL_BINS; k++) angles += report.lattices.dihedrals[k];
  ck_assert_uint_eq(angles, 6 * (uint64_t)tetrahedra);
  /* Forty tetrahedra represent the cube poorly, which is reported for each of the equal bodies. */
  ck_assert_uint_eq(off_count, BODIES - 1);
  sbf_asset_free(built);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("equal bodies");
  TCase *c = tcase_create("equal bodies");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_copy_elsewhere_is_found);
  tcase_add_loop_test(c, different_bodies_are_not_equal, 0, CHANGES);
  tcase_add_loop_test(c, pinned_bodies_equal_no_other, BONE, CHANGES);
  tcase_add_test(c, copies_have_one_calibration);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
