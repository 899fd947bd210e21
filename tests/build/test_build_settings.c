#include <check.h>

#include "build/build_settings.h"
#include "harness.h"

START_TEST(test_what_a_build_states)
{
  sbf_build_options options = {0};
  ck_assert(
      sbfi_build_settings_read("embeddings=false flexion=true hulls=false interior=centroid", &options));
  ck_assert(options.without_embeddings && !options.without_flexion && options.without_hulls);
  ck_assert_int_eq(options.interior, SBF_BUILD_INTERIOR_CENTROID);
  ck_assert(sbfi_build_settings_read("", &options));
}
END_TEST

START_TEST(test_what_it_does_not_know)
{
  sbf_build_options options = {0};
  ck_assert(!sbfi_build_settings_read("interior=unheard_of", &options));
  ck_assert(!sbfi_build_settings_read("flexion=perhaps", &options));
  ck_assert(!sbfi_build_settings_read("magic=true", &options));
  ck_assert(!sbfi_build_settings_read("flexion", &options));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("build_settings");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_what_a_build_states);
  tcase_add_test(all, test_what_it_does_not_know);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
