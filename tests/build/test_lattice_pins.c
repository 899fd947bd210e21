/* Pins of a body at the points of any of its levels: authored lists, and all points inside a hull. */
#include "build/lattice/lattice_pins.h"

#include <math.h>
#include <string.h>

#include "build/geometry/hulls.h"
#include "harness.h"
#include "promises.h"
#include "sbfmt/build.h"
#include "shapes.h"

static sbf_asset *asset;
static sbf_soft_body *body;
static sbf_attachment rule;

static const float HULL_END = 0.42f; /* m, between two rings of the bar's points */

static bool is_inside(sbf_vec3 p) {
  return p.x <= HULL_END;
}
static bool is_on_surface(sbf_vec3 p) {
  return fabsf(fabsf(p.y) - 0.2f) < 1e-5f || fabsf(fabsf(p.z) - 0.2f) < 1e-5f || fabsf(p.x) < 1e-5f;
}

/* A bar along +X from the origin, 1.6 m long, and a rigid box around its first end. */
static void setup(void) {
  sbfi_arena scratch;
  asset = sbf_asset_create(NULL);
  sbf_polygon_mesh bar = shape_bar(asset, 8, 2, 1.6f, 0.4f);
  body = shape_add_body(asset, "bar", &bar, false);
  sbf_vec3 corners[8];
  for (int i = 0; i < 8; i++)
    corners[i] = (sbf_vec3){i & 1 ? HULL_END : -0.1f, i & 2 ? 0.3f : -0.3f, i & 4 ? 0.3f : -0.3f};
  sbf_rigid_body *rigid = sbf_asset_allocate(asset, 2, sizeof *rigid);
  sbf_polygon_mesh *hull = sbf_asset_allocate(asset, 1, sizeof *hull);
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert_int_eq(sbfi_hull_make(corners, 8, asset, hull, &scratch), SBFI_HULL_MADE);
  sbfi_arena_free(&scratch);
  for (int i = 0; i < 2; i++) sbf_rigid_body_init(&rigid[i]);
  rigid[0].id = "elsewhere";
  rigid[1].id = "clamp";
  rigid[1].hull = hull;
  asset->rigid_bodies = (sbf_rigid_body_list){rigid, 2};
  sbf_attachment_init(&rule);
  rule.name = "end";
  rule.rigid_body = 1;
  body->attachments = (sbf_attachment_list){&rule, 1};
}

static void teardown(void) {
  sbf_asset_free(asset);
}

static void attach_by_hull(void) {
  rule.rule = SBF_ATTACHMENT_RULE_INSIDE_HULL;
  rule.points = (sbf_u32_list){NULL, 0};
}

/* The same points of the surface as the hull has. */
static void attach_by_list(void) {
  uint32_t count = 0, *list = sbf_asset_allocate(asset, body->surface.positions.count, sizeof *list);
  for (uint32_t i = 0; i < body->surface.positions.count; i++)
    if (is_inside(body->surface.positions.at[i])) list[count++] = i;
  ck_assert_uint_eq(count, 3 * 8 + 1); /* three rings of eight, and the middle of the end */
  rule.rule = SBF_ATTACHMENT_RULE_EXPLICIT;
  rule.points = (sbf_u32_list){list, count};
}

static sbf_asset *build(sbf_build_interior interior) {
  sbf_asset *built;
  const sbf_build_options options = {.interior = interior, .cell_m = 0.1, .without_calibration = true};
  ck_assert_int_eq(sbf_build(asset, &options, &built, NULL, NULL), SBF_OK);
  ck_assert_promises_kept(built);
  return built;
}

/* Expects the pinned points of the level: all by the one set, to the clamp, kinematically, at their
 * positions. */
