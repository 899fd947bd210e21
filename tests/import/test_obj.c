#include "import/obj/obj.h"

#include <stdio.h>
#include <string.h>

#include "harness.h"
#include "scene_check.h"

static void read_text(sbfi_scene *scene, const char *bytes) {
  sbf_diagnostic error = {0};
  ck_assert(sbfi_scene_init(scene, NULL, 0, "model.obj"));
  sbf_status status = sbfi_obj_read(scene, bytes, strlen(bytes), NULL, &error);
  ck_assert_msg(status == SBF_OK, "line %u %s", error.line, error.message);
  const char *broken = scene_check(scene);
  ck_assert_msg(!broken, "%s", broken);
}

static void expect_sources(const sbfi_scene_mesh *mesh, const uint32_t *expected, uint32_t count) {
  ck_assert_uint_eq(mesh->point_count, count);
  for (uint32_t i = 0; i < count; i++) ck_assert_uint_eq(mesh->point_sources[i], expected[i]);
}

#define EXPECT_SOURCES(mesh, ...)                                                                            \
  expect_sources(mesh, (const uint32_t[]){__VA_ARGS__}, sizeof((uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t))

START_TEST(objects_divide_and_groups_do_not)
{
  sbfi_scene scene;
  read_text(
      &scene, "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng skin\nf 1 2 3\ng hair\nf 3 2 1\no b\nv 5 0 0\nf 4 1 2\n");
  ck_assert_uint_eq(scene.mesh_count, 2);
  ck_assert_str_eq(scene.meshes[0].name, "a");
  ck_assert_str_eq(scene.nodes[scene.meshes[1].node].name, "b");
  ck_assert_uint_eq(scene.meshes[0].polygon_count, 2);
  EXPECT_SOURCES(&scene.meshes[0], 0, 1, 2);
  EXPECT_SOURCES(&scene.meshes[1], 0, 1, 3);
  ck_assert_uint_eq(scene.meshes[1].corner_points[0], 2);
  ck_assert_float_eq(scene.meshes[1].points[2].x, 5);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(groups_divide_where_there_is_no_object)
{
  sbfi_scene scene;
  read_text(
      &scene, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng a\nf 1 3 2\ng b\nf 2 1 3\ng a\nf 3 2 1\ng empty\n");
  ck_assert_uint_eq(scene.mesh_count, 3);
  ck_assert_str_eq(scene.meshes[0].name, "model");
  ck_assert_str_eq(scene.meshes[1].name, "a");
  ck_assert_uint_eq(scene.meshes[1].polygon_count, 2);
  ck_assert_uint_eq(scene.meshes[1].corner_points[3], 2);
  sbfi_scene_free(&scene);
}
END_TEST

/* As Blender writes: an unused vertex stays among its neighbours, wherever in its object it stands. */
START_TEST(unused_vertices_are_kept_in_their_object)
{
  sbfi_scene scene;
  read_text(&scene, "o a\nv .5 .5 .5\nv 0 0 0\nv 1 0 0\nv .5 .5 .5\nv 0 1 0\nf 2 3 5\n"
                    "o b\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv .5 .5 .5\nf 6 7 8\n");
  EXPECT_SOURCES(&scene.meshes[0], 0, 1, 2, 3, 4);
  EXPECT_SOURCES(&scene.meshes[1], 5, 6, 7, 8);
  ck_assert_uint_eq(scene.warning_count, 0);
  sbfi_scene_free(&scene);
}
END_TEST

/* As Maya writes: the vertices stand before the line g of their group. */
START_TEST(unused_vertices_join_the_following_ones)
{
  sbfi_scene scene;
  read_text(&scene,
      "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\nf 1 2 3\nv .5 .5 .5\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng b\nf 5 6 7\n");
  EXPECT_SOURCES(&scene.meshes[0], 0, 1, 2);
  EXPECT_SOURCES(&scene.meshes[1], 3, 4, 5, 6);
  sbfi_scene_free(&scene);
}
END_TEST

/* They would pass for the size of the character. */
START_TEST(unused_vertices_far_from_all_others_are_left_out_and_reported)
{
  sbfi_scene scene;
  read_text(&scene, "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 0 0\nv 1.5 0 0\nf 1 2 3\n");
  EXPECT_SOURCES(&scene.meshes[0], 0, 1, 2, 4);
  ck_assert_uint_eq(scene.warning_count, 1);
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_POINTS_LEFT_OUT);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(vertices_without_an_object_are_left_out_and_reported)
{
  sbfi_scene scene;
  read_text(&scene, "o cloud\nv 9 9 9\nv 8 8 8\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 3 4 5\n");
  EXPECT_SOURCES(&scene.meshes[0], 2, 3, 4);
  ck_assert_uint_eq(scene.warning_count, 1);
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_POINTS_LEFT_OUT);
  ck_assert_str_eq(scene.warnings[0].file, "model.obj");
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(each_mesh_has_its_own_normals_and_uvs)
{
  sbfi_scene scene;
  read_text(&scene, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\nvn 0 0 -1\n"
                    "g a\nf 1/1/2 2/2/2 3/4/2\ng b\nf 3/3 2/2 1\ng c\nf 1 2 3\n");
  const sbfi_scene_mesh *a = &scene.meshes[0], *b = &scene.meshes[1], *c = &scene.meshes[2];
  ck_assert_uint_eq(a->normals.count, 1);
  ck_assert_float_eq(a->normals.at[0].z, -1);
  ck_assert_int_eq(a->normals.corner_index[2], 0);
  ck_assert_uint_eq(a->uv_sets[0].count, 3);
  ck_assert_int_eq(a->uv_sets[0].corner[2], 2);
  ck_assert_float_eq(a->uv_sets[0].at[2].x, 0.5f);
  ck_assert_ptr_null(b->normals.corner_index);
  ck_assert_uint_eq(b->uv_sets[0].count, 2);
  ck_assert_int_eq(b->uv_sets[0].corner[0], 1);
  ck_assert_int_eq(b->uv_sets[0].corner[2], SBF_NONE);
  ck_assert_uint_eq(c->uv_set_count, 0);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(materials_come_from_the_library_beside_the_file)
{
  const char mtl[] = "newmtl red\nKd 1 0 0\nnewmtl other\nKd 0 0 1\n";
  const char obj[] = "mtllib colours of mine.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\n"
                     "usemtl nowhere\nf 3 2 1\nusemtl red\nf 1 3 2\n";
  ck_assert(harness_write(harness_scratch("colours of mine.mtl"), mtl, sizeof mtl - 1));
  ck_assert(harness_write(harness_scratch("coloured.obj"), obj, sizeof obj - 1));
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  sbf_status status = sbfi_scene_read(&scene, harness_scratch("coloured.obj"), NULL, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  ck_assert_uint_eq(scene.material_count, 2);
  ck_assert_str_eq(scene.materials[0].name, "red");
  ck_assert_float_eq(scene.materials[0].base_color[1], 0);
  const int32_t expected[] = {SBF_NONE, 0, 1, 0};
  for (int i = 0; i < 4; i++) ck_assert_int_eq(scene.meshes[0].polygon_materials[i], expected[i]);
  ck_assert_uint_eq(scene.warning_count, 1);
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_MATERIALS_MISSING);
  ck_assert_ptr_nonnull(strstr(scene.warnings[0].message, "nowhere"));
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(a_missing_library_is_a_warning)
{
  sbfi_scene scene;
  read_text(&scene, "mtllib not there.mtl\nusemtl x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ck_assert_uint_eq(scene.warning_count, 1);
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_MATERIALS_MISSING);
  ck_assert_ptr_nonnull(strstr(scene.warnings[0].message, "\"not there.mtl\""));
  ck_assert_ptr_nonnull(strstr(scene.warnings[0].message, "put it beside"));
  ck_assert_uint_eq(scene.material_count, 1);
  sbfi_scene_free(&scene);
}
END_TEST

/* Names with blanks, in quotes, and several on a line; missing files are reported with their whole name. */
START_TEST(names_of_libraries_may_have_blanks)
{
  static const struct {
    const char *line, *missing;
  } cases[] = {{"mtllib \"two words.mtl\"", NULL}, {"mtllib   two words.mtl \t", NULL},
      {"mtllib blue.mtl two words.mtl", NULL}, {"mtllib two words.mtl blue.mtl", NULL},
      {"mtllib \"two words.mtl\" blue.mtl", NULL}, {"mtllib not here.mtl two words.mtl", "\"not here.mtl\""},
      {"mtllib two words.mtl not here.mtl", "\"not here.mtl\""}};
  const char red[] = "newmtl red\nKd 1 0 0\n", blue[] = "newmtl blue\nKd 0 0 1\n";
  ck_assert(harness_write(harness_scratch("two words.mtl"), red, sizeof red - 1));
  ck_assert(harness_write(harness_scratch("blue.mtl"), blue, sizeof blue - 1));
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char obj[160];
    int length =
        snprintf(obj, sizeof obj, "%s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n", cases[i].line);
    ck_assert(harness_write(harness_scratch("blanks.obj"), obj, (size_t)length));
    sbfi_scene scene;
    sbf_diagnostic error = {0};
    ck_assert_int_eq(sbfi_scene_read(&scene, harness_scratch("blanks.obj"), NULL, &error), SBF_OK);
    ck_assert_msg(scene.materials[0].base_color[0] > 0.9f && scene.materials[0].base_color[2] < 0.1f, "%s",
        cases[i].line);
    ck_assert_uint_eq(scene.warning_count, cases[i].missing != NULL);
    if (cases[i].missing) ck_assert_ptr_nonnull(strstr(scene.warnings[0].message, cases[i].missing));
    sbfi_scene_free(&scene);
  }
}
END_TEST

START_TEST(a_file_without_polygons_is_an_error)
{
  const char *const files[] = {"", "# only a comment\n", "v 0 0 0\nv 1 0 0\nl 1 2\n", "this is no model\n"};
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    sbfi_scene scene;
    sbf_diagnostic error = {0};
    ck_assert(sbfi_scene_init(&scene, NULL, 0, "model.obj"));
    ck_assert_int_eq(sbfi_obj_read(&scene, files[i], strlen(files[i]), NULL, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, SBF_CODE_IMPORT_EMPTY);
    sbfi_scene_free(&scene);
  }
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  const char mtl[] = "newmtl m\nKd 1 0 0\nmap_Kd a.png\n";
  const char obj[] =
      "mtllib failing.mtl missing.mtl\no one\nv 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
      "usemtl m\nf 2/1/1 3/1/1 4/1/1\no two\nv 1 1 0\nusemtl n\nf -1 -2 -3\nl 1 2\no none\nv 0 0 0\n";
  ck_assert(harness_write(harness_scratch("failing.mtl"), mtl, sizeof mtl - 1));
  ck_assert(harness_write(harness_scratch("failing.obj"), obj, sizeof obj - 1));
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_scene scene;
    sbf_diagnostic error = {0};
    sbfi_scene_options options = {.allocator = &memory.allocator};
    sbf_status status = sbfi_scene_read(&scene, harness_scratch("failing.obj"), &options, &error);
    sbfi_scene_free(&scene);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    ck_assert_uint_lt(allowed, 1000);
  }
}
END_TEST

START_TEST(a_limit_on_memory_is_kept)
{
  static char bytes[200000] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  while (strlen(bytes) < sizeof bytes - 16) strcat(bytes + strlen(bytes) - 1, "\nf 1 2 3\n");
  ck_assert(harness_write(harness_scratch("large.obj"), bytes, strlen(bytes)));
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  sbfi_scene_options options = {.memory_limit_bytes = 100000};
  ck_assert_int_eq(sbfi_scene_read(&scene, harness_scratch("large.obj"), &options, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
  options = (sbfi_scene_options){.input_limit_bytes = 1000};
  ck_assert_int_eq(sbfi_scene_read(&scene, harness_scratch("large.obj"), &options, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IO_TOO_LARGE);
}
END_TEST

START_TEST(a_missing_file_is_named)
{
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbfi_scene_read(&scene, "no/such.obj", NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_READ);
  ck_assert_str_eq(error.file, "no/such.obj");
}
END_TEST

typedef struct known {
  const char *file;
  uint32_t meshes, points, triangles, quads, ngons, unused;
} known;

/* The tables of the README files of the shared data, which were made by parsers of another kind. */
static const known knowns[] = {
    {"lizard/liz.obj", 18, 525, 1, 488, 0, 1},
    {"lizard/lizart.obj", 20, 593, 1, 552, 0, 1},
    {"lizard/lizartRef.obj", 20, 593, 1, 552, 0, 1},
    {"lizard-props/sheet.obj", 1, 16, 0, 9, 0, 0},
    {"lizard-props/box.obj", 1, 8, 0, 6, 0, 0},
    {"lizard-props/subcube.obj", 1, 26, 0, 24, 0, 0},
    {"lizard-props/trapezoid.obj", 1, 8, 0, 6, 0, 0},
    {"lizard-props/lpBall.obj", 1, 36, 0, 34, 0, 0},
    {"lizard-props/icosphere.obj", 1, 42, 80, 0, 0, 0},
    {"lizard-props/test.obj", 1, 24, 0, 22, 0, 0},
    {"armadillo/armadillo_25k.obj", 1, 12602, 25200, 0, 0, 0},
    {"armadillo/armadillo_1k.obj", 1, 531, 1058, 0, 0, 0},
    {"bunny/bunny_902.obj", 1, 453, 902, 0, 0, 0},
    {"bunny/bunny_holes.obj", 1, 2503, 4968, 0, 0, 0},
    {"cloth/cloth_25.obj", 1, 25, 32, 0, 0, 0},
    {"cloth/plane_30x30.obj", 1, 961, 1800, 0, 0, 0},
    {"tube/cylinder.obj", 1, 482, 64, 448, 0, 0},
    {"ngon/maya_axes.obj", 6, 128, 18, 76, 6, 0},
    {"ngon/concave_polygon.obj", 1, 64, 0, 0, 1, 0},
    {"soup/spider.obj", 19, 762, 1368, 0, 0, 0},
    {"soup/suzanne.obj", 1, 507, 32, 468, 0, 0},
    {"multi/boxes156.obj", 156, 1248, 312, 312, 312, 0},
    {"multi/suzanne_pair.obj", 2, 1014, 64, 936, 0, 0},
    {"spot/spot.obj", 1, 2930, 5856, 0, 0, 0},
};

START_TEST(real_files_give_the_known_counts)
{
  const known *k = &knowns[_i];
  const char *path = harness_shared(k->file);
  if (!path) return;
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  sbf_status status = sbfi_scene_read(&scene, path, NULL, &error);
  ck_assert_msg(status == SBF_OK, "%s: line %u %s", k->file, error.line, error.message);
  const char *broken = scene_check(&scene);
  ck_assert_msg(!broken, "%s: %s", k->file, broken);
  scene_counts c = scene_count(&scene);
  ck_assert_uint_eq(c.meshes, k->meshes);
  ck_assert_uint_eq(c.points, k->points);
  ck_assert_uint_eq(c.triangles, k->triangles);
  ck_assert_uint_eq(c.quads, k->quads);
  ck_assert_uint_eq(c.ngons, k->ngons);
  ck_assert_uint_eq(c.unused, k->unused);
  bool mtl_missing = strstr(k->file, "cloth_25") || strstr(k->file, "armadillo_1k");
  ck_assert_uint_eq(scene.warning_count, mtl_missing ? 1 : 0);
  sbfi_scene_free(&scene);
}
END_TEST

/* The stray vertex: liz.obj 433, counted from 1, in Arm1.R. */
START_TEST(the_unused_vertex_of_the_lizard_is_its_arms)
{
  const char *path = harness_shared("lizard/liz.obj");
  if (!path) return;
  sbfi_scene scene;
  ck_assert_int_eq(sbfi_scene_read(&scene, path, NULL, NULL), SBF_OK);
  const sbfi_scene_mesh *arm = scene_mesh_of_node(&scene, "Arm1.R_Cube.012");
  ck_assert_ptr_nonnull(arm);
  ck_assert_uint_eq(arm->point_count, 27);
  ck_assert_uint_eq(arm->point_sources[0], 432);
  ck_assert_uint_eq(arm->polygon_count, 24);
  double mean[3] = {0, 0, 0};
  for (uint32_t i = 0; i < 27; i++) {
    mean[0] += arm->points[i].x / 27.0;
    mean[1] += arm->points[i].y / 27.0;
    mean[2] += arm->points[i].z / 27.0;
  }
  ck_assert_double_eq_tol(mean[0], -0.5718, 5e-5);
  ck_assert_double_eq_tol(mean[1], 0.6290, 5e-5);
  ck_assert_double_eq_tol(mean[2], 1.0621, 5e-5);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(the_spiders_materials_have_images)
{
  const char *path = harness_shared("soup/spider.obj");
  if (!path) return;
  sbfi_scene scene;
  ck_assert_int_eq(sbfi_scene_read(&scene, path, NULL, NULL), SBF_OK);
  ck_assert_uint_eq(scene.material_count, 4);
  ck_assert_str_eq(scene.materials[0].name, "HLeibTex");
  ck_assert_str_eq(scene.images[scene.materials[0].base_color_image].path, "./SpiderTex.jpg");
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(bad_files_give_a_clear_error)
{
  static const struct {
    const char *file;
    sbf_code code;
    uint32_t line;
  } bad[] = {{"bad/malformed.obj", SBF_CODE_IMPORT_INDEX, 28},
      {"bad/malformed2.obj", SBF_CODE_IMPORT_POLYGON, 23}, {"bad/empty.obj", SBF_CODE_IMPORT_EMPTY, 0}};
  const char *path = harness_shared(bad[_i].file);
  if (!path) return;
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbfi_scene_read(&scene, path, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, bad[_i].code);
  ck_assert_uint_eq(error.line, bad[_i].line);
  ck_assert_str_eq(error.file, path);
  ck_assert_ptr_null(scene.nodes);
}
END_TEST

static Suite *obj_suite(void) {
  Suite *suite = suite_create("obj");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, objects_divide_and_groups_do_not);
  tcase_add_test(tests, groups_divide_where_there_is_no_object);
  tcase_add_test(tests, unused_vertices_are_kept_in_their_object);
  tcase_add_test(tests, unused_vertices_join_the_following_ones);
  tcase_add_test(tests, unused_vertices_far_from_all_others_are_left_out_and_reported);
  tcase_add_test(tests, vertices_without_an_object_are_left_out_and_reported);
  tcase_add_test(tests, each_mesh_has_its_own_normals_and_uvs);
  tcase_add_test(tests, materials_come_from_the_library_beside_the_file);
  tcase_add_test(tests, a_missing_library_is_a_warning);
  tcase_add_test(tests, names_of_libraries_may_have_blanks);
  tcase_add_test(tests, a_file_without_polygons_is_an_error);
  tcase_add_test(tests, every_allocation_may_fail);
  tcase_add_test(tests, a_limit_on_memory_is_kept);
  tcase_add_test(tests, a_missing_file_is_named);
  tcase_add_loop_test(tests, real_files_give_the_known_counts, 0, sizeof knowns / sizeof *knowns);
  tcase_add_test(tests, the_unused_vertex_of_the_lizard_is_its_arms);
  tcase_add_test(tests, the_spiders_materials_have_images);
  tcase_add_loop_test(tests, bad_files_give_a_clear_error, 0, 3);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(obj_suite());
}
