#include "sbfmt/packed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "fill_asset.h"
#include "harness.h"
#include "model/asset_box.h"
#include "model/options.h"
#include "packed/packed_codec.h"
#include "packed_patch.h"
#include "promises.h"
#include "small_asset.h"

static sbf_buffer pack(const sbf_asset *asset, bool store) {
  sbf_buffer file;
  ck_assert_int_eq(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = store}, NULL, &file, NULL), SBF_OK);
  return file;
}

static sbf_buffer small_file(bool store) {
  sbf_asset *asset = small_asset();
  sbf_buffer file = pack(asset, store);
  sbf_asset_free(asset);
  return file;
}

/* --- round trips --- */

START_TEST(test_every_field_round_trips)
{
  for (uint64_t seed = 0; seed < 6; seed++)
    for (int store = 0; store < 2; store++) {
      sbf_asset *asset = fill_asset(&(fill_options){.seed = seed, .items = seed % 2 ? 400 : 0}), *loaded;
      sbf_buffer file = pack(asset, store);
      sbf_load_options options = fill_load_options(asset);
      sbf_diagnostic error;
      char path[256];
      options.check_crc = true;
      sbf_status status = sbf_packed_load_memory(file.at, file.size, &options, &loaded, &error);
      ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
      ck_assert_msg(sbf_asset_equal(asset, loaded, path, sizeof path), "%s", path);
      ck_assert_str_eq(loaded->soft_bodies.at[0].levels.at[0].simulation.measured.at[0].machine,
          asset->soft_bodies.at[0].levels.at[0].simulation.measured.at[0].machine);
      sbf_asset_free(loaded);
      sbf_buffer_free(&file);
      sbf_asset_free(asset);
    }
}
END_TEST

static bool lies_in(const void *at, const sbf_buffer *file) {
  return (const uint8_t *)at >= file->at && (const uint8_t *)at < file->at + file->size;
}

START_TEST(test_stored_lists_are_used_in_place)
{
  sbf_asset *loaded;
  for (int store = 0; store < 2; store++) {
    sbf_buffer file = small_file(store);
    ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, NULL, &loaded, NULL), SBF_OK);
    const sbf_soft_body *body = &loaded->soft_bodies.at[1];
    ck_assert_int_eq(lies_in(body->surface.positions.at, &file), store);
    ck_assert_int_eq(lies_in(body->levels.at[1].springs.at[0].ends.at, &file), store);
    ck_assert(!lies_in(body->levels.at[1].pins.at[0].points.at, &file)); /* short: in the record */
    ck_assert(!lies_in(body->name, &file));
    if (store) ck_assert_uint_eq((size_t)((const uint8_t *)body->surface.positions.at - file.at) % 64, 0);
    sbf_asset_free(loaded);
    sbf_buffer_free(&file);
  }
}
END_TEST

START_TEST(test_memory_that_is_not_aligned_is_copied)
{
  sbf_buffer file = small_file(true);
  sbf_asset *asset = small_asset(), *loaded;
  for (size_t shift = 0; shift < 8; shift++) {
    uint8_t *moved = malloc(file.size + shift);
    memcpy(moved + shift, file.at, file.size);
    ck_assert_int_eq(sbf_packed_load_memory(moved + shift, file.size, NULL, &loaded, NULL), SBF_OK);
    ck_assert(sbf_asset_equal(asset, loaded, NULL, 0));
    ck_assert_uint_eq((uintptr_t)loaded->soft_bodies.at[0].surface.positions.at % 4, 0);
    sbf_asset_free(loaded);
    free(moved);
  }
  sbf_asset_free(asset);
  sbf_buffer_free(&file);
}
END_TEST

