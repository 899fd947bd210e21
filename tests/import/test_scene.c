#include "import/scene/scene.h"

#include <stdio.h>
#include <string.h>

#include "harness.h"

START_TEST(strings_become_text)
{
  sbfi_scene scene;
  ck_assert(sbfi_scene_init(&scene, NULL, 0, "a.obj"));
  ck_assert_str_eq(sbfi_scene_string(&scene, sbfi_span_of("K\xC3\xB6rper")), "K\xC3\xB6rper");
  ck_assert_str_eq(sbfi_scene_string(&scene, sbfi_span_of("a\xFF\tb")), "a\xEF\xBF\xBD\xEF\xBF\xBD"
                                                                        "b");
  ck_assert_str_eq(sbfi_scene_string(&scene, (sbfi_span){"a\0b", 3}), "a\xEF\xBF\xBD"
                                                                      "b");
  ck_assert_str_eq(sbfi_scene_string(&scene, sbfi_span_of("a\xEF\xBF\xBE"
                                                          "b\xEF\xBF\xBD")),
      "a\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"
      "b\xEF\xBF\xBD");
  ck_assert_str_eq(sbfi_scene_string(&scene, (sbfi_span){NULL, 0}), "");
  static char longest[5000];
  memset(longest, 'n', sizeof longest - 1);
  ck_assert_uint_eq(strlen(sbfi_scene_string(&scene, sbfi_span_of(longest))), 1024);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(warnings_beyond_the_list_are_counted)
{
  sbfi_scene scene;
  ck_assert(sbfi_scene_init(&scene, NULL, 0, "a.obj"));
  for (uint32_t i = 0; i < SBFI_SCENE_WARNINGS + 3; i++)
    ck_assert(sbfi_scene_warn(&scene, SBF_CODE_IMPORT_IGNORED, i, "thing %u", i));
  ck_assert_uint_eq(scene.warning_count, SBFI_SCENE_WARNINGS);
  ck_assert_uint_eq(scene.warnings_left_out, 3);
  ck_assert_str_eq(scene.warnings[5].message, "thing 5");
  ck_assert_uint_eq(scene.warnings[5].line, 5);
  ck_assert_int_eq(scene.warnings[5].severity, SBF_SEVERITY_WARNING);
  ck_assert_str_eq(scene.warnings[5].file, "a.obj");
  sbfi_scene_free(&scene);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(worlds_are_products_down_the_tree)
{
  sbfi_scene_node nodes[3] = {{.parent = SBF_NONE}, {.parent = 0}, {.parent = 1}};
  for (int i = 0; i < 3; i++) {
    nodes[i].local = sbfi_matrix_identity();
    nodes[i].local.at[0][3] = i + 1;
  }
  nodes[0].local.at[0][0] = 10; /* ten times wider below */
  sbfi_scene_set_worlds(nodes, 3);
  ck_assert_double_eq(nodes[2].world.at[0][3], 1 + 10 * (2 + 3));
  ck_assert_double_eq(nodes[2].world.at[0][0], 10);
}
END_TEST

static Suite *scene_suite(void) {
  Suite *suite = suite_create("scene");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, strings_become_text);
  tcase_add_test(tests, warnings_beyond_the_list_are_counted);
  tcase_add_test(tests, worlds_are_products_down_the_tree);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(scene_suite());
}