static uint32_t find_pinned(const sbf_level *level, uint8_t *pinned) {
  memset(pinned, 0, level->positions.count);
  ck_assert_uint_eq(level->pins.count, 1);
  const sbf_pin_set *set = &level->pins.at[0];
  ck_assert_str_eq(set->name, "end");
  ck_assert_int_eq(set->rigid_body, 1);
  ck_assert_int_eq(set->bone, SBF_NONE);
  ck_assert_int_eq(set->derived, 0);
  ck_assert_uint_eq(set->offsets.count, 0);
  ck_assert(set->weights.count == 0 || set->weights.at[0] == 1);
  for (uint32_t i = 0; i < set->points.count; i++) pinned[set->points.at[i]] = 1;
  return set->points.count;
}

static const sbf_build_interior interiors[] = {SBF_BUILD_INTERIOR_NONE, SBF_BUILD_INTERIOR_LATTICE,
    SBF_BUILD_INTERIOR_BRUTE, SBF_BUILD_INTERIOR_TETRAHEDRA};
enum { INTERIOR_COUNT = sizeof interiors / sizeof *interiors };

/* The hull takes every point inside it, those within the body too; the list the same ones of the surface. */
START_TEST(both_methods_pin_the_same_points)
{
  static uint8_t by_hull[20000], by_list[20000];
  attach_by_hull();
  sbf_asset *first = build(interiors[_i]);
  attach_by_list();
  sbf_asset *second = build(interiors[_i]);
  const sbf_level *level = &first->soft_bodies.at[0].levels.at[0];
  const sbf_level *other = &second->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_le(level->positions.count, sizeof by_hull);
  ck_assert_uint_eq(level->positions.count, other->positions.count);
  uint32_t hulls = find_pinned(level, by_hull), lists = find_pinned(other, by_list), within = 0;
  for (uint32_t i = 0; i < level->positions.count; i++) {
    sbf_vec3 p = level->positions.at[i];
    ck_assert_mem_eq(&p, &other->positions.at[i], sizeof p);
    ck_assert_msg(by_hull[i] == is_inside(p), "%g %g %g", (double)p.x, (double)p.y, (double)p.z);
    ck_assert_msg(
        by_list[i] == (is_inside(p) && is_on_surface(p)), "%g %g %g", (double)p.x, (double)p.y, (double)p.z);
    within += by_hull[i] && !by_list[i];
  }
  ck_assert_uint_ge(lists, 3 * 8 + 1);
  ck_assert_uint_eq(hulls, lists + within);
  bool filled = interiors[_i] == SBF_BUILD_INTERIOR_LATTICE || interiors[_i] == SBF_BUILD_INTERIOR_TETRAHEDRA;
  ck_assert_int_eq(within > 0, filled);
  sbf_asset_free(second);
  sbf_asset_free(first);
}
END_TEST

/* Authored pins are kept in any hull. */
START_TEST(pins_have_precedence_over_hulls)
{
  static const uint32_t points[] = {0, 1, 2, 3};
  sbf_pin_set pins;
  sbf_pin_set_init(&pins);
  pins.name = "mine";
  pins.points = (sbf_u32_list){points, 4};
  body->pins = (sbf_pin_set_list){&pins, 1};
  attach_by_hull();
  sbf_asset *built = build(interiors[_i]);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(level->pins.count, 2);
  const sbf_pin_set *mine = &level->pins.at[0], *hull = &level->pins.at[1];
  ck_assert_str_eq(mine->name, "mine");
  ck_assert_uint_ge(mine->points.count, 4);
  uint32_t inside = 0;
  for (uint32_t i = 0; i < level->positions.count; i++) inside += is_inside(level->positions.at[i]);
  ck_assert_uint_eq(mine->points.count + hull->points.count, inside);
  for (uint32_t i = 0; i < hull->points.count; i++)
    for (uint32_t k = 0; k < mine->points.count; k++)
      ck_assert_uint_ne(hull->points.at[i], mine->points.at[k]);
  sbf_asset_free(built);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("lattice_pins");
  TCase *c = tcase_create("lattice_pins");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_loop_test(c, both_methods_pin_the_same_points, 0, INTERIOR_COUNT);
  tcase_add_loop_test(c, pins_have_precedence_over_hulls, 0, INTERIOR_COUNT);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