START_TEST(test_files_are_mapped_or_read_and_live_as_long_as_the_asset)
{
  sbf_asset *asset = small_asset(), *loaded;
  const char *path = harness_scratch("load.sbfz");
#ifndef _WIN32
  const char *other = harness_scratch("other.sbfz");
#endif
  for (int i = 0; i < 4; i++) {
    sbf_load_options options = {.copy_file = i & 1};
    ck_assert_int_eq(sbf_packed_save_file(asset, path, &(sbf_save_options){.store = i >> 1}, NULL), SBF_OK);
    harness_memory memory;
    harness_memory_init(&memory, SIZE_MAX);
    options.allocator = &memory.allocator;
    ck_assert_int_eq(sbf_packed_load_file(path, &options, &loaded, NULL), SBF_OK);
    const sbfi_file_content *content = sbfi_asset_box_of(loaded)->released;
    const uint8_t *positions = (const uint8_t *)loaded->soft_bodies.at[1].surface.positions.at;
    ck_assert_int_eq(content != NULL, i >> 1); /* compressed, nothing is left in the file */
    if (content) {
      ck_assert(positions > content->at && positions < content->at + content->size);
      ck_assert_int_eq(content->allocated_bytes != 0, i & 1);
    }
#ifndef _WIN32 /* there nobody replaces a mapped file, and rename no file at all */
    ck_assert(harness_write(other, "x", 1));
    ck_assert_int_eq(rename(other, path), 0); /* the old file lives on in the mapping */
#endif
    ck_assert(sbf_asset_equal(asset, loaded, NULL, 0));
    sbf_asset_free(loaded);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_missing_and_wrong_files)
{
  sbf_diagnostic error;
  sbf_asset *loaded = (sbf_asset *)1;
  const char *path = harness_scratch("missing.sbfz");
  ck_assert_int_eq(sbf_packed_load_file(path, NULL, &loaded, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_READ);
  ck_assert_str_eq(error.file, path);
  ck_assert_ptr_null(loaded);
  path = harness_scratch("empty.sbfz");
  ck_assert(harness_write(path, "", 0));
  ck_assert_int_eq(sbf_packed_load_file(path, NULL, &loaded, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_PACKED_TRUNCATED);
  ck_assert_str_eq(error.file, path);
  ck_assert_int_eq(
      sbf_packed_load_memory("?", 1, &(sbf_load_options){.name = "memory"}, &loaded, &error), SBF_BAD_INPUT);
  ck_assert_str_eq(error.file, "memory");
}
END_TEST

/* --- damage --- */

START_TEST(test_every_shorter_file_is_refused)
{
  for (int store = 0; store < 2; store++) {
    sbf_buffer file = small_file(store);
    for (size_t size = 0; size < file.size; size++) {
      uint8_t *cut = malloc(size + 1); /* exactly so much, for the address sanitizer */
      memcpy(cut, file.at, size);
      cut = realloc(cut, size ? size : 1);
      sbf_asset *loaded;
      sbf_diagnostic error;
      ck_assert_int_eq(sbf_packed_load_memory(cut, size, NULL, &loaded, &error), SBF_BAD_INPUT);
      ck_assert_int_eq(error.code, SBF_CODE_PACKED_TRUNCATED);
      ck_assert_ptr_null(loaded);
      free(cut);
    }
    sbf_buffer_free(&file);
  }
}
END_TEST

/* Whatever single byte is damaged: the asset is the same, because the byte means nothing, or the load fails.
 */
START_TEST(test_checksums_detect_every_damaged_byte)
{
  for (int store = 0; store < 2; store++) {
    sbf_buffer file = small_file(store);
    sbf_asset *asset = small_asset(), *loaded;
    sbf_load_options options = {.check_crc = true};
    size_t equal = 0;
    for (size_t i = 0; i < file.size; i++) {
      uint8_t kept = file.at[i];
      file.at[i] ^= (uint8_t)(1u << i % 8);
      if (sbf_packed_load_memory(file.at, file.size, &options, &loaded, NULL) == SBF_OK) {
        ck_assert_msg(sbf_asset_equal(asset, loaded, NULL, 0), "byte %zu", i);
        equal++;
      }
      sbf_asset_free(loaded);
      file.at[i] = kept;
    }
    ck_assert_uint_lt(equal, file.size / 4); /* the padding between chunks */
    sbf_asset_free(asset);
    sbf_buffer_free(&file);
  }
}
END_TEST

/* Without checksums, or with false ones, a damaged byte may change what the asset says, never what is
 * promised of it. */
static void load_damaged(sbf_buffer *file, bool seal, uint8_t mask) {
  uint8_t *copy = malloc(file->size);
  uint64_t count = patch_get(file->at, 40, 4), lists = file->size; /* where the first list begins */
  for (uint32_t i = (uint32_t)count; i-- > 0 && patch_get(file->at, patch_entry(i, PATCH_FIELD), 2);)
    lists = patch_get(file->at, patch_entry(i, PATCH_OFFSET), 8);
  for (size_t i = 0; i < file->size; i += i < lists ? 1 : 13) {
    sbf_asset *loaded;
    sbf_diagnostic error;
    memcpy(copy, file->at, file->size);
    copy[i] ^= mask;
    if (seal && i < patch_entry((uint32_t)count, 0)) patch_seal(copy, file->size);
    sbf_status status = sbf_packed_load_memory(copy, file->size, NULL, &loaded, &error);
    if (status == SBF_OK) {
      ck_assert_promises_kept(loaded);
      sbf_asset_free(loaded);
    } else {
      ck_assert_msg(error.code != 0 && error.message[0], "byte %zu", i);
      ck_assert_ptr_null(loaded);
    }
  }
  free(copy);
}

START_TEST(test_damage_never_breaks_the_promise)
{
  for (int store = 0; store < 2; store++) {
    sbf_buffer file = small_file(store);
    load_damaged(&file, false, 0xff);
    load_damaged(&file, true, 1u << _i);
    if (_i == 0) load_damaged(&file, true, 0xff);
    sbf_buffer_free(&file);
  }
}
END_TEST

/* Two bytes at once, at places that a generator picks, in every kind of field. */
START_TEST(test_random_damage_of_a_filled_asset)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 77}), *loaded;
  sbf_buffer file = pack(asset, true);
  sbf_load_options options = fill_load_options(asset);
  uint8_t *copy = malloc(file.size);
  uint64_t random = 1, limits[] = {0, 20000};
  size_t good = 0;
  for (int i = 0; i < 4000; i++) {
    memcpy(copy, file.at, file.size);
    for (int k = 0; k < 2; k++) {
      random = random * UINT64_C(6364136223846793005) + 1442695040888963407;
      copy[64 + (random >> 33) % (file.size - 64)] = (uint8_t)(random >> 20 & (i % 2 ? 0xff : 3));
    }
    patch_seal(copy, file.size);
    options.limits.memory_bytes = limits[i % 2];
    if (sbf_packed_load_memory(copy, file.size, &options, &loaded, NULL) == SBF_OK) {
      ck_assert_promises_kept(loaded);
      good++;
    }
    sbf_asset_free(loaded);
  }
  ck_assert_uint_gt(good, 0);
  free(copy);
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_checksum_of_a_chunk_is_checked_on_request)
{
  sbf_buffer file = small_file(true);
  sbf_asset *loaded;
  sbf_diagnostic error;
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  size_t offset = patch_get(file.at, patch_entry(last, PATCH_OFFSET), 8);
  sbf_load_options options = {.check_crc = true};
  file.at[offset] ^= 1; /* in a list of ends: still in range */
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, NULL, &loaded, NULL), SBF_OK);
  sbf_asset_free(loaded);
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, &options, &loaded, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_PACKED_CRC);
  ck_assert_int_eq(error.offset, (int64_t)offset);
  ck_assert_str_eq(error.path, "/sbf/soft_body[2]/level[2]/spring_set[1]/ends");
  sbf_buffer_free(&file);
}
END_TEST

