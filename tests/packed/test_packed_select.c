#include "sbfmt/packed.h"

#include <stdlib.h>
#include <string.h>

#include "fill_asset.h"
#include "harness.h"
#include "packed_patch.h"
#include "small_asset.h"

#define LIST(type, ...)                                                                                      \
  { (const type[]){__VA_ARGS__}, sizeof((const type[]){__VA_ARGS__}) / sizeof(type) }

static sbf_asset *load(const sbf_buffer *file, const sbf_selection *selection, uint64_t *read_bytes) {
  sbf_asset *asset;
  sbf_diagnostic error;
  sbf_load_options options = {.selection = selection, .read_bytes = read_bytes, .check_crc = true};
  sbf_status status = sbf_packed_load_memory(file->at, file->size, &options, &asset, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
  return asset;
}

static sbf_buffer small_file(bool store) {
  sbf_asset *asset = small_asset();
  sbf_buffer file;
  ck_assert_int_eq(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = store}, NULL, &file, NULL), SBF_OK);
  sbf_asset_free(asset);
  return file;
}

/* Stored bytes of the chunks of a kind, owner and level (-1: any; -2: none). */
static uint64_t chunk_bytes(
    const sbf_buffer *file, const char *kind, int64_t owner, int64_t level, bool lists) {
  uint64_t bytes = 0;
  for (uint32_t i = 0; i < patch_get(file->at, 40, 4); i++) {
    const uint8_t *entry = file->at + patch_entry(i, 0);
    if (memcmp(entry, kind, 4) != 0 || (owner >= 0 && patch_get(entry, PATCH_OWNER, 4) != (uint64_t)owner) ||
        (level >= 0 && patch_get(entry, PATCH_LEVEL, 4) != (uint64_t)level) ||
        (!lists && patch_get(entry, PATCH_FIELD, 2)))
      continue;
    bytes += patch_get(entry, PATCH_STORED_SIZE, 8);
  }
  return bytes;
}

static uint64_t front_bytes(const sbf_buffer *file) {
  return 64 + patch_get(file->at, 32, 8);
}

START_TEST(test_section_tail_level_1)
{
  for (int store = 0; store < 2; store++) {
    sbf_buffer file = small_file(store);
    sbf_asset *all = small_asset();
    const sbf_selection selection = {.kinds = LIST(char *const, "soft_body", "level"),
        .parts = LIST(char *const, "tail"),
        .levels = LIST(uint32_t, 1)};
    uint64_t read_bytes = 0;
    sbf_asset *some = load(&file, &selection, &read_bytes);

    /* nothing else was looked at; the gait has no lists and cannot be left out */
    ck_assert_uint_eq(read_bytes, front_bytes(&file) + chunk_bytes(&file, "ROOT", -1, -1, false) +
                                      chunk_bytes(&file, "BODY", 1, -1, true) +
                                      chunk_bytes(&file, "LEVL", 1, 1, true) +
                                      chunk_bytes(&file, "GAIT", -1, -1, true));

    const sbf_soft_body *head = &some->soft_bodies.at[0], *tail = &some->soft_bodies.at[1];
    ck_assert_uint_eq(some->soft_bodies.count, 2);
    ck_assert_str_eq(head->id, "body_1");
    ck_assert_str_eq(head->name, "head");
    ck_assert_uint_eq(head->surface.positions.count, 0);
    ck_assert_uint_eq(head->levels.count, 0);
    ck_assert_uint_eq(tail->levels.count, 2);
    ck_assert_str_eq(tail->levels.at[0].name, "fine");
    ck_assert_uint_eq(tail->levels.at[0].positions.count, 0);
    const sbf_level *level = &tail->levels.at[1], *full = &all->soft_bodies.at[1].levels.at[1];
    ck_assert_uint_eq(level->positions.count, full->positions.count);
    ck_assert_mem_eq(level->positions.at, full->positions.at, full->positions.count * sizeof(sbf_vec3));
    ck_assert_mem_eq(level->springs.at[0].ends.at, full->springs.at[0].ends.at,
        full->springs.at[0].ends.count * sizeof(sbf_uint2));
    ck_assert_uint_eq(some->bones.count, 2);
    ck_assert_str_eq(some->render_meshes.at[0].id, "seen");
    ck_assert_uint_eq(some->render_meshes.at[0].mesh.positions.count, 0);
    ck_assert_uint_eq(some->bone_masks.at[0].bones.count, 0);
    ck_assert_int_eq(some->gaits.at[0].body, 0);
    sbf_asset_free(some);
    sbf_asset_free(all);
    sbf_buffer_free(&file);
  }
}
END_TEST

