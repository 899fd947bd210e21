#include "build/sections/level_pins.h"

#include <string.h>

#include "build/geometry/hulls.h"
#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena scratch;
static sbf_soft_body *body;
static sbf_level level;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&scratch, NULL, 0);
  sbf_polygon_mesh cube = shape_cube(asset, 2, 2, (sbf_vec3){0, 0, 0});
  body = shape_add_body(asset, "cube", &cube, true);
  sbf_level_init(&level);
  level.positions = cube.positions;
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&scratch);
}

static const uint32_t points[] = {25, 3, 0};
static const float weights[] = {0.25f, 0.5f, 1};
static const sbf_vec3 offsets[] = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};

static sbf_pin_set some_pins(void) {
  sbf_pin_set pins;
  sbf_pin_set_init(&pins);
  pins.name = "some";
  pins.stiffness = 7;
  pins.points = (sbf_u32_list){points, 3};
  pins.weights = (sbf_f32_list){weights, 3};
  pins.offsets = (sbf_vec3_list){offsets, 3};
  return pins;
}

START_TEST(pins_of_the_body_are_transferred)
{
  sbf_pin_set pins = some_pins(), own;
  sbf_pin_set_init(&own);
  own.name = "own";
  body->pins = (sbf_pin_set_list){&pins, 1};
  level.pins = (sbf_pin_set_list){&own, 1};
  ck_assert(sbfi_level_pins_make(&level, body, 4, asset, NULL, 0, &scratch));
  ck_assert_uint_eq(level.pins.count, 2);
  ck_assert_str_eq(level.pins.at[0].name, "own");
  ck_assert_int_eq(level.pins.at[0].derived, SBF_NONE);
  const sbf_pin_set *taken = &level.pins.at[1];
  ck_assert_int_eq(taken->derived, 4);
  ck_assert_float_eq(taken->stiffness, 7);
  ck_assert_mem_eq(taken->points.at, points, sizeof points);
  ck_assert_mem_eq(taken->weights.at, weights, sizeof weights);
  ck_assert_mem_eq(taken->offsets.at, offsets, sizeof offsets);
}
END_TEST

START_TEST(points_follow_the_order_of_the_level)
{
  sbf_pin_set pins = some_pins();
  body->pins = (sbf_pin_set_list){&pins, 1};
  const uint32_t indices[] = {5, 6, 7, 900}; /* the level has no place for 3, nor for 25 */
  level.new_from_old = (sbf_u32_list){indices, 4};
  ck_assert(sbfi_level_pins_make(&level, body, 0, asset, NULL, 0, &scratch));
  const sbf_pin_set *taken = &level.pins.at[0];
  ck_assert_uint_eq(taken->points.count, 1);
  ck_assert_uint_eq(taken->points.at[0], 5);
  ck_assert_uint_eq(taken->weights.count, 1);
  ck_assert_float_eq(taken->weights.at[0], 1);
  ck_assert_float_eq(taken->offsets.at[0].x, 3);
}
END_TEST

START_TEST(attachments)
{
  /* A hull around the cube's left face, x = -1: nine points, one of them held already. */
  sbf_polygon_mesh box = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0}), hull;
  sbf_vec3 moved[8];
  for (int i = 0; i < 8; i++)
    moved[i] = (sbf_vec3){box.positions.at[i].x - 1, 3 * box.positions.at[i].y, 3 * box.positions.at[i].z};
  ck_assert_int_eq(sbfi_hull_make(moved, 8, asset, &hull, &scratch), SBFI_HULL_MADE);
  sbf_rigid_body rigid[2];
  for (int i = 0; i < 2; i++) sbf_rigid_body_init(&rigid[i]);
  rigid[1].hull = &hull;
  asset->rigid_bodies = (sbf_rigid_body_list){rigid, 2};
  const uint32_t listed[] = {11, 12};
  sbf_attachment rules[3];
  for (int i = 0; i < 3; i++) sbf_attachment_init(&rules[i]);
  rules[0].rule = SBF_ATTACHMENT_RULE_INSIDE_HULL;
  rules[0].rigid_body = 1;
  rules[0].name = "left";
  rules[1].rule = SBF_ATTACHMENT_RULE_EXPLICIT;
  rules[1].rigid_body = 0;
  rules[1].points = (sbf_u32_list){listed, 2};
  rules[2].rule = SBF_ATTACHMENT_RULE_INSIDE_HULL;
  rules[2].rigid_body = 0; /* has no hull */
  body->attachments = (sbf_attachment_list){rules, 3};
  sbf_pin_set pins;
  sbf_pin_set_init(&pins);
  const uint32_t pinned[] = {0}; /* (-1, -1, -1) */
  pins.points = (sbf_u32_list){pinned, 1};
  body->pins = (sbf_pin_set_list){&pins, 1};
  ck_assert(sbfi_level_pins_make(&level, body, 0, asset, NULL, 0, &scratch));
  ck_assert_uint_eq(level.pins.count, 3);
  const sbf_pin_set *left = &level.pins.at[1];
  ck_assert_str_eq(left->name, "left");
  ck_assert_int_eq(left->rigid_body, 1);
  ck_assert_uint_eq(left->points.count, 8);
  for (uint32_t i = 0; i < 8; i++) {
    ck_assert_uint_ne(left->points.at[i], 0);
    ck_assert_float_eq(level.positions.at[left->points.at[i]].x, -1);
  }
  ck_assert_uint_eq(level.pins.at[2].points.count, 2);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("level_pins");
  TCase *c = tcase_create("level_pins");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, pins_of_the_body_are_transferred);
  tcase_add_test(c, points_follow_the_order_of_the_level);
  tcase_add_test(c, attachments);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
