/* Characters as binary glTF: written files read back equal, and damaged files are refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fill_asset.h"
#include "harness.h"
#include "packed/packed_format.h"
#include "promises.h"
#include "sbfmt/export.h"
#include "sbfmt/gltf.h"
#include "small_asset.h"

static const char *const scratch = "soft_body.glb";

static char *write_glb(const sbf_asset *asset, bool store, size_t *size) {
  const char *path = harness_scratch(scratch);
  sbf_diagnostic error;
  sbf_status status =
      sbf_export(asset, path, &(sbf_export_options){.soft_bodies = true, .store = store}, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  char *bytes = harness_read(path, size);
  ck_assert_ptr_nonnull(bytes);
  return bytes;
}

static char *small_file(size_t *size) {
  sbf_asset *asset = small_asset();
  char *bytes = write_glb(asset, false, size);
  sbf_asset_free(asset);
  return bytes;
}

START_TEST(test_every_field_round_trips)
{
  for (uint64_t seed = 0; seed < 6; seed++)
    for (int store = 0; store < 2; store++) {
      sbf_asset *asset = fill_asset(&(fill_options){.seed = seed, .items = seed % 2 ? 400 : 0}), *loaded;
      sbf_load_options options = fill_load_options(asset);
      sbf_diagnostic error;
      size_t size;
      char path[256], *bytes = write_glb(asset, store, &size);
      sbf_status status = sbf_gltf_load_memory(bytes, size, &options, &loaded, &error);
      ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
      ck_assert_msg(sbf_asset_equal(asset, loaded, path, sizeof path), "%s", path);
      ck_assert_str_eq(loaded->soft_bodies.at[0].levels.at[0].simulation.measured.at[0].machine,
          asset->soft_bodies.at[0].levels.at[0].simulation.measured.at[0].machine);
      sbf_asset_free(loaded);
      free(bytes);
      sbf_asset_free(asset);
    }
}
END_TEST

START_TEST(test_equal_assets_give_equal_bytes)
{
  size_t size, other_size;
  sbf_asset *loaded;
  char *bytes = small_file(&size);
  ck_assert_int_eq(sbf_gltf_load_memory(bytes, size, NULL, &loaded, NULL), SBF_OK);
  char *other = write_glb(loaded, false, &other_size);
  ck_assert_uint_eq(size, other_size);
  ck_assert_mem_eq(bytes, other, size);
  sbf_asset_free(loaded);
  free(other);
  free(bytes);
}
END_TEST

START_TEST(test_damaged_files_are_refused_or_valid)
{
  size_t size;
  char *bytes = small_file(&size);
  for (size_t at = 0; at < size; at += HARNESS_FEW(1, 7))
    for (int bit = 0; bit < 8; bit += HARNESS_FEW(3, 7)) {
      sbf_asset *loaded = NULL;
      sbf_diagnostic error = {0};
      bytes[at] = (char)(bytes[at] ^ 1 << bit);
      sbf_status status = sbf_gltf_load_memory(bytes, size, NULL, &loaded, &error);
      ck_assert_int_eq(status == SBF_OK, loaded != NULL);
      if (loaded)
        ck_assert_promises_kept(loaded);
      else
        ck_assert_msg(*error.message && error.code, "byte %zu", at);
      sbf_asset_free(loaded);
      bytes[at] = (char)(bytes[at] ^ 1 << bit);
    }
  free(bytes);
}
END_TEST

START_TEST(test_every_shorter_file_is_refused)
{
  size_t size;
  char *bytes = small_file(&size);
  for (size_t shorter = 0; shorter < size; shorter += HARNESS_FEW(1, 11)) {
    sbf_asset *loaded;
    sbf_diagnostic error;
    char *copy = malloc(shorter + 1); /* of just that size: a sanitizer sees a read behind it */
    memcpy(copy, bytes, shorter);
    if (shorter >= 12)
      sbfi_put_u32((uint8_t *)copy + 8, (uint32_t)shorter); /* the length that the header states */
    ck_assert_int_eq(sbf_gltf_load_memory(copy, shorter, NULL, &loaded, &error), SBF_BAD_INPUT);
    free(copy);
  }
  free(bytes);
}
END_TEST

