/* Rigid bodies of glTF files: memory that runs out, and files changed by chance. What they become is tested
 * in tests/e2e/test_rigid_gltf.py. */
#include <stdlib.h>
#include <string.h>

#include "conversions.h"
#include "import/physics/physics.h"
#include "random.h"

/* Every part of the extensions at once; the nodes are those of make_scene. */
static const char document[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,6]}],\n"
    "\"extensions\":{\"KHR_implicit_shapes\":{\"shapes\":[{\"type\":\"sphere\",\"sphere\":{\"radius\":0.5}},"
    "\n"
    "{\"type\":\"box\",\"box\":{\"size\":[1,2,1]}},{\"type\":\"capsule\",\"capsule\":{\"height\":1,"
    "\"radiusTop\":0.1,"
    "\"radiusBottom\":0.3}},{\"type\":\"cylinder\",\"cylinder\":{\"height\":1,\"radiusTop\":0}},\n"
    "{\"type\":\"plane\",\"plane\":{\"sizeX\":4}}]},\"KHR_physics_rigid_bodies\":{\"physicsMaterials\":[{"
    "\"staticFriction\":0.8,\"dynamicFriction\":0.7,\"restitution\":0.1}],\"collisionFilters\":[{"
    "\"collisionSystems\":["
    "\"a\",\"b\"],\"collideWithSystems\":[\"b\"]},{\"collisionSystems\":[\"b\"],\"notCollideWithSystems\":["
    "\"c\"]}],\n"
    "\"physicsJoints\":[{\"limits\":[{\"linearAxes\":[0,1,2],\"min\":0,\"max\":0},{\"angularAxes\":[1,2],"
    "\"min\":0,\"max\":"
    "0.5},{\"angularAxes\":[0],\"min\":-1,\"max\":1,\"stiffness\":5,\"damping\":1}],\"drives\":[{\"type\":"
    "\"angular\","
    "\"mode\":\"acceleration\",\"axis\":0,\"positionTarget\":0.1,\"stiffness\":3,\"velocityTarget\":1,"
    "\"damping\":2}]},\n"
    "{\"limits\":[{\"linearAxes\":[0,1],\"max\":1},{\"linearAxes\":[2],\"min\":0,\"max\":0,\"stiffness\":8},"
    "{\"angularAxes\":[0,1,2],\"max\":0.3}]}]}},\n"
    "\"nodes\":[{\"name\":\"a\",\"children\":[3],\"extensions\":{\"KHR_physics_rigid_bodies\":{\"motion\":{"
    "\"mass\":2,"
    "\"centerOfMass\":[0,0.1,0],\"linearVelocity\":[1,0,0],\"gravityFactor\":0.5},\"collider\":{\"geometry\":"
    "{\"shape\":0},"
    "\"physicsMaterial\":0,\"collisionFilter\":0}}}},\n"
    "{\"name\":\"b\",\"children\":[4,5],\"extensions\":{\"KHR_physics_rigid_bodies\":{\"motion\":{"
    "\"inertiaDiagonal\":[1,2,3],"
    "\"inertiaOrientation\":[0,0,0,1]},\"collider\":{\"geometry\":{\"node\":1,\"convexHull\":true},"
    "\"collisionFilter\":1}}}},\n"
    "{\"name\":\"floor\",\"extensions\":{\"KHR_physics_rigid_bodies\":{\"collider\":{\"geometry\":{\"shape\":"
    "4}}}}},\n"
    "{\"name\":\"fa\",\"extensions\":{\"KHR_physics_rigid_bodies\":{\"joint\":{\"connectedNode\":4,\"joint\":"
    "0,"
    "\"enableCollision\":true},\"collider\":{\"geometry\":{\"shape\":2}}}}},\n"
    "{\"name\":\"fb\",\"extensions\":{\"KHR_physics_rigid_bodies\":{\"collider\":{\"geometry\":{\"shape\":3}}"
    "}}},\n"
    "{\"name\":\"fc\",\"extensions\":{\"KHR_physics_rigid_bodies\":{\"joint\":{\"connectedNode\":6,\"joint\":"
    "1},"
    "\"trigger\":{\"geometry\":{\"shape\":1}}}}},{\"name\":\"fd\"}]}";

