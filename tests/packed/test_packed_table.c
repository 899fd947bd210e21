#include "packed/packed_table.h"

#include <stdlib.h>

#include "harness.h"
#include "model/options.h"
#include "packed/packed_codec.h"
#include "packed_patch.h"
#include "small_asset.h"

static sbf_buffer file; /* stored; each test's own copy, as Check forks */

static void make_file(void) {
  sbf_asset *asset = small_asset();
  ck_assert_int_eq(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = true}, NULL, &file, NULL), SBF_OK);
  sbf_asset_free(asset);
}

static void free_file(void) {
  sbf_buffer_free(&file);
}

static sbf_status read_table(const void *bytes, size_t size, sbf_diagnostic *error) {
  sbfi_packed_table table;
  sbf_limits limits = sbfi_load_options_of(NULL).limits;
  sbf_status status = sbfi_packed_table_read(&table, bytes, size, &limits, NULL, error);
  if (status == SBF_OK) sbfi_packed_table_free(&table);
  return status;
}

static void expect(sbf_code code, int64_t offset) {
  sbf_diagnostic error;
  sbf_status status = read_table(file.at, file.size, &error);
  ck_assert_int_ne(status, SBF_OK);
  ck_assert_msg(error.code == (int32_t)code, "code %d, not %d: %s", error.code, (int)code, error.message);
  if (offset >= 0) ck_assert_int_eq(error.offset, offset);
}

/* Puts a number where it does not belong, mends the checksums and puts the old one back. */
static void expect_patched(size_t offset, int size, uint64_t value, sbf_code code) {
  uint8_t *copy = malloc(file.size);
  memcpy(copy, file.at, file.size);
  patch_put(file.at, offset, size, value);
  patch_seal(file.at, file.size);
  expect(code, -1);
  memcpy(file.at, copy, file.size);
  free(copy);
}

START_TEST(test_the_header_identifies_the_file)
{
  make_file();
  ck_assert_mem_eq(file.at, "\x89SBF\r\n\x1a\n", 8);
  ck_assert_uint_eq(patch_get(file.at, 8, 2), 1);
  ck_assert_uint_eq(patch_get(file.at, 12, 2), 1);
  ck_assert_uint_eq(patch_get(file.at, 16, 8), file.size);
  ck_assert_uint_eq(patch_get(file.at, 24, 8), 64);
  ck_assert_uint_eq(patch_get(file.at, 32, 8), 64 * patch_get(file.at, 40, 4));
  ck_assert_mem_eq(file.at + patch_entry(0, PATCH_KIND), "ROOT", 4);
  ck_assert_int_eq(read_table(file.at, file.size, NULL), SBF_OK);
  free_file();
}
END_TEST

/* "section tail, level 1": the table alone says which chunks those are. */
START_TEST(test_chunks_of_a_level_are_found_from_the_table)
{
  make_file();
  uint32_t records = 0, lists = 0;
  for (uint32_t i = 0; i < patch_get(file.at, 40, 4); i++) {
    const uint8_t *entry = file.at + patch_entry(i, 0);
    if (memcmp(entry, "LEVL", 4) != 0 || patch_get(entry, PATCH_OWNER, 4) != 1 ||
        patch_get(entry, PATCH_LEVEL, 4) != 1)
      continue;
    bool record = patch_get(entry, PATCH_FIELD, 2) == 0;
    records += record;
    lists += !record;
  }
  ck_assert_uint_eq(records, 1);
  ck_assert_uint_eq(lists, 2); /* positions and the springs' ends */
  free_file();
}
END_TEST