/* Replaces the first occurrence of `from` by a text of the same length. */
static void replace(char *bytes, size_t size, const char *from, const char *to) {
  size_t length = strlen(from);
  ck_assert_uint_eq(length, strlen(to));
  for (size_t at = 0; at + length <= size; at++)
    if (memcmp(bytes + at, from, length) == 0) {
      memcpy(bytes + at, to, length);
      return;
    }
  ck_abort_msg("%s does not occur", from);
}

static void expect(const char *from, const char *to, sbf_code code) {
  size_t size;
  sbf_asset *loaded;
  sbf_diagnostic error = {0};
  char *bytes = small_file(&size);
  replace(bytes, size, from, to);
  ck_assert_int_ne(sbf_gltf_load_memory(bytes, size, NULL, &loaded, &error), SBF_OK);
  ck_assert_msg(error.code == (int32_t)code, "%s: %d %s", to, error.code, error.message);
  free(bytes);
}

START_TEST(test_faults_have_their_codes)
{
  expect("glTF", "glTG", SBF_CODE_GLTF_SYNTAX);
  expect("\"SBF_soft_body\":", "\"SBF_soft_bodx\":", SBF_CODE_GLTF_NO_SOFT_BODY);
  expect("\"version\":\"2.0\"", "\"version\":\"1.0\"", SBF_CODE_GLTF_SYNTAX);
  expect("\"version\":\"1.", "\"version\":\"9.", SBF_CODE_VERSION_TOO_NEW);
  expect("\"soft_bodies\"", "\"soft_bodiez\"", SBF_CODE_GLTF_EXTENSION);
}
END_TEST

START_TEST(test_every_failing_allocation_is_reported)
{
  size_t size;
  char *bytes = small_file(&size);
  bool done = false;
  for (size_t allowed = 0; !done; allowed++) {
    harness_memory memory;
    sbf_asset *loaded = NULL;
    sbf_diagnostic error = {0};
    harness_memory_init(&memory, allowed);
    sbf_status status = sbf_gltf_load_memory(
        bytes, size, &(sbf_load_options){.allocator = &memory.allocator}, &loaded, &error);
    done = status == SBF_OK;
    ck_assert_msg(done || error.code == SBF_CODE_OUT_OF_MEMORY, "%zu: %s", allowed, error.message);
    sbf_asset_free(loaded);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  free(bytes);
  sbf_asset *asset = small_asset();
  remove(harness_scratch("unwritten.glb"));
  done = false;
  for (size_t allowed = 0; !done; allowed++) {
    harness_memory memory;
    sbf_diagnostic error = {0};
    harness_memory_init(&memory, allowed);
    sbf_status status = sbf_export(asset, harness_scratch("unwritten.glb"),
        &(sbf_export_options){.soft_bodies = true, .allocator = &memory.allocator}, &error);
    done = status == SBF_OK;
    ck_assert_msg(done || error.code == SBF_CODE_OUT_OF_MEMORY, "%zu: %s", allowed, error.message);
    ck_assert_uint_eq(memory.held_bytes, 0);
    FILE *file = fopen(harness_scratch("unwritten.glb"), "rb");
    ck_assert_int_eq(file != NULL, done); /* nothing half written */
    if (file) fclose(file);
  }
  sbf_asset_free(asset);
}
END_TEST

static Suite *soft_body_glb_suite(void) {
  Suite *suite = suite_create("soft_body_glb");
  TCase *c = tcase_create("soft_body_glb");
  tcase_set_timeout(c, 300);
  tcase_add_test(c, test_every_field_round_trips);
  tcase_add_test(c, test_equal_assets_give_equal_bytes);
  tcase_add_test(c, test_damaged_files_are_refused_or_valid);
  tcase_add_test(c, test_every_shorter_file_is_refused);
  tcase_add_test(c, test_faults_have_their_codes);
  tcase_add_test(c, test_every_failing_allocation_is_reported);
  suite_add_tcase(suite, c);
  return suite;
}

int main(void) {
  return harness_run(soft_body_glb_suite());
}
