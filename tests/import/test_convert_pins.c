#include "import/convert/convert_pins.h"

#include <math.h>
#include <stdlib.h>

#include "conversions.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"

static sbfi_scene scene;
static sbfi_scene_mesh *box;
static float painted[8];
static sbfi_scene_group group = {"cloth pins", painted};

/* A box whose upper four points the bone "tip" has, the lower four "root"; a group that no bone has. */
static void setup(void) {
  scene_begin(&scene);
  int32_t root = scene_node(&scene, "root", SBF_NONE, true, 0, 0, 0);
  int32_t tip = scene_node(&scene, "tip", root, true, 0, 1, 0);
  box = scene_box(&scene, scene_node(&scene, "Cape", SBF_NONE, false, 0, 0, 0), 0.5, 0, 1, 0, false);
  const int32_t joints[] = {root, tip};
  uint32_t joint_of_point[8];
  for (uint32_t i = 0; i < 8; i++) {
    joint_of_point[i] = box->points[i].y > 1;
    painted[i] = i == 0 ? 1 : i == 1 ? 0.5f : 0;
  }
  scene_skin(&scene, box, 2, joints, joint_of_point);
  box->groups = &group;
  box->group_count = 1;
  scene_end(&scene);
}

static void teardown(void) {
  sbfi_scene_free(&scene);
}

START_TEST(weights_of_a_bone_pin_to_another)
{
  converted c;
  const sbf_convert_pin pin = {"tip", "root"};
  converted_scene(&c, &scene, &scene, &(sbf_convert_options){.pinning.pins = &pin, .pinning.pin_count = 1});
  const sbf_soft_body *body = body_named(c.asset, "Cape");
  ck_assert_int_eq(body->bone, SBF_NONE);
  ck_assert_uint_eq(body->pins.count, 1);
  const sbf_pin_set *set = &body->pins.at[0];
  ck_assert_str_eq(set->name, "tip");
  ck_assert_int_eq(set->bone, bone_named(c.asset, "root"));
  ck_assert_uint_eq(set->points.count, 4);
  ck_assert_uint_eq(set->weights.count, 0);
  for (uint32_t i = 0; i < 4; i++) ck_assert_float_gt(body->surface.positions.at[set->points.at[i]].y, 1);
  /* The skin moves with the body, whole: its weights say nothing any more. */
  sbf_asset *built;
  sbf_build_report report;
  const sbf_build_options springs = {.interior = SBF_BUILD_INTERIOR_CENTROID};
  ck_assert_int_eq(sbf_build(c.asset, &springs, &built, &report, NULL), SBF_OK);
  ck_assert_uint_eq(report.embedded_vertices, 8);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  bool carried = false;
  for (uint32_t i = 0; i < level->embeddings.count; i++)
    carried |= level->embeddings.at[i].render_mesh == 0 && level->embeddings.at[i].blends.count == 0;
  ck_assert(carried);
  uint8_t *pinned = calloc(level->positions.count, 1);
  ck_assert_uint_eq(sbf_level_pinned_points(level, pinned), 4);
  free(pinned);
  sbf_asset_free(built);
  converted_free(&c);
}
END_TEST

START_TEST(a_group_without_a_bone_pins_to_the_world)
{
  converted c;
  const sbf_convert_pin pins[] = {{"cloth pins", NULL}, {"root", NULL}};
  converted_scene(&c, &scene, &scene,
      &(sbf_convert_options){.pinning.pins = pins,
          .pinning.pin_count = 2,
          .pinning.goal_minimum = 0.4,
          .pinning.goal_maximum = 0.8,
          .pinning.goal_stiffness = 30});
  const sbf_pin_set_list *sets = &body_named(c.asset, "Cape")->pins;
  ck_assert_uint_eq(sets->count, 2);
  const sbf_pin_set *set = &sets->at[0];
  ck_assert_int_eq(set->bone, SBF_NONE);
  ck_assert_uint_eq(set->points.count, 2);
  ck_assert_float_eq(set->weights.at[0], 1);
  /* s/(1 - s) with s = w/2: a quarter over three quarters. */
  ck_assert_float_eq_tol(set->weights.at[1], 1.0f / 3, 1e-6f);
  ck_assert_float_eq_tol(set->minimum, 0.25f, 1e-6f);
  ck_assert_float_eq_tol(set->maximum, 2.0f / 3, 1e-6f);
  ck_assert_float_eq(set->stiffness, 30);
  ck_assert_int_eq(sets->at[1].bone, bone_named(c.asset, "root"));
  converted_free(&c);
}
END_TEST

/* The rule of Blender's soft bodies, whose goal springs have the constant ks at goal g and constant k. */
START_TEST(goal_weights_are_blenders)
{
  for (int i = 0; i <= 10; i++) {
    double goal = i / 10.0, s = goal * 0.5, ks = 1 / (1 - s) - 1;
    ck_assert_double_eq_tol(sbfi_goal_weight(goal), ks, 1e-6);
  }
}
END_TEST

START_TEST(level_pins_keep_weights)
{
  converted c;
  const sbf_convert_pin pin = {"cloth pins", ""};
  converted_scene(&c, &scene, &scene, &(sbf_convert_options){.pinning.pins = &pin, .pinning.pin_count = 1});
  for (int tetrahedra = 0; tetrahedra < 2; tetrahedra++) {
    sbf_asset *built;
    sbf_build_options options = {
        .interior = tetrahedra ? SBF_BUILD_INTERIOR_TETRAHEDRA : SBF_BUILD_INTERIOR_CENTROID, .cell_m = 0.25};
    ck_assert_int_eq(sbf_build(c.asset, &options, &built, NULL, NULL), SBF_OK);
    const sbf_pin_set *set = &built->soft_bodies.at[0].levels.at[0].pins.at[0];
    uint32_t fast = 0, goals = 0;
    ck_assert_uint_eq(set->weights.count, set->points.count);
    for (uint32_t i = 0; i < set->points.count; i++) {
      fast += set->weights.at[i] == 1;
      goals += fabsf(set->weights.at[i] - 1.0f / 3) < 1e-6f;
      ck_assert(set->weights.at[i] > 0.333f && set->weights.at[i] <= 1); /* between the two on their edge */
    }
    ck_assert_uint_gt(fast, 0);
    ck_assert_uint_gt(goals, 0);
    if (!tetrahedra) ck_assert_uint_eq(set->points.count, 2);
    sbf_asset_free(built);
  }
  converted_free(&c);
}
END_TEST

START_TEST(missing_parts_are_reported)
{
  const sbf_convert_pin wrong[] = {{"Tip", NULL}, {"tip", "hand"}};
  for (int i = 0; i < 2; i++) {
    sbf_asset *asset = NULL;
    sbf_diagnostic error;
    ck_assert_int_ne(
        sbfi_convert_scenes(&scene, &scene,
            &(sbf_convert_options){.pinning.pins = &wrong[i], .pinning.pin_count = 1}, &asset, &error),
        SBF_OK);
    ck_assert_int_eq(error.code, SBF_CODE_IMPORT_PIN_UNKNOWN);
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("convert_pins");
  TCase *c = tcase_create("convert_pins");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, weights_of_a_bone_pin_to_another);
  tcase_add_test(c, a_group_without_a_bone_pins_to_the_world);
  tcase_add_test(c, goal_weights_are_blenders);
  tcase_add_test(c, level_pins_keep_weights);
  tcase_add_test(c, missing_parts_are_reported);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
