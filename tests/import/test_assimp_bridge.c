#define _GNU_SOURCE
#include "import/scene/assimp_bridge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness.h"
#include "import/scene/stream_format.h"
#include "scene_check.h"

static sbf_status read_with(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *options, sbf_diagnostic *error) {
  *error = (sbf_diagnostic){0};
  sbf_status status = sbfi_scene_read(scene, path, options, error);
  if (status) {
    ck_assert_str_eq(error->file, path);
    ck_assert_uint_gt(strlen(error->message), 10);
    ck_assert_ptr_null(scene->nodes);
  }
  return status;
}

/* A helper that does what a shell line says. */
static const char *helper_that(const char *line) {
  char script[512];
  const char *path = harness_scratch("helper.sh");
  int length = snprintf(script, sizeof script, "#!/bin/sh\n%s\n", line);
  ck_assert(harness_write(path, script, (size_t)length));
  ck_assert_int_eq(chmod(path, 0755), 0);
  return path;
}

static const char *some_file(void) {
  const char *path = harness_scratch("some.fbx");
  ck_assert(harness_write(path, "content", 7));
  return path;
}

START_TEST(a_missing_helper)
{
  sbfi_scene scene;
  sbf_diagnostic error;
  sbfi_scene_options options = {.helper_path = "no/such/helper"};
  const char *path = some_file();
  ck_assert_int_eq(read_with(&scene, path, &options, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_HELPER_MISSING);
  ck_assert_ptr_nonnull(strstr(error.message, "no/such/helper"));
  options.helper_path = harness_scratch(""); /* a folder */
  ck_assert_int_eq(read_with(&scene, path, &options, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_HELPER_MISSING);
  setenv("SBFMT_IMPORT_HELPER", "/nowhere/either", 1);
  ck_assert_int_eq(read_with(&scene, path, NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_HELPER_MISSING);
  ck_assert_ptr_nonnull(strstr(error.message, "SBFMT_IMPORT_HELPER"));
}
END_TEST

START_TEST(the_environment_names_a_helper)
{
  sbfi_scene scene;
  sbf_diagnostic error;
  setenv("SBFMT_IMPORT_HELPER", helper_that("echo never heard of it >&2; exit 1"), 1);
  ck_assert_int_eq(read_with(&scene, some_file(), NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_REFUSED);
  ck_assert_ptr_nonnull(strstr(error.message, "never heard of it"));
}
END_TEST

static const struct {
  const char *line;
  sbf_code code;
  sbf_status status;
} ends[] = {
    {"kill -SEGV $$", SBF_CODE_IMPORT_CRASHED, SBF_BAD_INPUT},
    {"kill -ABRT $$", SBF_CODE_IMPORT_CRASHED, SBF_BAD_INPUT},
    {"exit 77", SBF_CODE_IMPORT_CRASHED, SBF_BAD_INPUT},
    {"exit 4", SBF_CODE_IMPORT_LIMIT, SBF_BAD_INPUT},
    {"exec sleep 60", SBF_CODE_IMPORT_LIMIT, SBF_BAD_INPUT},
    {"exec cat /dev/zero", SBF_CODE_IMPORT_LIMIT, SBF_BAD_INPUT},
    {"exit 0", SBF_CODE_IMPORT_STREAM, SBF_FAILED},
    {"echo nonsense", SBF_CODE_IMPORT_STREAM, SBF_FAILED},
};

START_TEST(any_exit_of_the_helper)
{
  sbfi_scene scene;
  sbf_diagnostic error;
  sbfi_scene_options options = {
      .helper_path = helper_that(ends[_i].line), .helper_time_limit_s = 0.5, .memory_limit_bytes = 1 << 20};
  ck_assert_int_eq(read_with(&scene, some_file(), &options, &error), ends[_i].status);
  ck_assert_msg(error.code == (int32_t)ends[_i].code, "%s: %s", ends[_i].line, error.message);
}
END_TEST

START_TEST(unreadable_files)
{
  sbfi_scene scene;
  sbf_diagnostic error;
  ck_assert_int_eq(read_with(&scene, "no/such.fbx", NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_READ);
  ck_assert(harness_write(harness_scratch("no_bytes.glb"), "", 0));
  ck_assert_int_eq(read_with(&scene, harness_scratch("no_bytes.glb"), NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_EMPTY);
  sbfi_scene_options options = {.input_limit_bytes = 6};
  ck_assert_int_eq(read_with(&scene, some_file(), &options, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IO_TOO_LARGE);
  ck_assert_int_eq(read_with(&scene, some_file(), NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_REFUSED);
}
END_TEST

typedef struct known {
  const char *file;
  uint32_t meshes, points, triangles, quads, ngons, bones, ends, skinned, clips, materials;
  double unit_m; /* 0: the file does not say */
} known;

/* The tables of the README files of the shared data. Where points differ from them: a glTF holds render
 * vertices (the number of different positions stands here), an FBX loses vertices no polygon uses (1 in each
 * lizard), and walk.dae has 59 vertices at the place of another with the same weights. */
static const known knowns[] = {
    {"lizard/liz.fbx", 18, 524, 1, 488, 0, 26, 6, 0, 0, 1, 0.01},
    {"lizard/lizart.fbx", 20, 592, 1, 552, 0, 26, 6, 0, 0, 1, 0.01},
    {"lizard/lizart.glb", 17, 514, 960, 0, 0, 20, 0, 42, 0, 1, 1},
    {"fox/fox.glb", 1, 290, 576, 0, 0, 24, 0, 290, 3, 1, 1},
    {"greenman/greenman.glb", 1, 180, 356, 0, 0, 12, 0, 180, 4, 1, 1},
    {"snake/snake.glb", 1, 815, 1618, 0, 0, 15, 5, 815, 4, 7, 1},
    {"spider/spider.glb", 1, 1386, 2712, 0, 0, 39, 20, 1386, 5, 2, 1},
    {"kenney-fbx/kenney_character.fbx", 1, 804, 48, 778, 0, 58, 13, 804, 1, 1, 0.01},
    {"sausage/sausage_7500_ascii.fbx", 1, 24, 0, 22, 0, 4, 0, 24, 0, 1, 0.01},
    {"sausage/sausage_blender_7400.fbx", 1, 290, 0, 288, 0, 4, 1, 290, 3, 1, 1},
    {"walk-dae/walk.dae", 1, 7786, 319, 7654, 0, 31, 0, 7786, 1, 6, 1},
    {"letter-f/letter_f.dae", 1, 32, 60, 0, 0, 2, 0, 32, 1, 1, 1},
    {"letter-f/letter_f_chain3.dae", 1, 36, 68, 0, 0, 3, 0, 36, 1, 1, 1},
    {"mocap/cmu_01_01.bvh", 0, 0, 0, 0, 0, 31, 7, 0, 1, 0, 0},
};

#define read_shared(scene, file) read_shared_for(__func__, (scene), (file))
static bool read_shared_for(const char *function, sbfi_scene *scene, const char *file) {
  const char *path = harness_shared_for(function, file);
  if (!path) return false;
  sbf_diagnostic error;
  sbf_status status = read_with(scene, path, NULL, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", file, error.message);
  const char *broken = scene_check(scene);
  ck_assert_msg(!broken, "%s: %s", file, broken);
  return true;
}

START_TEST(real_files_give_the_known_counts)
{
  const known *k = &knowns[_i];
  sbfi_scene scene;
  if (!read_shared(&scene, k->file)) return;
  scene_counts c = scene_count(&scene);
  ck_assert_uint_eq(c.meshes, k->meshes);
  ck_assert_uint_eq(c.points, k->points);
  ck_assert_uint_eq(c.triangles, k->triangles);
  ck_assert_uint_eq(c.quads, k->quads);
  ck_assert_uint_eq(c.ngons, k->ngons);
  ck_assert_uint_eq(c.bones, k->bones);
  ck_assert_uint_eq(c.ends, k->ends);
  ck_assert_uint_eq(c.skinned, k->skinned);
  ck_assert_uint_eq(scene.clip_count, k->clips);
  ck_assert_uint_eq(scene.material_count, k->materials);
  ck_assert_uint_eq(scene.warning_count, 0);
  ck_assert(scene.unit_known == (k->unit_m > 0));
  if (scene.unit_known) ck_assert_double_eq(scene.unit_m, k->unit_m);
  sbfi_scene_free(&scene);
}
END_TEST

/* Which bone carries which section, as the README of the lizard has it: by node parent, for the names of
 * three sections are those of other bones. */
static const char *const section_bones[][2] = {{"Head", "Head"}, {"Body.001", "Body.002"},
    {"Body.002", "Body"}, {"Arm1.L", "Arm.001.L"}, {"Arm1.R", "Arm.001.R"}, {"Arm2.L", "Arm.002.L"},
    {"Arm2.R", "Arm.002.R"}, {"Hand.L", "Arm.003.L"}, {"Hand.R", "Arm.003.R"}, {"Leg1.L", "Leg.001.L"},
    {"Leg1.R", "Leg.001.R"}, {"Leg2.L", "Leg.002.L"}, {"Leg2.R", "Leg.002.R"}, {"Foot.L", "Leg.003.L"},
    {"Foot.R", "Leg.003.R"}, {"Tail1", "Tail.001"}, {"Tail2", "Tail.002"}, {"Tail3", "Tail.003"}};

START_TEST(sections_are_attached_to_the_bones_of_the_table)
{
  static const char *const files[] = {"lizard/liz.fbx", "lizard/lizart.fbx", "lizard/lizart.glb"};
  sbfi_scene scene;
  if (!read_shared(&scene, files[_i])) return;
  for (size_t i = 0; i < sizeof section_bones / sizeof *section_bones; i++) {
    const sbfi_scene_mesh *section = scene_mesh_of_node(&scene, section_bones[i][0]);
    if (_i == 2 && (i == 1 || i == 2)) continue; /* the GLB has one skinned body in their place */
    ck_assert_msg(section != NULL, "%s", section_bones[i][0]);
    int32_t bone = scene.nodes[section->node].parent;
    ck_assert(bone != SBF_NONE && scene.nodes[bone].is_bone);
    ck_assert_str_eq(scene.nodes[bone].name, section_bones[i][1]);
  }
  sbfi_scene_free(&scene);
}
END_TEST

static void expect_head(const sbfi_scene *scene, const char *bone, double x, double y, double z) {
  int32_t node = scene_find_node(scene, bone, true);
  ck_assert_msg(node != SBF_NONE, "%s", bone);
  const double expected[] = {x, y, z};
  for (int k = 0; k < 3; k++)
    ck_assert_double_eq_tol(scene->nodes[node].world.at[k][3] * scene->unit_m, expected[k], 6e-5);
}

/* The same skeleton and shape in metres, whether the file is in centimetres below a node scaled by 100 or
 * not. */
START_TEST(the_lizard_is_in_metres)
{
  static const char *const files[] = {"lizard/liz.fbx", "lizard/lizart.glb"};
  sbfi_scene scene;
  if (!read_shared(&scene, files[_i])) return;
  expect_head(&scene, "Bone", 0, 0, -1);
  expect_head(&scene, "Body.002", 0, 0.8975, 0.7228);
  expect_head(&scene, "Arm.003.L", 0.7349, 0.0527, 1.0976);
  expect_head(&scene, "Leg.002.R", -0.8529, 0.4951, -0.3065);
  expect_head(&scene, "Tail.003", 0, 0.7830, -2.2238);
  double low[3] = {1e9, 1e9, 1e9}, high[3] = {-1e9, -1e9, -1e9};
  for (uint32_t i = 0; i < scene.mesh_count; i++) {
    const sbfi_scene_mesh *m = &scene.meshes[i];
    const double(*w)[4] = scene.nodes[m->node].world.at;
    for (uint32_t p = 0; p < m->point_count && !m->skin.joint_count; p++)
      for (int k = 0; k < 3; k++) {
        sbf_vec3 at = m->points[p];
        double v = (w[k][0] * at.x + w[k][1] * at.y + w[k][2] * at.z + w[k][3]) * scene.unit_m;
        low[k] = v < low[k] ? v : low[k];
        high[k] = v > high[k] ? v : high[k];
      }
  }
  static const double lows[] = {-0.9474, -0.0021, -2.7719}, highs[] = {0.9474, 1.0984, 2.2939};
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(low[k], lows[k], 6e-5);
    /* The highest section is one that the GLB does not have. */
    if (k != 1 || _i == 0) ck_assert_double_eq_tol(high[k], highs[k], 6e-5);
  }
  sbfi_scene_free(&scene);
}
END_TEST

/* The joints of the skin are the bones named Body and Head, not the sections of the same names. */
START_TEST(joints_are_never_sections)
{
  sbfi_scene scene;
  if (!read_shared(&scene, "lizard/lizart.glb")) return;
  const sbfi_scene_mesh *skin = NULL;
  for (uint32_t i = 0; i < scene.mesh_count; i++)
    if (scene.meshes[i].skin.joint_count) skin = &scene.meshes[i];
  ck_assert_ptr_nonnull(skin);
  ck_assert_uint_eq(skin->skin.joint_count, 20);
  for (uint32_t j = 0; j < skin->skin.joint_count; j++)
    for (uint32_t i = 0; i < scene.mesh_count; i++)
      ck_assert_int_ne(skin->skin.joints[j].node, scene.meshes[i].node);
  sbfi_scene_free(&scene);
}
END_TEST

/* Edges that do not border on exactly two polygons. */
static uint32_t open_edges(const sbfi_scene_mesh *m) {
  uint64_t *edges = malloc(m->corner_count * sizeof *edges);
  uint32_t count = 0, open = 0;
  for (uint32_t p = 0; p < m->polygon_count; p++) {
    uint32_t first = m->polygon_starts[p], size = m->polygon_starts[p + 1] - first;
    for (uint32_t k = 0; k < size; k++) {
      uint64_t a = m->corner_points[first + k], b = m->corner_points[first + (k + 1) % size];
      edges[count++] = a < b ? a << 32 | b : b << 32 | a;
    }
  }
  for (uint32_t i = 0; i < count; i++) {
    uint32_t same = 0;
    for (uint32_t k = 0; k < count; k++) same += edges[k] == edges[i];
    open += same != 2;
  }
  free(edges);
  return open;
}

/* Welded, the surfaces that the README calls closed are closed; and the snake, split into seven by its
 * materials, has no more open edges than its parts have by themselves. */
START_TEST(welded_surfaces_are_closed)
{
  static const char *const files[] = {
      "fox/fox.glb", "greenman/greenman.glb", "spider/spider.glb", "lizard/lizart.glb", "snake/snake.glb"};
  sbfi_scene scene;
  if (!read_shared(&scene, files[_i])) return;
  for (uint32_t i = 0; i < scene.mesh_count; i++) ck_assert_uint_eq(open_edges(&scene.meshes[i]), 0);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(images_are_imported)
{
  sbfi_scene scene;
  if (!read_shared(&scene, "fox/fox.glb")) return;
  ck_assert_uint_eq(scene.image_count, 1);
  ck_assert_str_eq(scene.images[0].extension, "png");
  ck_assert_int_eq(memcmp(scene.images[0].bytes, "\x89PNG", 4), 0);
  ck_assert_int_eq(scene.materials[0].base_color_image, 0);
  ck_assert_uint_eq(scene.meshes[0].uv_set_count, 1);
  sbfi_scene_free(&scene);
}
END_TEST

/* In a file saved at rest, the bind transforms put every point at its skinned rest position. */
START_TEST(skins_fit_their_joints)
{
  static const char *const files[] = {
      "fox/fox.glb", "letter-f/letter_f.dae", "sausage/sausage_7500_ascii.fbx"};
  sbfi_scene scene;
  if (!read_shared(&scene, files[_i])) return;
  const sbfi_scene_mesh *m = &scene.meshes[0];
  for (uint32_t j = 0; j < m->skin.joint_count; j++) {
    sbfi_matrix at =
        sbfi_matrix_multiply(&scene.nodes[m->skin.joints[j].node].world, &m->skin.joints[j].bind);
    for (int k = 0; k < 12; k++)
      ck_assert_double_eq_tol(at.at[k / 4][k % 4], scene.nodes[m->node].world.at[k / 4][k % 4], 1e-4);
  }
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(clips_have_their_lengths)
{
  static const struct {
    const char *file;
    float duration_s;
    uint32_t channels, max_keys;
  } clips[] = {{"mocap/cmu_01_01.bvh", 2751 / 120.0f, 31, 2752}, {"walk-dae/walk.dae", 5.79167f, 31, 139},
      {"fox/fox.glb", 3.41667f, 20, 83}, {"snake/snake.glb", 0.666667f, 11, 17}};
  sbfi_scene scene;
  if (!read_shared(&scene, clips[_i].file)) return;
  const sbfi_scene_clip *clip = &scene.clips[0];
  ck_assert_float_eq_tol(clip->duration_s, clips[_i].duration_s, 1e-3f);
  ck_assert_uint_eq(clip->channel_count, clips[_i].channels);
  uint32_t max = 0;
  for (uint32_t i = 0; i < clip->channel_count; i++) {
    ck_assert(scene.nodes[clip->channels[i].node].is_bone);
    if (clip->channels[i].rotation_count > max) max = clip->channels[i].rotation_count;
  }
  ck_assert_uint_eq(max, clips[_i].max_keys);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(bad_files_give_a_clear_error)
{
  static const struct {
    const char *file;
    sbf_code code;
  } bad[] = {{"bad/md5_overflow_vertex.md5mesh", SBF_CODE_IMPORT_CRASHED},
      {"bad/empty_init_from.dae", SBF_CODE_IMPORT_CRASHED},
      {"bad/position_bad_count.dae", SBF_CODE_IMPORT_EMPTY},
      {"sausage/sausage_6100_unsupported.fbx", SBF_CODE_IMPORT_REFUSED}};
  const char *path = harness_shared(bad[_i].file);
  if (!path) return;
  sbfi_scene scene;
  sbf_diagnostic error;
  ck_assert_int_eq(read_with(&scene, path, NULL, &error), SBF_BAD_INPUT);
  /* The effect of a write beyond assimp's memory depends on its contents. */
  bool unsure = _i == 0 && error.code == SBF_CODE_IMPORT_EMPTY;
  ck_assert_msg(
      unsure || error.code == (int32_t)bad[_i].code, "%s: %d %s", path, (int)error.code, error.message);
}
END_TEST

/* A real file cut off anywhere, read by the real helper: an error, or a scene that keeps its promises. */
START_TEST(a_real_file_cut_off)
{
  static const char *const files[] = {"letter-f/letter_f.dae", "lizard/liz.fbx", "greenman/greenman.glb"};
  const char *path = harness_shared(files[_i]);
  if (!path) return;
  size_t size;
  char *bytes = harness_read(path, &size), name[32];
  ck_assert_ptr_nonnull(bytes);
  snprintf(name, sizeof name, "cut_off%s", strrchr(files[_i], '.'));
  for (size_t part = 0; part < 16; part++) {
    const char *cut = harness_scratch(name);
    ck_assert(harness_write(cut, bytes, size * part / 16 + part));
    sbfi_scene scene;
    sbf_diagnostic error;
    if (read_with(&scene, cut, NULL, &error) != SBF_OK) continue;
    const char *broken = scene_check(&scene);
    ck_assert_msg(!broken, "%s", broken);
    sbfi_scene_free(&scene);
  }
  free(bytes);
}
END_TEST

static Suite *assimp_bridge_suite(void) {
  Suite *suite = suite_create("assimp_bridge");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_missing_helper);
  tcase_add_test(tests, the_environment_names_a_helper);
  tcase_add_loop_test(tests, any_exit_of_the_helper, 0, sizeof ends / sizeof *ends);
  tcase_add_test(tests, unreadable_files);
  tcase_add_loop_test(tests, real_files_give_the_known_counts, 0, sizeof knowns / sizeof *knowns);
  tcase_add_loop_test(tests, sections_are_attached_to_the_bones_of_the_table, 0, 3);
  tcase_add_loop_test(tests, the_lizard_is_in_metres, 0, 2);
  tcase_add_test(tests, joints_are_never_sections);
  tcase_add_loop_test(tests, welded_surfaces_are_closed, 0, 5);
  tcase_add_test(tests, images_are_imported);
  tcase_add_loop_test(tests, skins_fit_their_joints, 0, 3);
  tcase_add_loop_test(tests, clips_have_their_lengths, 0, 4);
  tcase_add_loop_test(tests, bad_files_give_a_clear_error, 0, 4);
  tcase_add_loop_test(tests, a_real_file_cut_off, 0, 3);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  unsetenv("SBFMT_IMPORT_HELPER"); /* the one of the build tree */
  return harness_run(assimp_bridge_suite());
}
