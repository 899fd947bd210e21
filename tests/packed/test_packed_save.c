#include "sbfmt/packed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fill_asset.h"
#include "harness.h"
#include "packed_patch.h"
#include "small_asset.h"

static sbf_buffer save(const sbf_asset *asset, const sbf_save_options *options) {
  sbf_buffer buffer;
  sbf_diagnostic error;
  sbf_status status = sbf_packed_save_memory(asset, options, NULL, &buffer, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
  return buffer;
}

START_TEST(test_saved_again_the_bytes_are_the_same)
{
  for (uint64_t seed = 0; seed < 6; seed++)
    for (int store = 0; store < 2; store++) {
      sbf_asset *asset = fill_asset(&(fill_options){.seed = seed, .items = seed % 2 ? 300 : 0}), *loaded;
      sbf_save_options save_options = {.store = store, .level = (int)seed};
      sbf_load_options options = fill_load_options(asset);
      sbf_buffer first = save(asset, &save_options), again;
      ck_assert_int_eq(sbf_packed_load_memory(first.at, first.size, &options, &loaded, NULL), SBF_OK);
      again = save(loaded, &save_options);
      ck_assert_uint_eq(first.size, again.size);
      ck_assert_mem_eq(first.at, again.at, first.size);
      sbf_buffer_free(&first);
      sbf_buffer_free(&again);
      sbf_asset_free(loaded);
      sbf_asset_free(asset);
    }
}
END_TEST

START_TEST(test_file_and_memory_have_the_same_bytes)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 4});
  sbf_buffer buffer = save(asset, NULL);
  const char *path = harness_scratch("same.sbfz");
  size_t size;
  ck_assert_int_eq(sbf_packed_save_file(asset, path, NULL, NULL), SBF_OK);
  char *written = harness_read(path, &size);
  ck_assert_uint_eq(size, buffer.size);
  ck_assert_mem_eq(written, buffer.at, size);
  free(written);
  sbf_buffer_free(&buffer);
  sbf_asset_free(asset);
}
END_TEST

/* What the specification promises of every file that is written. */
START_TEST(test_layout)
{
  for (int store = 0; store < 2; store++) {
    sbf_asset *asset = fill_asset(&(fill_options){.seed = 9, .items = 500});
    sbf_buffer file = save(asset, &(sbf_save_options){.store = store});
    uint64_t count = patch_get(file.at, 40, 4), end = 64 + 64 * count;
    bool lists = false;
    uint32_t compressed = 0;
    for (uint32_t i = 0; i < count; i++) {
      const uint8_t *entry = file.at + patch_entry(i, 0);
      uint64_t offset = patch_get(entry, PATCH_OFFSET, 8), stored = patch_get(entry, PATCH_STORED_SIZE, 8);
      uint64_t raw = patch_get(entry, PATCH_RAW_SIZE, 8);
      ck_assert_uint_eq(offset, (end + 63) / 64 * 64);
      for (; end < offset; end++) ck_assert_uint_eq(file.at[end], 0);
      end = offset + stored;
      bool is_list = patch_get(entry, PATCH_FIELD, 2) != 0, is_outline = memcmp(entry, "OUTL", 4) == 0;
      ck_assert_int_eq(is_outline, count > 128 && i == count - 1);
      ck_assert(is_list || is_outline || !lists); /* records first */
      lists = is_list;
      if (is_list) ck_assert_uint_ge(raw, store ? 256 : 1024);
      ck_assert_uint_eq(patch_get(entry, PATCH_FLAGS, 2), is_outline ? 0 : 1);
      if (patch_get(entry, PATCH_CODEC, 1)) {
        compressed++;
        ck_assert_uint_le(stored, raw - raw / 16);
        ck_assert_uint_lt((stored + 63) / 64, (raw + 63) / 64);
      } else {
        ck_assert_uint_eq(stored, raw);
      }
    }
    ck_assert_uint_eq(end, file.size);
    ck_assert_int_eq(store, compressed == 0);
    sbf_buffer_free(&file);
    sbf_asset_free(asset);
  }
}
END_TEST