START_TEST(test_members_left_empty_select_all)
{
  sbf_buffer file = small_file(false);
  sbf_asset *all = small_asset(), *some;
  uint64_t read_bytes;
  sbf_selection selection = {{NULL, 0}, {NULL, 0}, {NULL, 0}};
  some = load(&file, &selection, &read_bytes);
  ck_assert(sbf_asset_equal(all, some, NULL, 0));
  uint64_t everything = front_bytes(&file);
  for (uint32_t i = 0; i < patch_get(file.at, 40, 4); i++)
    everything += patch_get(file.at, patch_entry(i, PATCH_STORED_SIZE), 8);
  ck_assert_uint_eq(read_bytes, everything);
  sbf_asset_free(some);

  selection = (sbf_selection){.kinds = LIST(char *const, "asset", "texture")};
  some = load(&file, &selection, NULL);
  ck_assert_uint_eq(some->textures.at[0].bytes.count, 333);
  ck_assert_uint_eq(some->bone_masks.at[0].bones.count, 80);
  ck_assert_uint_eq(some->soft_bodies.at[0].surface.positions.count, 0);
  sbf_asset_free(some);

  selection = (sbf_selection){.parts = LIST(char *const, "body_1", "seen")};
  some = load(&file, &selection, NULL);
  ck_assert_uint_eq(some->soft_bodies.at[0].levels.at[1].positions.count, 26);
  ck_assert_uint_eq(some->soft_bodies.at[1].surface.positions.count, 0);
  ck_assert_uint_eq(some->render_meshes.at[0].mesh.positions.count, 56);
  ck_assert_uint_eq(some->textures.at[0].bytes.count, 0);
  sbf_asset_free(some);
  sbf_asset_free(all);
  sbf_buffer_free(&file);
}
END_TEST

/* Unselected chunks may be damaged: they are not read. */
START_TEST(test_unselected_chunks_are_not_read)
{
  sbf_buffer file = small_file(false);
  const sbf_selection selection = {.kinds = LIST(char *const, "texture")};
  for (uint32_t i = 0; i < patch_get(file.at, 40, 4); i++) {
    const uint8_t *entry = file.at + patch_entry(i, 0);
    if (memcmp(entry, "BODY", 4) == 0 || memcmp(entry, "LEVL", 4) == 0 || memcmp(entry, "MESH", 4) == 0)
      memset(file.at + patch_get(entry, PATCH_OFFSET, 8), 0xee, patch_get(entry, PATCH_STORED_SIZE, 8));
  }
  sbf_asset *some = load(&file, &selection, NULL);
  ck_assert_uint_eq(some->textures.at[0].bytes.count, 333);
  ck_assert_uint_eq(some->soft_bodies.count, 2);
  sbf_asset_free(some);
  sbf_buffer_free(&file);
}
END_TEST

/* A part of every kind alone: the result passes the check and can be saved again. */
START_TEST(test_any_kind_alone_is_a_sound_asset)
{
  const char *const kinds[] = {
      "asset", "texture", "render_mesh", "soft_body", "level", "gait", "clip", "none"};
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 8, .items = 90}), *some;
  sbf_buffer file, again;
  ck_assert_int_eq(sbf_packed_save_memory(asset, NULL, NULL, &file, NULL), SBF_OK);
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    const sbf_selection selection = {.kinds = {&kinds[i], 1}};
    sbf_load_options options = fill_load_options(asset);
    sbf_diagnostic error;
    options.selection = &selection;
    sbf_status status = sbf_packed_load_memory(file.at, file.size, &options, &some, &error);
    ck_assert_msg(status == SBF_OK, "%s: %s: %s", kinds[i], error.path, error.message);
    ck_assert_int_eq(sbf_packed_save_memory(some, NULL, NULL, &again, NULL), SBF_OK);
    ck_assert_uint_lt(again.size, file.size);
    sbf_buffer_free(&again);
    sbf_asset_free(some);
  }
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