START_TEST(test_damage_of_a_transfer_is_named)
{
  sbf_diagnostic error;
  make_file();
  struct {
    const char *bytes;
    size_t size;
    sbf_code code;
  } cases[] = {
      {"", 0, SBF_CODE_PACKED_TRUNCATED},
      {"\x89SBF\r", 5, SBF_CODE_PACKED_TRUNCATED},
      {"\x89SBF\r\n\x1a\n", 8, SBF_CODE_PACKED_TRUNCATED},
      {"\x89SBF\n\x1a\n....", 11, SBF_CODE_PACKED_MAGIC},
      {"\x89SBF\r\r\n\x1a\r\n..", 12, SBF_CODE_PACKED_MAGIC},
      {"\x09SBF\r\n\x1a\n", 8, SBF_CODE_PACKED_MAGIC},
      {"<?xml version", 13, SBF_CODE_PACKED_MAGIC},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ck_assert_int_eq(read_table(cases[i].bytes, cases[i].size, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, cases[i].code);
  }
  ck_assert_ptr_nonnull(strstr((read_table(cases[3].bytes, 11, &error), error.message), "line ends"));
  free_file();
}
END_TEST

START_TEST(test_header_faults)
{
  make_file();
  uint64_t size = file.size, count = patch_get(file.at, 40, 4);
  expect_patched(8, 2, 0, SBF_CODE_PACKED_TABLE);     /* version */
  expect_patched(12, 2, 2, SBF_CODE_VERSION_TOO_NEW); /* least reader */
  expect_patched(14, 2, SBFI_PACKED_MINOR + 1, SBF_CODE_VERSION_TOO_NEW);
  expect_patched(16, 8, size + 1, SBF_CODE_PACKED_TRUNCATED);
  expect_patched(16, 8, size - 1, SBF_CODE_PACKED_TABLE);
  expect_patched(16, 8, UINT64_MAX, SBF_CODE_PACKED_TRUNCATED);
  expect_patched(24, 8, 0, SBF_CODE_PACKED_TABLE); /* table offset */
  expect_patched(24, 8, 65, SBF_CODE_PACKED_TABLE);
  expect_patched(24, 8, size / 64 * 64, SBF_CODE_PACKED_TABLE);
  expect_patched(24, 8, UINT64_MAX - 63, SBF_CODE_PACKED_TABLE);
  expect_patched(32, 8, 64 * count - 64, SBF_CODE_PACKED_TABLE); /* table size */
  expect_patched(40, 4, count + 1, SBF_CODE_PACKED_TABLE);       /* count */
  expect_patched(40, 4, UINT32_MAX, SBF_CODE_PACKED_TABLE);
  expect_patched(48, 4, 1, SBF_CODE_PACKED_TABLE); /* reserved */
  expect_patched(56, 4, 1, SBF_CODE_PACKED_TABLE);
  file.at[60] ^= 1; /* the checksum itself */
  expect(SBF_CODE_PACKED_CRC, 60);
  file.at[60] ^= 1;
  file.at[patch_entry(2, PATCH_OWNER)] ^= 1;
  expect(SBF_CODE_PACKED_CRC, 64);
  free_file();
}
END_TEST

/* Bytes behind the end that the header states, be it one or a whole block. */
START_TEST(test_something_was_added)
{
  make_file();
  sbf_diagnostic error;
  uint8_t *longer = calloc(1, file.size + 64);
  memcpy(longer, file.at, file.size);
  for (size_t more = 1; more <= 64; more += 21) {
    ck_assert_int_eq(read_table(longer, file.size + more, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, SBF_CODE_PACKED_TABLE);
    ck_assert_int_eq(error.offset, (int64_t)file.size);
  }
  free(longer);
  free_file();
}
END_TEST

START_TEST(test_count_of_zero)
{
  make_file();
  patch_put(file.at, 40, 4, 0);
  patch_put(file.at, 32, 8, 0);
  patch_seal(file.at, file.size);
  expect(SBF_CODE_PACKED_TABLE, -1);
  free_file();
}
END_TEST

START_TEST(test_entry_faults)
{
  make_file();
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  for (uint32_t i = 1; i <= last; i++) {
    uint64_t offset = patch_get(file.at, patch_entry(i, PATCH_OFFSET), 8);
    uint64_t stored = patch_get(file.at, patch_entry(i, PATCH_STORED_SIZE), 8);
    uint64_t count = patch_get(file.at, patch_entry(i, PATCH_COUNT), 8);
    expect_patched(patch_entry(i, PATCH_OFFSET), 8, offset + 4, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_OFFSET), 8, 0, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_OFFSET), 8, 64, SBF_CODE_PACKED_TABLE); /* the table's place */
    expect_patched(patch_entry(i, PATCH_OFFSET), 8, (file.size + 63) / 64 * 64, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_OFFSET), 8, UINT64_MAX - 63, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_OFFSET), 8, patch_get(file.at, patch_entry(i - 1, PATCH_OFFSET), 8),
        SBF_CODE_PACKED_TABLE); /* over the one before */
    expect_patched(patch_entry(i, PATCH_STORED_SIZE), 8, stored + 1, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_STORED_SIZE), 8, UINT64_MAX - offset + 1, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_RAW_SIZE), 8, stored - 1, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_COUNT), 8, count + 1, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_COUNT), 8, UINT64_MAX, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_STRIDE), 4, 0, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_FILTER), 1, 1, SBF_CODE_PACKED_TABLE); /* without a codec */
    expect_patched(patch_entry(i, PATCH_FILTER), 1, SBFI_FILTER_COUNT, SBF_CODE_PACKED_CODEC);
    expect_patched(patch_entry(i, PATCH_CODEC), 1, SBFI_CODEC_COUNT, SBF_CODE_PACKED_CODEC);
    expect_patched(patch_entry(i, PATCH_FLAGS), 2, 4, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_RESERVED), 4, 1, SBF_CODE_PACKED_TABLE);
    expect_patched(patch_entry(i, PATCH_KIND), 4, 0x58585858, SBF_CODE_PACKED_UNKNOWN_PART);
  }
  expect_patched(patch_entry(0, PATCH_KIND), 4, patch_get(file.at, patch_entry(1, PATCH_KIND), 4),
      SBF_CODE_PACKED_TABLE); /* the root comes first */
  free_file();
}
END_TEST