START_TEST(test_default_asset_is_small)
{
  sbf_asset *asset = sbf_asset_create(NULL), *loaded;
  sbf_buffer file = save(asset, NULL);
  ck_assert_uint_le(file.size, 64 + 64 + 64);
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, NULL, &loaded, NULL), SBF_OK);
  ck_assert(sbf_asset_equal(asset, loaded, NULL, 0));
  sbf_asset_free(loaded);
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_assets_that_could_not_load_are_not_saved)
{
  sbf_asset *asset = small_asset();
  sbf_diagnostic error;
  sbf_buffer buffer;
  const char *path = harness_scratch("refused.sbfz");
  ck_assert(harness_write(path, "old", 3));
  asset->environment.wind.y = NAN;
  ck_assert_int_eq(sbf_packed_save_memory(asset, NULL, NULL, &buffer, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_VALUE_NOT_FINITE);
  ck_assert_ptr_null(buffer.at);
  ck_assert_int_eq(sbf_packed_save_file(asset, path, NULL, &error), SBF_BAD_INPUT);
  ck_assert_str_eq(error.file, path);
  size_t size;
  char *old = harness_read(path, &size);
  ck_assert_uint_eq(size, 3);
  free(old);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_unwritable_path_is_refused)
{
  sbf_asset *asset = small_asset();
  sbf_diagnostic error;
  const char *path = harness_scratch("no-such-folder/x.sbfz");
  ck_assert_int_eq(sbf_packed_save_file(asset, path, NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_str_eq(error.file, path);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_every_failed_allocation_frees_everything)
{
  for (int store = 0; store < 2; store++) {
    sbf_asset *asset = fill_asset(&(fill_options){.seed = 2, .items = 100});
    size_t allowed = 0;
    for (sbf_status status = SBF_FAILED; status != SBF_OK; allowed++) {
      harness_memory memory;
      sbf_buffer buffer;
      sbf_diagnostic error;
      harness_memory_init(&memory, allowed);
      status = sbf_packed_save_memory(
          asset, &(sbf_save_options){.store = store}, &memory.allocator, &buffer, &error);
      if (status != SBF_OK) {
        ck_assert_int_eq(status, SBF_FAILED);
        ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
      }
      sbf_buffer_free(&buffer);
      ck_assert_uint_eq(memory.held_bytes, 0);
    }
    ck_assert_uint_gt(allowed, 8);
    sbf_asset_free(asset);
  }
}
END_TEST

/* Saving to a file takes the asset's own allocator. */
START_TEST(test_every_failed_allocation_of_a_save_to_a_file)
{
  harness_memory memory;
  harness_memory_init(&memory, SIZE_MAX);
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 2, .allocator = &memory.allocator});
  const char *path = harness_scratch("allocations.sbfz");
  size_t pinned = memory.held_bytes, allowed = 0;
  unlink(path);
  for (sbf_status status = SBF_FAILED; status != SBF_OK; allowed++) {
    memory.allowed = memory.calls + allowed;
    ck_assert_ptr_null(harness_read(path, NULL));
    status = sbf_packed_save_file(asset, path, NULL, NULL);
    ck_assert_uint_eq(memory.held_bytes, pinned);
  }
  ck_assert_uint_gt(allowed, 8);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_save");
  TCase *tests = tcase_create("packed_save");
  tcase_add_test(tests, test_saved_again_the_bytes_are_the_same);
  tcase_add_test(tests, test_file_and_memory_have_the_same_bytes);
  tcase_add_test(tests, test_layout);
  tcase_add_test(tests, test_default_asset_is_small);
  tcase_add_test(tests, test_assets_that_could_not_load_are_not_saved);
  tcase_add_test(tests, test_unwritable_path_is_refused);
  tcase_add_test(tests, test_every_failed_allocation_frees_everything);
  tcase_add_test(tests, test_every_failed_allocation_of_a_save_to_a_file);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