/* The header decides on the fields; a record that states an earlier version is of the header's. */
START_TEST(test_the_version_is_not_below_the_headers)
{
  sbf_asset *asset = small_asset(), *loaded;
  asset->version = "1.2";
  sbf_buffer file = pack(asset, true);
  uint8_t *text = file.at + patch_get(file.at, patch_entry(0, PATCH_OFFSET), 8);
  while (memcmp(text, "1.2", 3) != 0) text++;
  text[2] = '0';
  patch_seal(file.at, file.size);
  sbf_load_options options = {.check_crc = true};
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, &options, &loaded, NULL), SBF_OK);
  ck_assert_str_eq(loaded->version, "1.2");
  sbf_asset_free(loaded);
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_numbers_of_a_mapped_list_are_checked)
{
  sbf_buffer file = small_file(true);
  sbf_asset *loaded;
  sbf_diagnostic error;
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  patch_put(file.at, patch_get(file.at, patch_entry(last, PATCH_OFFSET), 8) + 4 * 5, 4, 56);
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, NULL, &loaded, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_INDEX_OUT_OF_RANGE);
  ck_assert_int_eq(error.index, 2);
  sbf_buffer_free(&file);
}
END_TEST

/* --- memory and limits --- */

START_TEST(test_every_failed_allocation_frees_everything)
{
  for (int store = 0; store < 2; store++) {
    sbf_asset *asset = fill_asset(&(fill_options){.seed = 2, .items = 200}), *loaded;
    sbf_buffer file = pack(asset, store);
    const char *path = harness_scratch("failing.sbfz");
    ck_assert(harness_write(path, file.at, file.size));
    for (int from_file = 0; from_file < 3; from_file++) {
      size_t allowed = 0;
      for (sbf_status status = SBF_FAILED; status != SBF_OK; allowed++) {
        harness_memory memory;
        harness_memory_init(&memory, allowed);
        sbf_load_options options = fill_load_options(asset);
        sbf_diagnostic error;
        options.allocator = &memory.allocator;
        options.copy_file = from_file == 2;
        status = from_file ? sbf_packed_load_file(path, &options, &loaded, &error)
                           : sbf_packed_load_memory(file.at, file.size, &options, &loaded, &error);
        if (status != SBF_OK) {
          ck_assert_int_eq(status, SBF_FAILED);
          ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
        }
        sbf_asset_free(loaded);
        ck_assert_uint_eq(memory.held_bytes, 0);
      }
      ck_assert_uint_gt(allowed, 6);
    }
    sbf_buffer_free(&file);
    sbf_asset_free(asset);
  }
}
END_TEST

