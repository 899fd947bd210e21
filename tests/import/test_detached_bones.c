#include <stdlib.h>
#include <string.h>

#include "conversions.h"

/* A root, a limb of three bones downwards that holds skin, and a foot on the root that holds the skin below
 * it. `foot_first`: it stands before the limb in the file. */
static void make(sbfi_scene *scene, bool foot_first, bool foot_holds, double foot_x) {
  static const uint32_t spread[8] = {0, 0, 1, 1, 2, 2, 3, 3}, without_foot[8] = {0, 0, 1, 1, 2, 2, 2, 2};
  int32_t joints[4], foot = 0;
  scene_begin(scene);
  int32_t root = scene_node(scene, "root", SBF_NONE, true, 0, 0, 0);
  if (foot_first) foot = scene_node(scene, "foot", root, true, foot_x, 0, 0);
  int32_t body = scene_node(scene, "body", root, true, 0, 3, 0);
  for (int i = 0; i < 3; i++) {
    static const char *const names[] = {"upper", "lower", "last"};
    joints[i] = scene_node(scene, names[i], i ? joints[i - 1] : body, true, i ? 0 : 0.25, i ? 1 : 0, 0);
    if (i == 0) { /* its Y points down */
      sbfi_matrix *m = scene_local(scene, joints[0]);
      m->at[1][1] = m->at[0][0] = -1;
    }
  }
  if (!foot_first) foot = scene_node(scene, "foot", root, true, foot_x, 0, 0);
  joints[3] = foot;
  int32_t skin = scene_node(scene, "skin", SBF_NONE, false, 0, 0, 0);
  scene_skin(
      scene, scene_box(scene, skin, 0.5, 0, 1, 0, false), 4, joints, foot_holds ? spread : without_foot);
  scene_end(scene);
}

START_TEST(a_foot_under_the_root_is_attached_to_its_limb)
{
  for (int first = 0; first < 2; first++) {
    sbfi_scene scene;
    converted c;
    make(&scene, first, true, 0.25);
    converted_scene(&c, &scene, &scene, NULL);
    int32_t foot = bone_named(c.asset, "foot"), last = bone_named(c.asset, "last");
    ck_assert_int_eq(c.asset->bones.at[foot].parent, last);
    ck_assert_int_gt(foot, last); /* parents first, in any order of the file */
    ck_assert_float_eq_tol(c.asset->bones.at[last].length, 1, 1e-6f);
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_BONE_REHUNG), 1);
    const char *message = converted_note(&c, SBF_CODE_RIG_BONE_REHUNG)->message;
    ck_assert(strstr(message, "'foot'") && strstr(message, "'last'"));
    /* The skin still names the right bones. */
    const sbf_skin *skin = mesh_named(c.asset, "skin")->skin;
    ck_assert_uint_eq(skin->bones.at[6], (uint32_t)foot);
    ck_assert_uint_eq(skin->bones.at[5], (uint32_t)last);
    converted_free(&c);
    sbfi_scene_free(&scene);
  }
}
END_TEST

/* A target without skin, and a bone that no limb points at, stay where they are. */
START_TEST(other_bones_are_unchanged)
{
  for (int i = 0; i < 2; i++) {
    sbfi_scene scene;
    converted c;
    make(&scene, false, i == 1, i == 1 ? 0.75 : 0.25);
    converted_scene(&c, &scene, &scene, NULL);
    ck_assert_int_eq(c.asset->bones.at[bone_named(c.asset, "foot")].parent, bone_named(c.asset, "root"));
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_BONE_REHUNG), 0);
    converted_free(&c);
    sbfi_scene_free(&scene);
  }
}
END_TEST

