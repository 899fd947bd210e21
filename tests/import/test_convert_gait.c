#include "conversions.h"

/* Asked for afterwards, a gait is the one that a conversion proposes. */
START_TEST(a_gait_proposed_later_is_the_same)
{
  const char *paths[2] = {
      harness_source("examples/lizard/lizard.glb"), harness_source("examples/pup/pup.glb")};
  converted at_once, later;
  sbf_convert_options options = {.no_gait = true};
  sbf_diagnostic error;
  converted_file(&at_once, paths[_i], NULL);
  converted_file(&later, paths[_i], &options);
  ck_assert_uint_eq(later.asset->gaits.count, 0);
  ck_assert_int_eq(sbf_convert_gait(later.asset, NULL, &error), SBF_OK);
  const sbf_asset *a = at_once.asset, *b = later.asset;
  ck_assert_uint_eq(b->gaits.count, 1);
  const sbf_gait *one = &a->gaits.at[0], *two = &b->gaits.at[0];
  ck_assert(two->proposed);
  ck_assert_uint_eq(one->legs.count, two->legs.count);
  ck_assert_uint_eq(a->ik_chains.count, b->ik_chains.count);
  ck_assert_uint_eq(a->chains.count, b->chains.count);
  ck_assert_int_eq(one->body, two->body);
  ck_assert_float_eq(one->step_height, two->step_height);
  for (uint32_t l = 0; l < one->legs.count; l++) {
    ck_assert_str_eq(one->legs.at[l].name, two->legs.at[l].name);
    ck_assert_uint_eq(one->legs.at[l].group, two->legs.at[l].group);
    ck_assert_float_eq(one->legs.at[l].sole, two->legs.at[l].sole);
  }
  /* What has one keeps it. */
  ck_assert_int_eq(sbf_convert_gait(later.asset, NULL, &error), SBF_OK);
  ck_assert_ptr_eq(&later.asset->gaits.at[0], two);
  converted_free(&at_once);
  converted_free(&later);
}
END_TEST

static void count_notes(void *user, const sbf_diagnostic *note) {
  *(int *)user += note->code == SBF_CODE_RIG_NO_LEGS;
}

/* A rig without legs is told of, and gets no gait. */
START_TEST(rigs_without_legs_are_reported)
{
  sbfi_scene scene;
  converted c;
  sbf_convert_options options = {.no_gait = true};
  sbf_diagnostic error;
  int reported = 0;
  scene_begin(&scene);
  int32_t root = scene_node(&scene, "root", -1, true, 0, 1, 0);
  scene_box(&scene, scene_node(&scene, "part", root, false, 0, 0, 0), 0.5, 0, 0, 0, false);
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, &options);
  options = (sbf_convert_options){.report = count_notes, .user = &reported};
  ck_assert_int_eq(sbf_convert_gait(c.asset, &options, &error), SBF_OK);
  ck_assert_int_eq(reported, 1);
  ck_assert_uint_eq(c.asset->gaits.count, 0);
  options.struct_size = 3;
  ck_assert_int_ne(sbf_convert_gait(c.asset, &options, &error), SBF_OK);
  ck_assert_int_eq(error.code, SBF_CODE_BAD_CALL);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(used_ids_are_not_reassigned)
{
  converted c;
  sbf_convert_options options = {.no_gait = true};
  sbf_diagnostic error;
  converted_file(&c, harness_source("examples/lizard/lizard.glb"), &options);
  sbf_bone *bones = (sbf_bone *)(uintptr_t)c.asset->bones.at; /* the test's own */
  bones[c.asset->bones.count - 1].id = "gait.walk";
  ck_assert_int_eq(sbf_convert_gait(c.asset, NULL, &error), SBF_OK);
  ck_assert_str_ne(c.asset->gaits.at[0].id, "gait.walk");
  converted_free(&c);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_gait");
  TCase *tests = tcase_create("convert_gait");
  tcase_add_loop_test(tests, a_gait_proposed_later_is_the_same, 0, 2);
  tcase_add_test(tests, rigs_without_legs_are_reported);
  tcase_add_test(tests, used_ids_are_not_reassigned);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
