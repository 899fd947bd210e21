#include <math.h>
#include <string.h>

#include "conversions.h"

static sbf_vec3 axis_of(sbf_quat q, int axis) {
  const double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
  const double axes[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
      {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
      {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  return (sbf_vec3){(float)axes[axis][0], (float)axes[axis][1], (float)axes[axis][2]};
}

/* Columns of a turn into the node's 3 x 3, times a scale. */
static void turn(sbfi_matrix *m, double scale, const double x[3], const double y[3], const double z[3]) {
  for (int r = 0; r < 3; r++) {
    m->at[r][0] = scale * x[r];
    m->at[r][1] = scale * y[r];
    m->at[r][2] = scale * z[r];
  }
}

/* Nodes that are no bones leave their transforms, in centimetres here, and no bone. */
START_TEST(nodes_between_bones_are_baked_in)
{
  sbfi_scene scene;
  scene_begin(&scene);
  scene.unit_m = 0.01;
  int32_t root = scene_node(&scene, "armature", SBF_NONE, false, 0, 100, 0);
  int32_t hips = scene_node(&scene, "hips", root, true, 0, 0, 0);
  int32_t group = scene_node(&scene, "group", hips, false, 10, 0, 0);
  scene_node(&scene, "thigh", group, true, 0, -50, 0);
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_uint_eq(c.asset->bones.count, 2);
  ck_assert_str_eq(c.asset->bones.at[0].name, "hips");
  ck_assert_int_eq(c.asset->bones.at[0].parent, SBF_NONE);
  ck_assert_int_eq(c.asset->bones.at[1].parent, 0);
  check_near(c.asset->bones.at[0].head, 0, 1, 0, 1e-6);
  check_near(c.asset->bones.at[1].head, 0.1, 0.5, 0, 1e-6);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_NO_MESH), 1);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(the_caller_overrides_unit_and_axes)
{
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t root = scene_node(&scene, "root", SBF_NONE, true, 1, 2, 3);
  scene_node(&scene, "tip", root, true, 0, 1, 0);
  scene_end(&scene);
  converted c;
  sbf_convert_options options = {.unit_m = 0.5, .up = 'z', .no_gait = true};
  converted_scene(&c, &scene, &scene, &options);
  check_near(c.asset->bones.at[0].head, 0.5, 1.5, -1, 1e-6);
  converted_free(&c);
  /* What a rig states of itself stands where the mesh is another file. */
  sbfi_scene meshes;
  scene_begin(&meshes);
  scene_box(&meshes, scene_node(&meshes, "root", SBF_NONE, false, 2, 4, 6), 0.5, 0, 0, 0, false);
  scene_box(&meshes, scene_node(&meshes, "tip", SBF_NONE, false, 2, 6, 6), 0.5, 0, 0, 0, false);
  scene_end(&meshes);
  converted_scene(&c, &meshes, &scene, &options);
  check_near(c.asset->bones.at[0].head, 1, 2, 3, 1e-6);
  check_near(c.asset->soft_bodies.at[0].surface.positions.at[0], 0.75, 2.75, -1.75, 1e-6);
  converted_free(&c);
  sbfi_scene_free(&meshes);
  sbfi_scene_free(&scene);
}
END_TEST

/* A file whose bones run along their own Y keeps its rotations, even where one does not. */
START_TEST(frames_along_y_are_kept)
{
  static const double x[3] = {0, 1, 0}, y[3] = {-1, 0, 0}, z[3] = {0, 0, 1};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t a = scene_node(&scene, "a", SBF_NONE, true, 0, 0, 0);
  turn(scene_local(&scene, a), 2, x, y, z);
  int32_t b = scene_node(&scene, "b", a, true, 0, 1, 0);
  int32_t c3 = scene_node(&scene, "c", b, true, 0, 1.5, 0);
  scene_node(&scene, "side", c3, true, 1, 0, 0);
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  for (uint32_t i = 0; i < 4; i++) {
    check_near(axis_of(c.asset->bones.at[i].rotation, 1), -1, 0, 0, 1e-6);
    check_near(axis_of(c.asset->bones.at[i].rotation, 0), 0, 1, 0, 1e-6);
  }
  ck_assert_float_eq_tol(c.asset->bones.at[0].length, 2, 1e-6f);
  ck_assert_float_eq_tol(c.asset->bones.at[1].length, 3, 1e-6f);
  ck_assert_float_eq(c.asset->bones.at[2].length, 0); /* its child lies aside */
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Elsewhere bones run along any axis: theirs becomes Y, and X stays as near as it can. */
START_TEST(frames_are_laid_along_the_bones)
{
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t a = scene_node(&scene, "a", SBF_NONE, true, 0, 0, 0);
  int32_t b = scene_node(&scene, "b", a, true, 0, 0, 2);
  int32_t tip = scene_node(&scene, "tip", b, true, 0, 0, 1);
  scene_node(&scene, "a_side", a, true, 0.5, 0, 0);
  scene_end(&scene);
  (void)tip;
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  for (uint32_t i = 0; i < 3; i++) { /* the tip goes on as the bone before it */
    check_near(axis_of(c.asset->bones.at[i].rotation, 1), 0, 0, 1, 1e-6);
    check_near(axis_of(c.asset->bones.at[i].rotation, 0), 1, 0, 0, 1e-6);
  }
  ck_assert_float_eq_tol(c.asset->bones.at[0].length, 2, 1e-6f);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(a_mirrored_node_gives_a_proper_frame)
{
  static const double x[3] = {-1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t a = scene_node(&scene, "a", SBF_NONE, true, 0, 0, 0);
  turn(scene_local(&scene, a), 1, x, y, z);
  scene_node(&scene, "b", a, true, 0, 2, 0);
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  check_near(axis_of(c.asset->bones.at[0].rotation, 0), -1, 0, 0, 1e-6);
  check_near(axis_of(c.asset->bones.at[0].rotation, 1), 0, 1, 0, 1e-6);
  check_near(axis_of(c.asset->bones.at[0].rotation, 2), 0, 0, -1, 1e-6);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(last_bones_are_as_long_as_their_vertices)
{
  static const uint32_t all_first[8] = {0};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t a = scene_node(&scene, "a", SBF_NONE, true, 0, 0, 0);
  int32_t b = scene_node(&scene, "b", a, true, 0, 2, 0);
  int32_t other = scene_node(&scene, "other", a, true, 1, 0, 0);
  int32_t section = scene_node(&scene, "section", b, false, 0, 0, 0);
  int32_t skin = scene_node(&scene, "skin", SBF_NONE, false, 0, 0, 0);
  scene_box(&scene, section, 0.5, 0, 0.25, 0, false);
  scene_skin(&scene, scene_box(&scene, skin, 0.5, 1, 1, 0, false), 1, &other, all_first);
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_float_eq_tol(c.asset->bones.at[bone_named(c.asset, "b")].length, 0.75f, 1e-6f);
  ck_assert_float_eq_tol(c.asset->bones.at[bone_named(c.asset, "other")].length, 1.5f, 1e-6f);
  ck_assert_float_eq_tol(c.asset->bones.at[0].length, 2, 1e-6f);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_skeleton");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, nodes_between_bones_are_baked_in);
  tcase_add_test(tests, the_caller_overrides_unit_and_axes);
  tcase_add_test(tests, frames_along_y_are_kept);
  tcase_add_test(tests, frames_are_laid_along_the_bones);
  tcase_add_test(tests, a_mirrored_node_gives_a_proper_frame);
  tcase_add_test(tests, last_bones_are_as_long_as_their_vertices);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