static void expect_limited(const sbf_buffer *file, sbf_load_options options, sbf_code code) {
  sbf_asset *loaded;
  sbf_diagnostic error;
  ck_assert_int_ne(sbf_packed_load_memory(file->at, file->size, &options, &loaded, &error), SBF_OK);
  ck_assert_msg(error.code == (int32_t)code, "code %d, not %d: %s", error.code, (int)code, error.message);
}

static void expect_loads(const sbf_buffer *file, sbf_load_options options) {
  sbf_asset *loaded;
  sbf_diagnostic error;
  sbf_status status = sbf_packed_load_memory(file->at, file->size, &options, &loaded, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  sbf_asset_free(loaded);
}

/* Each limit holds what the file needs, and not one less. */
START_TEST(test_limits_at_and_past)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 5, .items = 3000}), *loaded;
  sbf_buffer file = pack(asset, false);
  sbf_load_options base = fill_load_options(asset), options = base;
  uint64_t inflated = 0, largest = 0, ratio = 0, items = 0;
  for (uint32_t i = 0; i < patch_get(file.at, 40, 4); i++) {
    const uint8_t *entry = file.at + patch_entry(i, 0);
    uint64_t raw = patch_get(entry, PATCH_RAW_SIZE, 8), stored = patch_get(entry, PATCH_STORED_SIZE, 8);
    if (memcmp(entry, "OUTL", 4) == 0) continue; /* not read */
    if (patch_get(entry, PATCH_CODEC, 1)) {
      inflated += raw;
      if (raw > largest) largest = raw;
      if ((raw + stored - 1) / stored > ratio) ratio = (raw + stored - 1) / stored;
    }
    uint64_t count = patch_get(entry, PATCH_COUNT, 8);
    if (patch_get(entry, PATCH_FIELD, 2) && count > items) items = count;
  }
  ck_assert_uint_gt(ratio, 2);

  options.limits.inflated_bytes = inflated;
  expect_loads(&file, options);
  options.limits.inflated_bytes = inflated - 1;
  expect_limited(&file, options, SBF_CODE_PACKED_RATIO);
  const sbf_selection all = {{NULL, 0}, {NULL, 0}, {NULL, 0}}; /* summed as chunks are read */
  options.selection = &all;
  options.limits.inflated_bytes = inflated / 2;
  ck_assert_uint_gt(inflated / 2, largest);
  expect_limited(&file, options, SBF_CODE_PACKED_RATIO);

  options = base;
  options.limits.inflate_ratio = (uint32_t)ratio;
  expect_loads(&file, options);
  options.limits.inflate_ratio = (uint32_t)ratio - 1;
  expect_limited(&file, options, SBF_CODE_PACKED_RATIO);

  options = base;
  options.limits.list_items = (uint32_t)items;
  expect_loads(&file, options);
  options.limits.list_items = (uint32_t)items - 1;
  expect_limited(&file, options, SBF_CODE_LIST_TOO_LONG);
  options.limits.list_items = 1; /* children and short lists as well */
  expect_limited(&file, options, SBF_CODE_LIST_TOO_LONG);

  options = base;
  options.limits.file_bytes = file.size;
  expect_loads(&file, options);
  options.limits.file_bytes = file.size - 1;
  expect_limited(&file, options, SBF_CODE_IO_TOO_LARGE);

  options = base;
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, &options, &loaded, NULL), SBF_OK);
  size_t used = sbfi_asset_box_of(loaded)->arena.used_bytes;
  sbf_asset_free(loaded);
  options.limits.memory_bytes = used;
  expect_loads(&file, options);
  options.limits.memory_bytes = used - 1;
  expect_limited(&file, options, SBF_CODE_OUT_OF_MEMORY);

  options = base;
  options.limits.depth = 5; /* asset, soft_body, level, simulation, measured */
  expect_loads(&file, options);
  options.limits.depth = 4;
  expect_limited(&file, options, SBF_CODE_PACKED_RECORD);
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

