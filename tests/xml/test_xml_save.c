#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fill_asset.h"
#include "harness.h"
#include "sbfmt/io.h"

START_TEST(test_file_and_memory_get_the_same_bytes)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 1, .items = 2000});
  const char *path = harness_scratch("save.sbf");
  sbf_buffer buffer;
  size_t size;
  ck_assert_int_eq(sbf_xml_save_memory(asset, NULL, NULL, &buffer, NULL), SBF_OK);
  ck_assert_int_eq(sbf_xml_save_file(asset, path, NULL, NULL), SBF_OK);
  char *bytes = harness_read(path, &size);
  ck_assert_uint_eq(size, buffer.size);
  ck_assert_int_eq(memcmp(bytes, buffer.at, size), 0);
  free(bytes);
  sbf_buffer_free(&buffer);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_assets_that_could_not_load_are_not_saved)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  const char *path = harness_scratch("kept.sbf");
  sbf_buffer buffer = {0};
  sbf_diagnostic error = {0};
  ck_assert(harness_write(path, "old", 3));
  asset->environment.wind.y = NAN;
  ck_assert_int_eq(sbf_xml_save_file(asset, path, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_VALUE_NOT_FINITE);
  ck_assert_str_eq(error.path, "/sbf/environment/@wind");
  ck_assert_int_eq(sbf_xml_save_memory(asset, NULL, NULL, &buffer, NULL), SBF_BAD_INPUT);
  ck_assert_ptr_null(buffer.at);
  char *bytes = harness_read(path, NULL);
  ck_assert_str_eq(bytes, "old");
  free(bytes);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_unwritable_path)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_diagnostic error = {0};
  const char *path = harness_scratch("no/such/folder/a.sbf");
  ck_assert_int_eq(sbf_xml_save_file(asset, path, NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_str_eq(error.file, path);
  ck_assert_int_eq(sbf_xml_save_file(asset, path, NULL, NULL), SBF_FAILED);
  sbf_asset_free(asset);
}
END_TEST

/* The device that is always full: the write that fails is not the first. */
START_TEST(test_full_disk)
{
  FILE *full = fopen("/dev/full", "wb");
  if (!full) {
    harness_skip("/dev/full cannot be opened");
    return;
  }
  fclose(full);
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 1, .items = 20000});
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbf_xml_save_file(asset, "/dev/full", NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_memory_runs_out)
{
  const char *path = harness_scratch("memory.sbf");
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, SIZE_MAX);
    sbf_asset *asset = fill_asset(&(fill_options){.seed = 2, .allocator = &memory.allocator});
    size_t pinned = memory.held_bytes;
    ck_assert(harness_write(path, "old", 3));
    memory.allowed = memory.calls + allowed;
    sbf_diagnostic error = {0};
    sbf_status status = sbf_xml_save_file(asset, path, NULL, &error);
    ck_assert_uint_eq(memory.held_bytes, pinned);
    char *bytes = harness_read(path, NULL);
    ck_assert_int_eq(strcmp(bytes, "old") == 0, status != SBF_OK);
    free(bytes);
    if (status != SBF_OK) ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    memory.allowed = SIZE_MAX;
    sbf_asset_free(asset);
    if (status == SBF_OK) break;
    ck_assert_uint_lt(allowed, 1000);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("xml_save");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_file_and_memory_get_the_same_bytes);
  tcase_add_test(all, test_assets_that_could_not_load_are_not_saved);
  tcase_add_test(all, test_unwritable_path);
  tcase_add_test(all, test_full_disk);
  tcase_add_test(all, test_memory_runs_out);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
