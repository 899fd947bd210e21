#include "import/bind_pose.h"

#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "scene_check.h"

static sbfi_matrix moved(double x, double y, double z) {
  sbfi_matrix m = sbfi_matrix_identity();
  m.at[0][3] = x;
  m.at[1][3] = y;
  m.at[2][3] = z;
  return m;
}

/* A leg raised since it was bound: hips (no weights), thigh and shin (joints), foot_end, a boot on the shin.
 */
START_TEST(bones_go_back_to_where_they_were_bound)
{
  sbfi_scene_node nodes[] = {{.name = "body", .parent = -1, .local = moved(10, 0, 0)},
      {.name = "hips", .parent = -1, .local = moved(1, 1, 0), .is_bone = true},
      {.name = "thigh", .parent = 1, .local = moved(0, -0.25, 0), .is_bone = true},
      {.name = "shin", .parent = 2, .local = moved(0.5, 0, 0), .is_bone = true},
      {.name = "foot_end", .parent = 3, .local = moved(0, -0.125, 0), .is_bone = true},
      {.name = "boot", .parent = 3, .local = moved(0, 0, 0.0625)}};
  sbfi_scene_set_worlds(nodes, 6);
  /* Bound with the thigh at y = -0.25 and the shin at y = -0.75 of the mesh, which lies at x = 10. */
  sbfi_scene_joint joints[] = {{3, moved(0, 0.75, 0)}, {2, moved(0, 0.25, 0)}};
  sbfi_scene_mesh meshes[] = {{.node = 0, .joint_count = 2, .joints = joints}, {.node = 5}};
  sbfi_scene scene = {.nodes = nodes, .node_count = 6, .meshes = meshes, .mesh_count = 2};
  sbfi_matrix worlds[6];
  double farthest = sbfi_bind_worlds(&scene, worlds);
  static const double expected[][3] = {
      {10, 0, 0}, {10, 0, 0}, {10, -0.25, 0}, {10, -0.75, 0}, {10, -0.875, 0}, {10, -0.75, 0.0625}};
  for (int i = 0; i < 6; i++)
    for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(worlds[i].at[k][3], expected[i][k], 1e-12);
  for (int i = 0; i < 6; i++) ck_assert_double_eq(worlds[i].at[3][3], 1);
  ck_assert_double_eq_tol(farthest, sqrt(9 * 9 + 1 * 1), 1e-12); /* the hips */
  sbfi_matrix skin = sbfi_bind_placement(&scene, &meshes[0], worlds),
              rigid = sbfi_bind_placement(&scene, &meshes[1], worlds);
  ck_assert_double_eq(skin.at[0][3], 10);
  ck_assert_double_eq_tol(rigid.at[1][3], -0.75, 1e-12);
}
END_TEST

/* Files saved at rest, and files saved in the middle of an animation. */
START_TEST(real_files_saved_at_rest_or_not)
{
  static const struct {
    const char *file;
    bool at_rest;
  } files[] = {{"lizard/lizart.glb", true}, {"fox/fox.glb", true}, {"greenman/greenman.glb", true},
      {"letter-f/letter_f.dae", true}, {"sausage/sausage_7500_ascii.fbx", true}, {"snake/snake.glb", false},
      {"walk-dae/walk.dae", false}, {"kenney-fbx/kenney_character.fbx", false}};
  const char *path = harness_shared(files[_i].file);
  if (!path) return;
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  ck_assert_msg(sbfi_scene_read(&scene, path, NULL, &error) == SBF_OK, "%s", error.message);
  sbfi_matrix *worlds = malloc(scene.node_count * sizeof *worlds);
  double farthest_m = sbfi_bind_worlds(&scene, worlds) * scene.unit_m;
  ck_assert_msg(
      files[_i].at_rest ? farthest_m < 1e-4 : farthest_m > 0.1, "%s: %g", files[_i].file, farthest_m);
  free(worlds);
  sbfi_scene_free(&scene);
}
END_TEST

static Suite *bind_pose_suite(void) {
  Suite *suite = suite_create("bind_pose");
  TCase *tests = tcase_create("all");
  tcase_set_timeout(tests, 60);
  tcase_add_test(tests, bones_go_back_to_where_they_were_bound);
  tcase_add_loop_test(tests, real_files_saved_at_rest_or_not, 0, 8);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(bind_pose_suite());
}
