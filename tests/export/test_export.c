#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"
#include "sbfmt/convert.h"
#include "sbfmt/export.h"

static sbf_asset *bar(void) {
  sbf_asset *asset;
  ck_assert_int_eq(
      sbf_convert(harness_source("spec/samples/dialect2012/bar.xml"), NULL, &asset, NULL), SBF_OK);
  return asset;
}

START_TEST(the_2012_dialect_goes_round)
{
  sbf_asset *asset = bar();
  const char *path = harness_scratch("round.xml");
  size_t size, expected_size;
  ck_assert_int_eq(sbf_export(asset, path, NULL, NULL), SBF_OK);
  char *written = harness_read(path, &size);
  char *expected = harness_read(harness_source("spec/samples/dialect2012/bar.xml"), &expected_size);
  ck_assert_ptr_nonnull(written);
  ck_assert_ptr_nonnull(expected);
  ck_assert_uint_eq(size, expected_size);
  ck_assert(memcmp(written, expected, size) == 0);
  free(written);
  free(expected);
  sbf_asset_free(asset);
}
END_TEST

static void keep(void *user, const sbf_diagnostic *diagnostic) {
  *(sbf_diagnostic *)user = *diagnostic;
}

START_TEST(what_is_left_out_is_said)
{
  sbf_asset *asset = bar();
  sbf_diagnostic warning = {0};
  const sbf_export_options options = {.report = keep, .user = &warning};
  ck_assert_int_eq(sbf_export(asset, harness_scratch("bar.tet"), &options, NULL), SBF_OK);
  ck_assert_int_eq(warning.code, SBF_CODE_EXPORT_LEFT_OUT);
  ck_assert_ptr_nonnull(strstr(warning.message, "rigid bodies: 2"));
  sbf_asset_free(asset);
}
END_TEST

START_TEST(nothing_to_write_and_unknown_endings_are_errors)
{
  sbf_asset *empty = sbf_asset_create(NULL);
  sbf_diagnostic error;
  static const char *const names[] = {"empty.obj", "empty.tet", "empty.xml"};
  for (int i = 0; i < 3; i++) {
    const char *path = harness_scratch(names[i]);
    size_t size;
    ck_assert_int_eq(sbf_export(empty, path, NULL, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, SBF_CODE_EXPORT_EMPTY);
    ck_assert_ptr_null(harness_read(path, &size));
  }
  ck_assert_int_eq(sbf_export(empty, "no_ending", NULL, &error), SBF_FAILED);
  ck_assert_int_eq(sbf_export(empty, "a.stl", NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_BAD_CALL);
  const sbf_export_options wrong = {.struct_size = 3};
  ck_assert_int_eq(sbf_export(empty, "a.obj", &wrong, &error), SBF_FAILED);
  sbf_asset_free(empty);
}
END_TEST

START_TEST(memory_that_runs_out_is_reported)
{
  sbf_asset *asset = bar();
  static const char *const names[] = {"memory.obj", "memory.tet", "memory.xml"};
  for (int i = 0; i < 3; i++)
    for (size_t allowed = 0;; allowed++) {
      harness_memory memory;
      sbf_diagnostic error;
      harness_memory_init(&memory, allowed);
      sbf_status status = sbf_export(
          asset, harness_scratch(names[i]), &(sbf_export_options){.allocator = &memory.allocator}, &error);
      ck_assert_uint_eq(memory.held_bytes, 0);
      if (status == SBF_OK) break;
      ck_assert_int_eq(status, SBF_FAILED);
      ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
      ck_assert_uint_lt(allowed, 1000);
    }
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("export");
  TCase *c = tcase_create("forms");
  tcase_add_test(c, the_2012_dialect_goes_round);
  tcase_add_test(c, what_is_left_out_is_said);
  tcase_add_test(c, nothing_to_write_and_unknown_endings_are_errors);
  tcase_add_test(c, memory_that_runs_out_is_reported);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
