#include "model/options.h"

#include <stddef.h>

#include "harness.h"

START_TEST(test_zero_means_the_documented_default)
{
  sbf_load_options load = sbfi_load_options_of(NULL);
  ck_assert_uint_eq(load.limits.file_bytes, UINT64_C(1) << 32);
  ck_assert_uint_eq(load.limits.memory_bytes, UINT64_C(1) << 32);
  ck_assert_uint_eq(sbfi_inflated_limit(&load.limits, 0), 64 << 20);
  ck_assert_uint_eq(sbfi_inflated_limit(&load.limits, 3 << 20), 192 << 20);
  ck_assert_uint_eq(sbfi_inflated_limit(&load.limits, UINT64_MAX), UINT64_C(1) << 32);
  ck_assert_uint_eq(load.limits.inflate_ratio, 1100);
  ck_assert_uint_eq(load.limits.list_items, 1u << 30);
  ck_assert_uint_eq(load.limits.depth, 32);
  ck_assert(!load.check_crc && !load.selection && !load.copy_file);
  ck_assert_int_eq(sbfi_save_options_of(NULL).level, 6);
}
END_TEST

START_TEST(test_given_options_are_kept)
{
  sbf_load_options load = sbfi_load_options_of(
      &(sbf_load_options){.limits = {.inflate_ratio = 7}, .check_crc = true, .copy_file = true});
  ck_assert_uint_eq(load.limits.inflate_ratio, 7);
  ck_assert_uint_eq(sbfi_inflated_limit(&(sbf_limits){.inflated_bytes = 9}, 1 << 20), 9);
  ck_assert_uint_eq(load.limits.depth, 32);
  ck_assert(load.check_crc && load.copy_file);
  ck_assert_int_eq(sbfi_save_options_of(&(sbf_save_options){.level = 9}).level, 9);
  ck_assert_int_eq(sbfi_save_options_of(&(sbf_save_options){.level = 10}).level, 6);
}
END_TEST

START_TEST(test_a_shorter_struct_of_an_older_caller_is_not_read_past_its_end)
{
  sbf_load_options load = {.struct_size = offsetof(sbf_load_options, check_crc), .check_crc = true};
  load.limits.depth = 5;
  ck_assert(!sbfi_load_options_of(&load).check_crc);
  ck_assert_uint_eq(sbfi_load_options_of(&load).limits.depth, 5);
}
END_TEST

START_TEST(test_options_of_any_version_are_accepted)
{
  struct {
    size_t struct_size;
    int old, young;
  } given = {0, 1, 2}, taken = {0};
  ck_assert(sbfi_options_copy(&taken, sizeof taken, NULL));
  ck_assert_int_eq(taken.old, 0);
  ck_assert(sbfi_options_copy(&taken, sizeof taken, &given));
  ck_assert_int_eq(taken.young, 2);
  taken.young = 0;
  given.struct_size = sizeof(size_t) + sizeof(int);
  ck_assert(sbfi_options_copy(&taken, sizeof taken, &given));
  ck_assert(taken.old == 1 && taken.young == 0);
  given.struct_size = sizeof given + 100; /* of a newer version: known members are read */
  ck_assert(sbfi_options_copy(&taken, sizeof taken, &given));
  ck_assert_int_eq(taken.young, 2);
  given.struct_size = 3;
  ck_assert(!sbfi_options_copy(&taken, sizeof taken, &given));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("options");
  TCase *tests = tcase_create("options");
  tcase_add_test(tests, test_zero_means_the_documented_default);
  tcase_add_test(tests, test_given_options_are_kept);
  tcase_add_test(tests, test_a_shorter_struct_of_an_older_caller_is_not_read_past_its_end);
  tcase_add_test(tests, test_options_of_any_version_are_accepted);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
