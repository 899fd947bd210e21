#include "import/scene/bind_pose.h"

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
START_TEST(bones_return_to_the_bind_pose)
{
  sbfi_scene_node nodes[] = {{.name = "body", .parent = -1, .local = moved(10, 0, 0)},
      {.name = "hips", .parent = -1, .local = moved(1, 1, 0), .is_bone = true},
      {.name = "thigh", .parent = 1, .local = moved(0, -0.25, 0), .is_bone = true},
      {.name = "shin", .parent = 2, .local = moved(0.5, 0, 0), .is_bone = true},
      {.name = "foot_end", .parent = 3, .local = moved(0, -0.125, 0), .is_bone = true},
      {.name = "boot", .parent = 3, .local = moved(0, 0, 0.0625)}};
  sbfi_scene_set_worlds(nodes, 6);
  /* Bound with the thigh at y = -0.25 and the shin at y = -0.75 of the mesh, whose node at x = 10 says
   * nothing: the thigh shows it at (1, 1), the shin at (1.5, 1.5), and it is taken to be halfway. */
  sbfi_scene_joint joints[] = {{3, moved(0, 0.75, 0)}, {2, moved(0, 0.25, 0)}};
  sbfi_scene_mesh meshes[] = {{.node = 0, .skin.joint_count = 2, .skin.joints = joints}, {.node = 5}};
  sbfi_scene scene = {.nodes = nodes, .node_count = 6, .meshes = meshes, .mesh_count = 2};
  sbfi_matrix worlds[6];
  sbfi_arena_init(&scene.arena, NULL, 0);
  double deviation;
  ck_assert(sbfi_bind_worlds(&scene, worlds, &deviation));
  static const double expected[][3] = {
      {10, 0, 0}, {1.25, 1.25, 0}, {1.25, 1, 0}, {1.25, 0.5, 0}, {1.25, 0.375, 0}, {1.25, 0.5, 0.0625}};
  for (int i = 0; i < 6; i++)
    for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(worlds[i].at[k][3], expected[i][k], 1e-12);
  for (int i = 0; i < 6; i++) ck_assert_double_eq(worlds[i].at[3][3], 1);
  /* The hips moved by 0.25 and 0.25; from them the foot is 0.5 and 0.375 away. */
  ck_assert_double_eq_tol(deviation, sqrt(2 * 0.25 * 0.25) / 0.625, 1e-12);
}
END_TEST

