#include <math.h>
#include <string.h>

#include "conversions.h"

/* A biped whose soles are at `sole`; with boots and a coat for it to wear. */
static void make_at(sbfi_scene *scene, double x, double sole, double z, bool legs) {
  scene_begin(scene);
  int32_t hips = scene_node(scene, "hips", SBF_NONE, true, x, sole + 1, z);
  int32_t coat = scene_node(scene, "coat", hips, false, 0, 0.5, 0);
  scene_box(scene, coat, 0.25, 0, 0, 0, false);
  for (int side = -1; legs && side <= 1; side += 2) {
    int32_t thigh = scene_node(scene, side > 0 ? "thigh.L" : "thigh.R", hips, true, 0.25 * side, 0, 0);
    int32_t shin = scene_node(scene, side > 0 ? "shin.L" : "shin.R", thigh, true, 0, -0.5, 0.0625);
    int32_t foot = scene_node(scene, side > 0 ? "foot.L" : "foot.R", shin, true, 0, -0.4375, -0.0625);
    scene_box(scene, scene_node(scene, side > 0 ? "boot.L" : "boot.R", foot, false, 0, 0, 0), 0.0625, 0, 0, 0,
        false);
  }
  scene_end(scene);
}

static void make(sbfi_scene *scene, double sole, bool legs) {
  make_at(scene, 0, sole, 0, legs);
}

START_TEST(walkers_are_moved_onto_the_ground)
{
  sbfi_scene scene;
  converted c;
  make(&scene, -0.75, true);
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  check_near(a->bones.at[0].head, 0, 1, 0, 1e-6);
  check_near(body_named(a, "coat")->surface.positions.at[0], -0.25, 1.25, -0.25, 1e-6);
  check_near(mesh_named(a, "boot.L")->mesh.positions.at[0], 0.1875, 0, -0.0625, 1e-6);
  ck_assert_uint_eq(a->gaits.count, 1);
  check_near(
      a->gaits.at[0].legs.at[0].home, a->gaits.at[0].legs.at[0].home.x > 0 ? 0.25 : -0.25, 0.0625, 0, 1e-6);
  ck_assert_float_eq_tol(a->gaits.at[0].legs.at[0].sole, 0.0625f, 1e-6f);
  ck_assert_float_gt(a->ik_chains.at[0].pole.y, 0.25f);
  ck_assert_float_gt(a->rigid_bodies.at[0].center.y, 1);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_GROUND), 1);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Where they were, their positions had been rounded already. */