/* A chunk that claims to become huge is refused before anything is allocated for it. */
START_TEST(test_decompression_bombs_are_refused)
{
  sbf_asset *asset = sbf_asset_create(NULL), *loaded;
  sbf_texture texture;
  sbf_texture_init(&texture);
  texture.id = "zeros";
  texture.bytes.count = 10 << 20;
  texture.bytes.at = sbf_asset_allocate(asset, texture.bytes.count, 1);
  asset->textures = (sbf_texture_list){&texture, 1};
  sbf_buffer file = pack(asset, false);
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  uint64_t stored = patch_get(file.at, patch_entry(last, PATCH_STORED_SIZE), 8);
  ck_assert_uint_lt(stored, 11000); /* a thousand to one, as far as zlib goes */
  sbf_load_options options = {0};
  expect_loads(&file, options);

  const uint64_t claims[] = {(uint64_t)1 << 30, (uint64_t)3 << 30, UINT64_MAX};
  for (size_t i = 0; i < sizeof claims / sizeof *claims; i++) {
    harness_memory memory;
    harness_memory_init(&memory, SIZE_MAX);
    options = (sbf_load_options){.allocator = &memory.allocator};
    patch_put(file.at, patch_entry(last, PATCH_RAW_SIZE), 8, claims[i]);
    patch_put(file.at, patch_entry(last, PATCH_COUNT), 8, claims[i]);
    patch_seal(file.at, file.size);
    expect_limited(&file, options, SBF_CODE_PACKED_RATIO);
    options.limits.inflated_bytes = UINT64_MAX; /* the limits behind that one */
    expect_limited(&file, options, claims[i] >> 30 > 1 ? SBF_CODE_LIST_TOO_LONG : SBF_CODE_PACKED_RATIO);
    options.limits.inflate_ratio = UINT32_MAX;
    options.limits.list_items = UINT32_MAX;
    options.limits.memory_bytes = 1 << 20;
    expect_limited(&file, options, claims[i] == UINT64_MAX ? SBF_CODE_LIST_TOO_LONG : SBF_CODE_OUT_OF_MEMORY);
    options.limits.inflated_bytes = 1 << 20;
    if (claims[i] != UINT64_MAX) expect_limited(&file, options, SBF_CODE_PACKED_RATIO);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  /* a claim within the limits, but not true */
  patch_put(file.at, patch_entry(last, PATCH_RAW_SIZE), 8, (10 << 20) - 1);
  patch_put(file.at, patch_entry(last, PATCH_COUNT), 8, (10 << 20) - 1);
  patch_seal(file.at, file.size);
  expect_limited(&file, (sbf_load_options){0}, SBF_CODE_PACKED_INFLATE);
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, NULL, &loaded, NULL), SBF_BAD_INPUT);
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