/* One joint alone says where its mesh is, turned or not; of two, one that turned since is in another pose. */
START_TEST(a_rotation_alone_is_another_pose)
{
  static const sbfi_matrix turn = {{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  sbfi_scene_node nodes[] = {{.name = "skin", .parent = -1, .local = moved(3, 0, 0)},
      {.name = "bone", .parent = -1, .local = turn, .is_bone = true},
      {.name = "next", .parent = 1, .local = moved(0, 0, 0), .is_bone = true}};
  sbfi_scene_set_worlds(nodes, 3);
  sbfi_scene_joint joints[] = {{1, moved(0, 0, 0)}, {2, moved(0, 0, 0)}};
  sbfi_scene_mesh mesh = {.node = 0, .skin.joint_count = 1, .skin.joints = joints};
  sbfi_scene scene = {.nodes = nodes, .node_count = 3, .meshes = &mesh, .mesh_count = 1};
  sbfi_matrix worlds[3];
  double deviation;
  sbfi_arena_init(&scene.arena, NULL, 0);
  ck_assert(sbfi_bind_worlds(&scene, worlds, &deviation));
  ck_assert_double_eq_tol(deviation, 0, 1e-12);
  /* The last joint was bound a quarter turn back from the first. */
  ck_assert(sbfi_matrix_invert(&turn, &joints[1].bind));
  mesh.skin.joint_count = 2;
  ck_assert(sbfi_bind_worlds(&scene, worlds, &deviation));
  ck_assert_double_ge(deviation, 0.5);
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
      {"walk-dae/walk.dae", true}, {"kenney-fbx/kenney_character.fbx", false}};
  const char *path = harness_shared(files[_i].file);
  if (!path) return;
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  ck_assert_msg(sbfi_scene_read(&scene, path, NULL, &error) == SBF_OK, "%s", error.message);
  sbfi_matrix *worlds = malloc(scene.node_count * sizeof *worlds);
  double deviation;
  ck_assert(sbfi_bind_worlds(&scene, worlds, &deviation));
  ck_assert_msg(files[_i].at_rest ? deviation < 1e-4 : deviation > 0.1, "%s: %g", files[_i].file, deviation);
  const sbfi_scene_node *before = scene.nodes;
  ck_assert(sbfi_scene_apply_bind_pose(&scene));
  ck_assert((scene.nodes == before) == files[_i].at_rest);
  ck_assert_uint_eq(scene.warning_count, files[_i].at_rest ? 0 : 1);
  const char *broken = scene_check(&scene);
  ck_assert_msg(!broken, "%s: %s", files[_i].file, broken);
  ck_assert(sbfi_bind_worlds(&scene, worlds, &deviation));
  ck_assert_double_lt(deviation, 1e-4);
  free(worlds);
  sbfi_scene_free(&scene);
}
END_TEST

/* The tracks a clip did not have are filled with what the nodes were in the file. */
START_TEST(clips_keep_their_motion)
{
  const char *path = harness_shared("sausage/sausage_blender_7400.fbx");
  if (!path) return;
  sbfi_scene scene, posed;
  ck_assert_int_eq(sbfi_scene_read(&scene, path, NULL, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_scene_read(&posed, path, NULL, NULL), SBF_OK);
  ck_assert(sbfi_scene_apply_bind_pose(&posed));
  ck_assert_uint_eq(posed.clip_count, scene.clip_count);
  for (uint32_t i = 0; i < posed.clip_count; i++) {
    const sbfi_scene_clip *clip = &posed.clips[i];
    ck_assert_uint_ge(clip->channel_count, sbfi_scene_bone_count(&posed));
    for (uint32_t k = 0; k < clip->channel_count; k++) {
      const sbfi_scene_channel *c = &clip->channels[k];
      ck_assert(c->position_count && c->rotation_count && c->scale_count);
      if (k >= scene.clips[i].channel_count) {
        ck_assert_uint_eq(c->position_count, 1);
        for (int r = 0; r < 3; r++)
          ck_assert_float_eq_tol((&c->positions[0].x)[r], (float)scene.nodes[c->node].local.at[r][3], 1e-5f);
      }
    }
  }
  sbfi_scene_free(&scene);
  sbfi_scene_free(&posed);
}
END_TEST

START_TEST(memory_may_run_out)
{
  const char *path = harness_shared("letter-f/letter_f.dae");
  if (!path) return;
  sbfi_scene scene;
  ck_assert_int_eq(sbfi_scene_read(&scene, path, NULL, NULL), SBF_OK);
  ((sbfi_scene_node *)scene.nodes)[2].world.at[0][3] += 5; /* no longer as bound */
  for (size_t capacity = 0;; capacity += 64) {
    scene.arena.limit_bytes = scene.arena.used_bytes + capacity;
    if (sbfi_scene_apply_bind_pose(&scene)) break;
    ck_assert_uint_lt(capacity, 1 << 20);
  }
  ck_assert_ptr_null(scene_check(&scene));
  sbfi_scene_free(&scene);
}
END_TEST

static Suite *bind_pose_suite(void) {
  Suite *suite = suite_create("bind_pose");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, bones_return_to_the_bind_pose);
  tcase_add_test(tests, a_rotation_alone_is_another_pose);
  tcase_add_test(tests, clips_keep_their_motion);
  tcase_add_test(tests, memory_may_run_out);
  tcase_add_loop_test(tests, real_files_saved_at_rest_or_not, 0, 8);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(bind_pose_suite());
}