START_TEST(a_mesh_too_far_from_the_origin_is_reported)
{
  const double far = _i < 3 ? 100 : 1e6, x = _i % 3 == 0 ? far : 0, y = _i % 3 == 1 ? far : 0;
  sbfi_scene scene;
  converted c;
  make_at(&scene, x, y, _i % 3 == 2 ? far : 0, true);
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_int_eq(converted_count(&c, SBF_CODE_IMPORT_FAR) > 0, _i >= 3);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* A sole that is a little off, as on a soft floor, is no reason to move a file's vertices. */
START_TEST(standing_characters_are_not_moved)
{
  sbfi_scene scene;
  converted c;
  make(&scene, -0.03125, true);
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_float_eq(c.asset->bones.at[0].head.y, 0.96875f);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_GROUND), 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(objects_that_do_not_walk_are_not_moved)
{
  sbfi_scene scene;
  converted c;
  make(&scene, 5, false);
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_float_eq(c.asset->bones.at[0].head.y, 6);
  converted_free(&c);
  sbfi_scene_free(&scene);
  sbf_convert_options options = {.no_gait = true};
  make(&scene, 5, true);
  converted_scene(&c, &scene, &scene, &options);
  ck_assert_float_eq(c.asset->bones.at[0].head.y, 6);
  ck_assert_uint_eq(c.asset->gaits.count, 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Clips are moved too, unless they already have the character on the ground. */
START_TEST(clips_move_with_the_skeleton)
{
  static const float times[2] = {0, 1};
  static const sbf_vec3 drawn[2] = {{0, 0.25f, 0}, {0, 0.5f, 1}}, recorded[2] = {{0, 1.125f, 0}, {0, 1, 1}};
  sbfi_scene scene;
  converted c;
  make(&scene, -0.75, true);
  for (int i = 0; i < 2; i++) {
    sbfi_scene_channel *channel = scene_clip(&scene, i ? "recorded" : "drawn", 1, 1);
    *channel = (sbfi_scene_channel){
        .node = 0, .position_count = 2, .position_times = times, .positions = i ? recorded : drawn};
  }
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_uint_eq(c.asset->clips.count, 2);
  const float *first = c.asset->clips.at[0].tracks.at[0].values.at;
  ck_assert_float_eq_tol(first[1], 1, 1e-6f);
  ck_assert_float_eq_tol(first[4], 1.25f, 1e-6f);
  const float *second = c.asset->clips.at[1].tracks.at[0].values.at;
  ck_assert_float_eq_tol(second[1], 1.125f, 1e-6f);
  ck_assert_float_eq_tol(second[5], 1, 1e-6f);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Legs are found about the rig's own middle. A small offset is no reason to move vertices. */
START_TEST(characters_beside_the_origin_are_moved_there)
{
  static const float times[2] = {0, 1};
  /* x, z, and z of the hips then: the middle of all bones is 1/32 m before them */
  static const double places[][3] = {
      {2, 0, 0}, {-0.5, 0, 0}, {2, -3, -0.03125}, {0, 3, -0.03125}, {40, 0.125, 0.125}};
  for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
    double x = places[i][0], z = places[i][1], moved = places[i][2];
    const sbf_vec3 path[2] = {{(float)x, 1, (float)z}, {(float)x, 1, (float)z + 0.5f}};
    sbfi_scene scene;
    converted c;
    make_at(&scene, x, 0, z, true);
    *scene_clip(&scene, "walk", 1, 1) =
        (sbfi_scene_channel){.node = 0, .position_count = 2, .position_times = times, .positions = path};
    converted_scene(&c, &scene, &scene, NULL);
    const sbf_asset *a = c.asset;
    check_near(a->bones.at[0].head, 0, 1, moved, 1e-5);
    check_near(body_named(a, "coat")->surface.positions.at[0], -0.25, 1.25, moved - 0.25, 1e-5);
    ck_assert_uint_eq(a->gaits.count, 1);
    ck_assert_uint_eq(a->gaits.at[0].legs.count, 2);
    for (int l = 0; l < 2; l++) ck_assert_float_eq_tol(fabsf(a->gaits.at[0].legs.at[l].home.x), 0.25f, 1e-5f);
    const float *first = a->clips.at[0].tracks.at[0].values.at;
    ck_assert_float_eq_tol(first[0], 0, 1e-5f);
    ck_assert_float_eq_tol(first[2], (float)moved, 1e-5f);
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_GROUND), 1);
    converted_free(&c);
    sbfi_scene_free(&scene);
  }
  sbfi_scene scene;
  converted c;
  make_at(&scene, 0.015625, 0, 0.125, true);
  converted_scene(&c, &scene, &scene, NULL);
  check_near(c.asset->bones.at[0].head, 0.015625, 1, 0.125, 0);
  ck_assert_uint_eq(c.asset->gaits.at[0].legs.count, 2);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_GROUND), 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Bones on one side of their root, and what shall have no gait. */
START_TEST(asymmetric_skeletons_are_not_moved)
{
  sbf_convert_options options = {.no_gait = true};
  sbfi_scene scene;
  converted c;
  scene_begin(&scene);
  int32_t pole = scene_node(&scene, "pole", SBF_NONE, true, 2, 0, 0);
  scene_box(&scene, scene_node(&scene, "cloth", pole, false, 0.5, 1, 0), 0.25, 0, 0, 0, false);
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_float_eq(c.asset->bones.at[0].head.x, 2);
  converted_free(&c);
  sbfi_scene_free(&scene);
  make_at(&scene, 2, 0, 0, true);
  converted_scene(&c, &scene, &scene, &options);
  ck_assert_float_eq(c.asset->bones.at[0].head.x, 2);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_GROUND), 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_ground");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, walkers_are_moved_onto_the_ground);
  tcase_add_test(tests, standing_characters_are_not_moved);
  tcase_add_loop_test(tests, a_mesh_too_far_from_the_origin_is_reported, 0, 6);
  tcase_add_test(tests, objects_that_do_not_walk_are_not_moved);
  tcase_add_test(tests, clips_move_with_the_skeleton);
  tcase_add_test(tests, characters_beside_the_origin_are_moved_there);
  tcase_add_test(tests, asymmetric_skeletons_are_not_moved);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