/* Sound, and within what zlib can do: still no file of 100 kB takes a thousand times its size. */
START_TEST(test_a_small_file_inflates_to_little)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_texture textures[2];
  for (uint32_t i = 0; i < 2; i++) {
    sbf_texture_init(&textures[i]);
    textures[i].id = i ? "more" : "zeros";
    textures[i].bytes.count = 33 << 20;
    textures[i].bytes.at = sbf_asset_allocate(asset, textures[i].bytes.count, 1);
  }
  asset->textures = (sbf_texture_list){textures, 2};
  sbf_buffer file = pack(asset, false);
  ck_assert_uint_lt(file.size, 100000);
  harness_memory memory;
  harness_memory_init(&memory, 1 << 20); /* nothing of it is inflated */
  expect_limited(&file, (sbf_load_options){.allocator = &memory.allocator}, SBF_CODE_PACKED_RATIO);
  expect_loads(&file, (sbf_load_options){.limits = {.inflated_bytes = 80 << 20}});
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

/* One more chunk of a known kind, which is sound but which no record names; the table stands behind all. */
START_TEST(test_a_chunk_that_nothing_names)
{
  sbf_asset *asset = small_asset(), *loaded;
  sbf_buffer file;
  sbf_diagnostic error;
  ck_assert_int_eq(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = true}, NULL, &file, NULL), SBF_OK);
  uint64_t count = patch_get(file.at, 40, 4), size = 64 * (count + 1), table = (file.size + 63) / 64 * 64;
  uint8_t *more = calloc(1, table + size), *entry = more + table + 64 * count;
  memcpy(more, file.at, file.size);
  memcpy(more + table, file.at + 64, 64 * count);
  memcpy(entry, file.at + patch_entry((uint32_t)count - 1, 0), 64);
  patch_put(entry, PATCH_LIST, 2, 999);
  patch_put(entry, PATCH_OFFSET, 8, table); /* empty, where the table begins */
  patch_put(entry, PATCH_STORED_SIZE, 8, 0);
  patch_put(entry, PATCH_RAW_SIZE, 8, 0);
  patch_put(entry, PATCH_COUNT, 8, 0);
  patch_put(entry, PATCH_CRC, 4, 0);
  for (int named = 0; named < 2; named++) {
    uint64_t entries = count + 1 - (uint64_t)named;
    patch_put(more, 16, 8, table + 64 * entries);
    patch_put(more, 24, 8, table);
    patch_put(more, 32, 8, 64 * entries);
    patch_put(more, 40, 4, entries);
    patch_put(more, 44, 4, sbfi_crc32(more + table, (size_t)(64 * entries)));
    patch_put(more, 60, 4, sbfi_crc32(more, 60));
    sbf_status status = sbf_packed_load_memory(more, (size_t)(table + 64 * entries), NULL, &loaded, &error);
    ck_assert_msg(status == (named ? SBF_OK : SBF_BAD_INPUT), "%s", error.message);
    if (!named) ck_assert_int_eq(error.code, SBF_CODE_PACKED_TABLE);
    sbf_asset_free(loaded);
  }
  free(more);
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_load");
  TCase *tests = tcase_create("packed_load");
  tcase_add_test(tests, test_every_field_round_trips);
  tcase_add_test(tests, test_a_chunk_that_nothing_names);
  tcase_add_test(tests, test_stored_lists_are_used_in_place);
  tcase_add_test(tests, test_memory_that_is_not_aligned_is_copied);
  tcase_add_test(tests, test_files_are_mapped_or_read_and_live_as_long_as_the_asset);
  tcase_add_test(tests, test_missing_and_wrong_files);
  tcase_add_test(tests, test_every_shorter_file_is_refused);
  tcase_add_test(tests, test_checksums_detect_every_damaged_byte);
  tcase_add_loop_test(tests, test_damage_never_breaks_the_promise, 0, 8);
  tcase_add_test(tests, test_random_damage_of_a_filled_asset);
  tcase_add_test(tests, test_checksum_of_a_chunk_is_checked_on_request);
  tcase_add_test(tests, test_the_version_is_not_below_the_headers);
  tcase_add_test(tests, test_numbers_of_a_mapped_list_are_checked);
  tcase_add_test(tests, test_every_failed_allocation_frees_everything);
  tcase_add_test(tests, test_limits_at_and_past);
  tcase_add_test(tests, test_decompression_bombs_are_refused);
  tcase_add_test(tests, test_a_small_file_inflates_to_little);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