/* The same file with its table behind the chunks, as other writers may place it; `table` is where. */
static void move_table_behind(size_t *table) {
  size_t size = (size_t)patch_get(file.at, 32, 8), begin = (file.size + 63) / 64 * 64;
  uint8_t *moved = calloc(1, begin + size);
  memcpy(moved, file.at, file.size);
  memcpy(moved + begin, file.at + 64, size);
  sbf_buffer_free(&file);
  file = (sbf_buffer){.at = moved, .size = begin + size};
  patch_put(file.at, 16, 8, file.size);
  patch_put(file.at, 24, 8, begin);
  *table = begin;
}

static void seal_table(size_t table) {
  patch_put(file.at, 44, 4, sbfi_crc32(file.at + table, (size_t)patch_get(file.at, 32, 8)));
  patch_put(file.at, 60, 4, sbfi_crc32(file.at, 60));
}

/* A chunk may touch the table from either side; a byte in it is too much. */
START_TEST(test_a_chunk_over_the_table)
{
  make_file();
  size_t table, last = 64 * ((size_t)patch_get(file.at, 40, 4) - 1);
  /* From above: the first chunk, which comes after no other, begins in the table. */
  expect_patched(patch_entry(0, PATCH_OFFSET), 8, 64, SBF_CODE_PACKED_TABLE);
  expect_patched(patch_entry(0, PATCH_OFFSET), 8, 64 + last, SBF_CODE_PACKED_TABLE);
  /* From below: the last chunk reaches into the table, then only up to it. */
  move_table_behind(&table);
  uint8_t *entry = file.at + table + last;
  uint64_t offset = patch_get(entry, PATCH_OFFSET, 8);
  patch_put(entry, PATCH_STRIDE, 4, 1);
  for (int over = 0; over < 2; over++) {
    uint64_t size = table - offset + (uint64_t)over;
    patch_put(entry, PATCH_STORED_SIZE, 8, size);
    patch_put(entry, PATCH_RAW_SIZE, 8, size);
    patch_put(entry, PATCH_COUNT, 8, size);
    seal_table(table);
    if (over)
      expect(SBF_CODE_PACKED_TABLE, (int64_t)(table + last) + PATCH_OFFSET);
    else
      ck_assert_int_eq(read_table(file.at, file.size, NULL), SBF_OK);
  }
  free(file.at);
}
END_TEST