static void make_scene(sbfi_scene *scene) {
  scene_begin(scene);
  int32_t root = scene_node(scene, "root", SBF_NONE, false, 0, 0, 0);
  int32_t a = scene_node(scene, "a", root, false, 0, 3, 0);
  int32_t b = scene_node(scene, "b", root, false, 2, 3, 0);
  scene_node(scene, "floor", root, false, 0, 0, 0);
  scene_node(scene, "fd", root, false, 3, 3, 0);
  scene_node(scene, "fa", a, false, 1, 0, 0);
  scene_node(scene, "fb", b, false, -1, 0, 0);
  scene_node(scene, "fc", b, false, 1, 0, 0);
  scene_box(scene, a, 0.5, 0, 0, 0, false);
  scene_box(scene, b, 0.5, 0, 0, 0, false);
  scene_end(scene);
}

START_TEST(every_part_is_converted)
{
  sbfi_scene scene;
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  sbf_convert_options options = {0};
  make_scene(&scene);
  ck_assert(harness_write(scene.path, document, sizeof document - 1));
  ck_assert_msg(sbfi_convert_own_scene(&scene, &options, &asset, &error) == SBF_OK, "%s", error.message);
  ck_assert_uint_eq(asset->rigid_bodies.count, 4); /* the floor, and the world as a side of a joint */
  ck_assert_uint_eq(asset->joints.count, 2);
  ck_assert_uint_eq(asset->bones.count, 2);
  ck_assert_uint_eq(asset->soft_bodies.count, 0);
  ck_assert_int_eq(asset->joints.at[0].kind, SBF_JOINT_KIND_SPHERICAL);
  ck_assert_float_eq_tol(asset->rigid_bodies.at[0].velocity.x, 1, 1e-6f);
  sbf_asset_free(asset);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  sbfi_scene scene;
  make_scene(&scene);
  ck_assert(harness_write(scene.path, document, sizeof document - 1));
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_convert_options options = {.allocator = &memory.allocator};
    sbf_diagnostic error = {0};
    sbf_asset *asset = NULL;
    sbf_status status = sbfi_convert_own_scene(&scene, &options, &asset, &error);
    if (status != SBF_OK) ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    sbf_asset_free(asset);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_uint_lt(allowed, 5000);
  }
  sbfi_scene_free(&scene);
}
END_TEST

static void ignore(void *user, const sbf_diagnostic *diagnostic) {
  (void)user, (void)diagnostic;
}

/* Changes some characters to others of the document: it is refused, or a sound asset. */
START_TEST(a_file_changed_by_chance)
{
  sbfi_scene scene;
  char text[sizeof document];
  uint32_t state = 1, good = 0;
  make_scene(&scene);
  for (int round = 0; round < 1500; round++) {
    memcpy(text, document, sizeof document);
    for (uint32_t k = 0; k <= random_next(&state) >> 30; k++)
      text[(random_next(&state) >> 8) % (sizeof document - 1)] =
          document[(random_next(&state) >> 8) % (sizeof document - 1)];
    ck_assert(harness_write(scene.path, text, sizeof document - 1));
    sbf_convert_options options = {.report = ignore};
    sbf_diagnostic error = {0};
    sbf_asset *asset = NULL;
    sbf_status status = sbfi_convert_own_scene(&scene, &options, &asset, &error);
    if (status == SBF_OK)
      ck_assert_msg(sbf_asset_check(asset, ignore, NULL, 1) == 0, "%s", text);
    else
      ck_assert_uint_gt(strlen(error.message), 10);
    good += status == SBF_OK;
    sbf_asset_free(asset);
  }
  ck_assert_uint_gt(good, 50);
  sbfi_scene_free(&scene);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("physics");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, every_part_is_converted);
  tcase_add_test(tests, every_allocation_may_fail);
  tcase_add_test(tests, a_file_changed_by_chance);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