/* A leg of two bones and a target without skin where it ends: the target becomes its ankle. */
START_TEST(a_target_ends_its_leg)
{
  static const uint32_t spread[8] = {1, 1, 0, 0, 1, 1, 0, 0}; /* by y: the lower half to the shin */
  for (int away = 0; away < 2; away++) {
    sbfi_scene scene;
    converted c;
    int32_t joints[2];
    scene_begin(&scene);
    int32_t root = scene_node(&scene, "root", SBF_NONE, true, 0, 0, 0);
    int32_t body = scene_node(&scene, "body", root, true, 0, 2, 0);
    joints[0] = scene_node(&scene, "thigh", body, true, 0.25, 0, 0);
    joints[1] = scene_node(&scene, "shin", joints[0], true, 0, -1, 0);
    scene_node(&scene, "target", root, true, 0.25, 0, away ? 0.5 : 0);
    int32_t skin = scene_node(&scene, "skin", SBF_NONE, false, 0, 0, 0);
    scene_local(&scene, skin)->at[1][1] = 32;
    scene_end(&scene);
    scene_skin(&scene, scene_box(&scene, skin, 0.03125, 0.25, 0.03125, 0, false), 2, joints, spread);
    scene_box(&scene, scene_node(&scene, "trunk", body, false, 0, 0, 0), 0.5, 0, 0, 0, false);
    scene_end(&scene);
    converted_scene(&c, &scene, &scene, NULL);
    int32_t target = bone_named(c.asset, "target");
    ck_assert_str_eq(c.asset->bones.at[c.asset->bones.at[target].parent].name, away ? "root" : "shin");
    converted_free(&c);
    sbfi_scene_free(&scene);
  }
}
END_TEST

/* A foot whose skin goes on in that of the shin hangs on the shin, wherever the shin points. */
START_TEST(skin_weights_identify_the_leg_of_a_foot)
{
  static const uint32_t spread[8] = {2, 2, 1, 1, 2, 2, 1, 1};
  sbfi_scene scene;
  converted c;
  int32_t joints[3];
  scene_begin(&scene);
  int32_t root = scene_node(&scene, "root", SBF_NONE, true, 0, 0, 0);
  int32_t body = scene_node(&scene, "body", root, true, 0, 2, 0);
  joints[0] = scene_node(&scene, "thigh", body, true, 0.25, 0, 0);
  joints[1] = scene_node(&scene, "shin", joints[0], true, 0, -1, 0);
  joints[2] = scene_node(&scene, "foot", root, true, 0.5, 0.5, 1);
  int32_t skin = scene_node(&scene, "skin", SBF_NONE, false, 0, 0, 0);
  scene_skin(&scene, scene_box(&scene, skin, 0.25, 0.25, 0.25, 0, false), 3, joints, spread);
  int32_t upper = scene_node(&scene, "upper", SBF_NONE, false, 0, 0, 0);
  static const uint32_t all_of_thigh[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  scene_skin(&scene, scene_box(&scene, upper, 0.25, 0.25, 1.5, 0, false), 3, joints, all_of_thigh);
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  int32_t foot = bone_named(c.asset, "foot");
  ck_assert_str_eq(c.asset->bones.at[c.asset->bones.at[foot].parent].name, "shin");
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(real_rigs)
{
  static const struct {
    const char *file;
    uint32_t rehung;
    const char *bone, *parent;
  } rigs[] = {{"spider/spider.glb", 8, "FrontFoot2.R", "FrontLeg3.R"},
      {"snake/snake.glb", 1, "Mouth", "Head"},
      {"kenney-fbx/kenney_character.fbx", 0, "LeftFootIK", "LeftToeRoll"},
      {"fox/fox.glb", 0, "b_Hip_01", "b_Root_00"}};
  for (size_t i = 0; i < sizeof rigs / sizeof *rigs; i++) {
    const char *path = harness_shared(rigs[i].file);
    if (!path) return;
    converted c;
    converted_file(&c, path, NULL);
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_BONE_REHUNG), rigs[i].rehung);
    int32_t parent = c.asset->bones.at[bone_named(c.asset, rigs[i].bone)].parent;
    ck_assert_str_eq(c.asset->bones.at[parent].name, rigs[i].parent);
    converted_free(&c);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("detached_bones");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_foot_under_the_root_is_attached_to_its_limb);
  tcase_add_test(tests, other_bones_are_unchanged);
  tcase_add_test(tests, a_target_ends_its_leg);
  tcase_add_test(tests, skin_weights_identify_the_leg_of_a_foot);
  tcase_add_test(tests, real_rigs);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
