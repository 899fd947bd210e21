/* Reading of VRM files where memory runs out, and of documents that are none; tests/e2e/test_vrm.py has the
 * rest. */
#include <string.h>

#include "harness.h"
#include "import/vrm/vrm.h"

enum { NODES = 5 };

static const char avatar[] =
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{},{},{},{},{}],\"extensions\":{\"VRMC_vrm\":{\"humanoid\":"
    "{\"humanBones\":{\"head\":{\"node\":4}}}},\"VRMC_springBone\":{\"specVersion\":\"1.0\",\"colliders\":"
    "[{\"node\":1,\"shape\":{\"sphere\":{\"radius\":0.1}}}],\"colliderGroups\":[{\"colliders\":[0]}],"
    "\"springs\":[{\"name\":\"hair\",\"joints\":[{\"node\":1},{\"node\":2},{\"node\":3}],\"colliderGroups\":"
    "[0]}]}}}";
static const char old_avatar[] =
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{},{},{},{},{}],\"extensions\":{\"VRM\":{"
    "\"secondaryAnimation\""
    ":{\"boneGroups\":[{\"comment\":\"hair\",\"bones\":[1],\"colliderGroups\":[0]}],\"colliderGroups\":[{"
    "\"node\":0,\"colliders\":[{\"radius\":0.1}]}]}}}}";

/* A line of nodes; the first is a bone. */
static bool begin(sbfi_scene *scene, const sbf_allocator *allocator) {
  if (!sbfi_scene_init(scene, allocator, 0, "a.vrm")) return false;
  sbfi_scene_node *nodes = sbfi_arena_allocate(&scene->arena, NODES, sizeof *nodes);
  for (int32_t i = 0; nodes && i < NODES; i++)
    nodes[i] = (sbfi_scene_node){
        .name = "n", .parent = i - 1, .number = i, .local = sbfi_matrix_identity(), .is_bone = i == 0};
  scene->nodes = nodes;
  scene->node_count = nodes ? NODES : 0;
  return nodes != NULL;
}

static sbf_status read(
    sbfi_scene *scene, const char *text, const sbf_allocator *allocator, sbf_diagnostic *error) {
  return sbfi_vrm_read(scene, (const uint8_t *)text, strlen(text), allocator, error);
}

START_TEST(nodes_of_springs_are_bones)
{
  const char *const texts[] = {avatar, old_avatar};
  for (int i = 0; i < 2; i++) {
    sbfi_scene scene;
    sbf_diagnostic error;
    ck_assert(begin(&scene, NULL));
    ck_assert_int_eq(read(&scene, texts[i], NULL, &error), SBF_OK);
    ck_assert_uint_eq(scene.warning_count, 0);
    ck_assert_uint_eq(scene.vrm->spring_count, 1);
    ck_assert_uint_eq(scene.vrm->springs[0].joint_count, i ? 4 : 3);
    ck_assert_uint_eq(scene.vrm->springs[0].collider_count, 1);
    ck_assert(scene.vrm->springs[0].has_tail == (i == 1) && scene.vrm->faces_back == (i == 1));
    for (int n = 0; n < NODES; n++) ck_assert(scene.nodes[n].is_bone);
    sbfi_scene_free(&scene);
  }
}
END_TEST

START_TEST(other_documents_have_no_avatar)
{
  static const char *const texts[] = {"", "[]", "{", "{\"asset\":{\"version\":\"2.0\"}}", "glTF",
      "{\"asset\":{\"version\":\"2.0\"},\"extensions\":{\"KHR_x\":{}}}"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    sbfi_scene scene;
    sbf_diagnostic error;
    ck_assert(begin(&scene, NULL));
    ck_assert_int_eq(read(&scene, texts[i], NULL, &error), SBF_OK);
    ck_assert_ptr_null(scene.vrm);
    sbfi_scene_free(&scene);
  }
}
END_TEST

START_TEST(failed_allocations_are_reported)
{
  const char *const texts[] = {avatar, old_avatar};
  for (int i = 0; i < 2; i++) {
    bool done = false;
    for (size_t allowed = 0; !done; allowed++) {
      harness_memory memory;
      harness_memory_init(&memory, allowed);
      sbfi_scene scene;
      sbf_diagnostic error = {0};
      if (begin(&scene, &memory.allocator)) {
        sbf_status status = read(&scene, texts[i], &memory.allocator, &error);
        done = status == SBF_OK;
        if (!done) ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
        if (done) ck_assert_uint_eq(scene.vrm->spring_count, 1);
      }
      sbfi_scene_free(&scene);
      ck_assert_uint_eq(memory.held_bytes, 0);
    }
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("vrm_read");
  TCase *all = tcase_create("all");
  tcase_add_test(all, nodes_of_springs_are_bones);
  tcase_add_test(all, other_documents_have_no_avatar);
  tcase_add_test(all, failed_allocations_are_reported);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