/* An outline has every count of the asset and none of the long lists; where those lie nothing is read. */
START_TEST(test_outline)
{
  for (int store = 0; store < 2; store++) {
    sbf_asset *asset = fill_asset(&(fill_options){.seed = 9, .items = 3000}), *outline;
    sbf_buffer file, again;
    sbf_diagnostic error;
    uint64_t lists = 0, read_bytes = 0;
    bool with_outline = false;
    ck_assert_int_eq(
        sbf_packed_save_memory(asset, &(sbf_save_options){.store = store}, NULL, &file, NULL), SBF_OK);
    for (uint32_t i = 0; i < patch_get(file.at, 40, 4); i++) {
      const uint8_t *entry = file.at + patch_entry(i, 0);
      uint64_t size = patch_get(entry, PATCH_STORED_SIZE, 8);
      if (!patch_get(entry, PATCH_FIELD, 2)) continue;
      with_outline |= patch_get(file.at, 40, 4) > 128;
      memset(file.at + patch_get(entry, PATCH_OFFSET, 8), 0xee, size);
      lists += size;
    }
    sbf_load_options options = fill_load_options(asset);
    options.outline = true;
    options.check_crc = true;
    options.read_bytes = &read_bytes;
    sbf_status status = sbf_packed_load_memory(file.at, file.size, &options, &outline, &error);
    ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
    ck_assert_uint_le(read_bytes + lists, file.size);
    ck_assert_uint_gt(lists, read_bytes);
    ck_assert(with_outline); /* else the table and the records would be read */
    const sbf_soft_body *body = &outline->soft_bodies.at[0], *whole = &asset->soft_bodies.at[0];
    ck_assert_str_eq(body->name, whole->name);
    ck_assert_ptr_null(body->surface.positions.at);
    ck_assert_uint_eq(body->surface.positions.count, whole->surface.positions.count);
    ck_assert_uint_eq(
        body->levels.at[0].springs.at[0].ends.count, whole->levels.at[0].springs.at[0].ends.count);
    ck_assert_int_eq(body->levels.at[0].springs.at[0].kind, whole->levels.at[0].springs.at[0].kind);
    ck_assert_int_eq(sbf_packed_save_memory(outline, NULL, NULL, &again, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, SBF_CODE_WRONG_LENGTH);
    sbf_asset_free(outline);
    sbf_buffer_free(&file);
    sbf_asset_free(asset);
  }
}
END_TEST

/* The outline of a file is as little to be trusted as all else in it. */
START_TEST(test_wrong_outline)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 9, .items = 90}), *outline;
  sbf_buffer file;
  sbf_diagnostic error;
  ck_assert_int_eq(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = true}, NULL, &file, NULL), SBF_OK);
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  ck_assert_int_eq(memcmp(file.at + patch_entry(last, 0), "OUTL", 4), 0);
  size_t begin = patch_get(file.at, patch_entry(last, PATCH_OFFSET), 8);
  uint8_t *copy = malloc(file.size);
  sbf_load_options options = fill_load_options(asset);
  options.outline = true;
  options.limits.memory_bytes = 1 << 24;
  uint32_t refused = 0;
  for (size_t at = begin; at < file.size; at += 11)
    for (int seal = 0; seal < 2; seal++) {
      memcpy(copy, file.at, file.size);
      copy[at] ^= (uint8_t)(1 + at % 255);
      if (seal) patch_seal(copy, file.size);
      sbf_status status = sbf_packed_load_memory(copy, file.size, &options, &outline, &error);
      refused += status != SBF_OK;
      ck_assert(seal || (status == SBF_BAD_INPUT && error.code == SBF_CODE_PACKED_CRC));
      ck_assert((status == SBF_OK) == (outline != NULL));
      sbf_asset_free(outline);
    }
  ck_assert_uint_gt(refused, (file.size - begin) / 11);
  /* Of no use to a load of the whole, it may say anything. */
  options.outline = false;
  options.limits.memory_bytes = 0;
  memset(file.at + begin, 0xee, file.size - begin);
  ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, &options, &outline, &error), SBF_OK);
  sbf_asset_free(outline);
  free(copy);
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

/* A full load with checksums also checks the chunks that it does not need. */
START_TEST(test_checksums_of_unread_chunks)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 9, .items = 90}), *loaded;
  sbf_buffer file;
  sbf_diagnostic error;
  ck_assert_int_eq(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = true}, NULL, &file, NULL), SBF_OK);
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  ck_assert_int_eq(memcmp(file.at + patch_entry(last, 0), "OUTL", 4), 0);
  size_t outline = patch_get(file.at, patch_entry(last, PATCH_OFFSET), 8);
  size_t gap = patch_get(file.at, patch_entry(last - 1, PATCH_OFFSET), 8) +
               patch_get(file.at, patch_entry(last - 1, PATCH_STORED_SIZE), 8);
  ck_assert_uint_lt(gap, outline);
  const struct {
    size_t at;
    sbf_code code;
  } positions[] = {{outline, SBF_CODE_PACKED_CRC}, {file.size - 1, SBF_CODE_PACKED_CRC},
      {gap, SBF_CODE_PACKED_TABLE}, {outline - 1, SBF_CODE_PACKED_TABLE}};
  sbf_load_options options = fill_load_options(asset);
  for (int check = 0; check < 2; check++) {
    options.check_crc = check;
    ck_assert_int_eq(sbf_packed_load_memory(file.at, file.size, &options, &loaded, &error), SBF_OK);
    sbf_asset_free(loaded);
    for (size_t i = 0; i < sizeof positions / sizeof *positions; i++) {
      file.at[positions[i].at] ^= 0x55;
      sbf_status status = sbf_packed_load_memory(file.at, file.size, &options, &loaded, &error);
      ck_assert_int_eq(status, check ? SBF_BAD_INPUT : SBF_OK);
      if (check) ck_assert_int_eq(error.code, (int)positions[i].code);
      if (check) ck_assert_uint_eq((size_t)error.offset, i < 2 ? outline : positions[i].at);
      sbf_asset_free(loaded);
      file.at[positions[i].at] ^= 0x55;
    }
  }
  sbf_buffer_free(&file);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_select");
  TCase *tests = tcase_create("packed_select");
  tcase_add_test(tests, test_section_tail_level_1);
  tcase_add_test(tests, test_members_left_empty_select_all);
  tcase_add_test(tests, test_unselected_chunks_are_not_read);
  tcase_add_test(tests, test_any_kind_alone_is_a_sound_asset);
  tcase_add_test(tests, test_outline);
  tcase_add_test(tests, test_wrong_outline);
  tcase_add_test(tests, test_checksums_of_unread_chunks);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