START_TEST(test_filters_are_for_scalars_of_four_bytes)
{
  make_file();
  size_t entry = patch_entry(1, 0); /* some record */
  patch_put(file.at, entry + PATCH_CODEC, 1, SBFI_CODEC_ZLIB);
  patch_put(file.at, entry + PATCH_FILTER, 1, SBFI_FILTER_PLANES);
  patch_seal(file.at, file.size);
  expect(SBF_CODE_PACKED_TABLE, (int64_t)entry + PATCH_STRIDE);
  free_file();
}
END_TEST

START_TEST(test_unknown_optional_chunks_are_skipped)
{
  make_file();
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  patch_put(file.at, patch_entry(last, PATCH_KIND), 4, 0x58585858);
  patch_put(file.at, patch_entry(last, PATCH_FLAGS), 2, SBFI_CHUNK_SAFE_TO_COPY);
  patch_put(file.at, patch_entry(last, PATCH_CODEC), 1, 77);
  patch_seal(file.at, file.size);
  ck_assert_int_eq(read_table(file.at, file.size, NULL), SBF_OK);
  free_file();
}
END_TEST

START_TEST(test_a_newer_minor_version_may_use_reserved_fields)
{
  make_file();
  patch_put(file.at, 10, 2, SBFI_PACKED_MINOR + 1);
  patch_put(file.at, 48, 4, 1);
  patch_put(file.at, patch_entry(1, PATCH_FLAGS), 2, 5);
  patch_put(file.at, patch_entry(1, PATCH_RESERVED), 4, 1);
  patch_seal(file.at, file.size);
  ck_assert_int_eq(read_table(file.at, file.size, NULL), SBF_OK);
  free_file();
}
END_TEST

START_TEST(test_memory_and_size_limits)
{
  make_file();
  sbfi_packed_table table;
  sbf_diagnostic error;
  harness_memory memory;
  sbf_limits limits = sbfi_load_options_of(NULL).limits;
  harness_memory_init(&memory, 0);
  ck_assert_int_eq(
      sbfi_packed_table_read(&table, file.at, file.size, &limits, &memory.allocator, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
  limits.file_bytes = file.size - 1;
  ck_assert_int_eq(sbfi_packed_table_read(&table, file.at, file.size, &limits, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IO_TOO_LARGE);
  free_file();
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_table");
  TCase *tests = tcase_create("packed_table");
  tcase_add_test(tests, test_the_header_identifies_the_file);
  tcase_add_test(tests, test_chunks_of_a_level_are_found_from_the_table);
  tcase_add_test(tests, test_damage_of_a_transfer_is_named);
  tcase_add_test(tests, test_header_faults);
  tcase_add_test(tests, test_something_was_added);
  tcase_add_test(tests, test_count_of_zero);
  tcase_add_test(tests, test_entry_faults);
  tcase_add_test(tests, test_a_chunk_over_the_table);
  tcase_add_test(tests, test_filters_are_for_scalars_of_four_bytes);
  tcase_add_test(tests, test_unknown_optional_chunks_are_skipped);
  tcase_add_test(tests, test_a_newer_minor_version_may_use_reserved_fields);
  tcase_add_test(tests, test_memory_and_size_limits);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
