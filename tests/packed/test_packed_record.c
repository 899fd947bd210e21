#include "packed/packed_reader.h"

#include <stdlib.h>

#include "harness.h"
#include "packed_patch.h"
#include "small_asset.h"

/* A record put together by hand, and the file that has it as its only chunk. */
typedef struct hand_made {
  uint8_t at[1024];
  size_t size;
} hand_made;

static void put(hand_made *r, const void *bytes, size_t size) {
  memcpy(r->at + r->size, bytes, size);
  r->size += size;
}

static void put_number(hand_made *r, uint32_t value) {
  patch_put(r->at, r->size, 4, value);
  r->size += 4;
}

static void put_head(hand_made *r, uint16_t number, sbfi_packed_form form, uint32_t size) {
  patch_put(r->at, r->size, 2, number);
  patch_put(r->at, r->size + 2, 2, form);
  patch_put(r->at, r->size + 4, 4, size);
  r->size += 8;
}

static void put_text(hand_made *r, uint16_t number, const char *text, uint32_t size) {
  put_head(r, number, SBFI_FORM_TEXT, size);
  put(r, text, size);
  while (r->size % 4) r->at[r->size++] = 0;
}

static void put_field(hand_made *r, uint16_t number, sbfi_packed_form form, const hand_made *payload) {
  put_head(r, number, form, (uint32_t)payload->size);
  put(r, payload->at, payload->size);
}

/* Numbers of fields that the records below use. */
static uint16_t root_field(const char *name) {
  return sbfi_element_field(&sbfi_asset_element, name)->number;
}
static uint16_t field_of(const char *collection, const char *name) {
  return sbfi_element_field(sbfi_element_field(&sbfi_asset_element, collection)->element, name)->number;
}

static hand_made with_version(void) {
  hand_made r = {.size = 0};
  put_text(&r, 1, SBF_FORMAT_VERSION, 3);
  return r;
}

static sbf_status load_minor(const hand_made *r, uint16_t minor, sbf_asset **asset, sbf_diagnostic *error) {
  size_t size = 128 + r->size;
  uint8_t *file = calloc(size, 1);
  const sbfi_packed_header header = {.major = 1,
      .minor = minor,
      .min_major = 1,
      .file_size = size,
      .table_offset = 64,
      .table_size = 64,
      .chunk_count = 1};
  const sbfi_packed_chunk chunk = {.kind = sbfi_asset_element.kind,
      .level = SBFI_PACKED_NO_LEVEL,
      .flags = 1,
      .stride = 1,
      .offset = 128,
      .stored_size = r->size,
      .raw_size = r->size,
      .count = r->size};
  sbfi_packed_header_put(file, &header);
  sbfi_packed_chunk_put(file + 64, &chunk);
  memcpy(file + 128, r->at, r->size);
  patch_seal(file, size);
  sbf_status status = sbf_packed_load_memory(file, size, NULL, asset, error);
  free(file); /* nothing of such a file is used in place */
  return status;
}

static void expect(const hand_made *r, sbf_code code, const char *path) {
  sbf_asset *asset;
  sbf_diagnostic error;
  ck_assert_int_eq(load_minor(r, 0, &asset, &error), SBF_BAD_INPUT);
  ck_assert_msg(error.code == (int32_t)code, "code %d, not %d: %s", error.code, (int)code, error.message);
  ck_assert_str_eq(error.path, path);
  ck_assert_ptr_null(asset);
}

static void expect_loads(const hand_made *r, uint16_t minor) {
  sbf_asset *asset;
  sbf_diagnostic error;
  sbf_status status = load_minor(r, minor, &asset, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
  ck_assert_str_eq(asset->version, SBF_FORMAT_VERSION); /* it has no parts of a newer version */
  sbf_asset_free(asset);
}

START_TEST(test_a_record_by_hand_loads)
{
  hand_made r = with_version();
  expect_loads(&r, 0);
  put_head(&r, root_field("info"), SBFI_FORM_RECORD, 0);
  expect_loads(&r, 0);
  r.size = 0;
  expect(&r, SBF_CODE_REQUIRED_MISSING, "/sbf/@version");
}
END_TEST

START_TEST(test_fields_stand_in_order_and_once)
{
  hand_made r = with_version();
  put_text(&r, 1, "1.0", 3);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf");
  r = with_version();
  put_head(&r, root_field("environment"), SBFI_FORM_RECORD, 0);
  put_head(&r, root_field("info"), SBFI_FORM_RECORD, 0);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf");
  r = with_version();
  put_head(&r, 0, SBFI_FORM_RECORD, 0);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf");
}
END_TEST

START_TEST(test_a_field_that_is_cut_short)
{
  hand_made whole = with_version(), r;
  for (size_t cut = 1; cut < whole.size; cut++) {
    r = whole;
    r.size = cut;
    expect(&r, SBF_CODE_PACKED_RECORD, "/sbf");
  }
  r = whole;
  patch_put(r.at, 4, 4, UINT32_MAX);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf");
  patch_put(r.at, 4, 4, 5); /* the text itself, or only its padding, beyond the end */
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf");
}
END_TEST

START_TEST(test_fields_of_a_newer_version_are_passed_over)
{
  hand_made r = with_version();
  put_text(&r, 999, "hello", 5);
  put_head(&r, 1000, (sbfi_packed_form)77, 0);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf");
  expect_loads(&r, SBFI_PACKED_MINOR + 1);
  r.size = 0;
  put_text(&r, 1, "1.99", 4); /* with any header */
  expect_loads(&r, 99);
  expect_loads(&r, 0);
}
END_TEST

START_TEST(test_forms_and_sizes_of_values)
{
  hand_made r = {.size = 0}, environment = {.size = 0};
  put_head(&r, 1, SBFI_FORM_VALUE, 4);
  put_number(&r, 0);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf/@version");

  put_head(&environment, 1, SBFI_FORM_VALUE, 8); /* gravity, of three scalars */
  put_number(&environment, 0);
  put_number(&environment, 0);
  r = with_version();
  put_field(&r, root_field("environment"), SBFI_FORM_RECORD, &environment);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf/environment/@gravity");
}
END_TEST

START_TEST(test_texts)
{
  hand_made r = {.size = 0};
  put_text(&r, 1, "1\0000", 3);
  expect(&r, SBF_CODE_BAD_TEXT, "/sbf/@version");
  r.size = 0;
  put_text(&r, 1, "1.\xff", 3);
  expect(&r, SBF_CODE_VALUE_OUT_OF_RANGE, "/sbf/@version");
}
END_TEST

/* One bone with a bool that is neither. */
START_TEST(test_bools_are_false_or_true)
{
  for (uint32_t value = 0; value < 3; value++) {
    hand_made bone = {.size = 0}, bones = {.size = 0}, r = with_version();
    put_text(&bone, 1, "b", 1);
    put_head(&bone, field_of("bones", "head"), SBFI_FORM_VALUE, 12);
    for (int i = 0; i < 3; i++) put_number(&bone, 0);
    put_head(&bone, field_of("bones", "inherit_scale"), SBFI_FORM_VALUE, 4);
    put_number(&bone, value);
    put_number(&bones, 1);
    put_number(&bones, (uint32_t)bone.size);
    put(&bones, bone.at, bone.size);
    put_field(&r, root_field("bones"), SBFI_FORM_RECORDS, &bones);
    if (value < 2)
      expect_loads(&r, 0);
    else
      expect(&r, SBF_CODE_PACKED_RECORD, "/sbf/skeleton/bone[1]/@inherit_scale");
  }
}
END_TEST

START_TEST(test_counts_of_children)
{
  const uint32_t counts[] = {1, 2, 0x40000000, UINT32_MAX};
  for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
    hand_made children = {.size = 0}, r = with_version();
    put_number(&children, counts[i]);
    put_number(&children, 0);
    put_field(&r, root_field("bones"), SBFI_FORM_RECORDS, &children);
    if (counts[i] == 1)
      expect(&r, SBF_CODE_REQUIRED_MISSING, "/sbf/skeleton/bone[1]/@id");
    else
      expect(&r, SBF_CODE_PACKED_RECORD, "/sbf/skeleton");
  }
  hand_made none = {.size = 0}, r = with_version();
  put_field(&r, root_field("bones"), SBFI_FORM_RECORDS, &none);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf/skeleton");
  put_number(&none, 0);
  put_number(&none, 0); /* left over */
  r = with_version();
  put_field(&r, root_field("bones"), SBFI_FORM_RECORDS, &none);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf/skeleton");
}
END_TEST

/* A bone mask whose list is given as `form` with `payload`. */
static hand_made with_mask_list(sbfi_packed_form form, const hand_made *payload) {
  hand_made mask = {.size = 0}, masks = {.size = 0}, r = with_version();
  put_text(&mask, 1, "m", 1);
  put_field(&mask, field_of("bone_masks", "bones"), form, payload);
  while (mask.size % 4) mask.at[mask.size++] = 0;
  put_number(&masks, 1);
  put_number(&masks, (uint32_t)mask.size);
  put(&masks, mask.at, mask.size);
  put_field(&r, root_field("bone_masks"), SBFI_FORM_RECORDS, &masks);
  return r;
}

START_TEST(test_lists)
{
  const char *path = "/sbf/bone_masks/bone_mask[1]/bones";
  hand_made list = {.size = 3}, r = with_mask_list(SBFI_FORM_LIST, &list);
  expect(&r, SBF_CODE_PACKED_RECORD, path); /* no whole item */
  r = with_mask_list(SBFI_FORM_RECORD, &list);
  expect(&r, SBF_CODE_PACKED_RECORD, path);
  r = with_mask_list(SBFI_FORM_CHUNK, &list);
  expect(&r, SBF_CODE_PACKED_RECORD, path); /* no number */
  list.size = 0;
  put_number(&list, 0); /* chunk 0 is the record itself; there is no chunk 7 */
  r = with_mask_list(SBFI_FORM_CHUNK, &list);
  expect(&r, SBF_CODE_PACKED_RECORD, path);
  patch_put(list.at, 0, 4, 7);
  r = with_mask_list(SBFI_FORM_CHUNK, &list);
  expect(&r, SBF_CODE_PACKED_RECORD, path);
  r = with_mask_list(SBFI_FORM_LIST, &list);
  expect(&r, SBF_CODE_INDEX_OUT_OF_RANGE, path);
}
END_TEST

/* The example of the specification, short: 1, 0, 1, 1 through either filter. */
START_TEST(test_filtered_lists)
{
  hand_made list = {.size = 16}, r;
  const uint8_t planes[4] = {1, 0, 1, 1}, delta[4] = {2, 1, 2, 0};
  memcpy(list.at, planes, 4);
  for (int form = SBFI_FORM_PLANES; form <= SBFI_FORM_DELTA; form++) {
    if (form == SBFI_FORM_DELTA) memcpy(list.at, delta, 4);
    r = with_mask_list((sbfi_packed_form)form, &list);
    hand_made bones = {.size = 0}, bone = {.size = 0}, with_bones = with_version();
    put_number(&bones, 2); /* the indices name two bones, which stand before the masks */
    for (int i = 0; i < 2; i++) {
      bone.size = 0;
      put_text(&bone, 1, i ? "b" : "a", 1);
      put_head(&bone, field_of("bones", "head"), SBFI_FORM_VALUE, 12);
      for (int k = 0; k < 3; k++) put_number(&bone, 0);
      put_number(&bones, (uint32_t)bone.size);
      put(&bones, bone.at, bone.size);
    }
    put_field(&with_bones, root_field("bones"), SBFI_FORM_RECORDS, &bones);
    put(&with_bones, r.at + with_version().size, r.size - with_version().size);
    sbf_asset *asset;
    ck_assert_int_eq(load_minor(&with_bones, 0, &asset, NULL), SBF_OK);
    const uint32_t expected[4] = {1, 0, 1, 1};
    ck_assert_uint_eq(asset->bone_masks.at[0].bones.count, 4);
    ck_assert_mem_eq(asset->bone_masks.at[0].bones.at, expected, sizeof expected);
    sbf_asset_free(asset);
  }
  list.size = 15;
  r = with_mask_list(SBFI_FORM_DELTA, &list);
  expect(&r, SBF_CODE_PACKED_RECORD, "/sbf/bone_masks/bone_mask[1]/bones");
}
END_TEST

/* --- chunks of a real file --- */

static sbf_buffer file;
static sbf_diagnostic error;

static void make_file(void) {
  sbf_asset *asset = small_asset();
  ck_assert_int_eq(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = true}, NULL, &file, NULL), SBF_OK);
  sbf_asset_free(asset);
}

static sbf_code load_patched(void) {
  sbf_asset *asset;
  patch_seal(file.at, file.size);
  error.code = 0;
  if (sbf_packed_load_memory(file.at, file.size, NULL, &asset, &error) == SBF_OK) sbf_asset_free(asset);
  return (sbf_code)error.code;
}

/* The chunk number that a record gives for a list: 12 bytes, number and form before it. */
static size_t find_reference(uint32_t number) {
  uint8_t pattern[8] = {4, 0, 0, 0, (uint8_t)number};
  for (size_t at = 64; at + 8 < file.size; at++)
    if (file.at[at - 2] == SBFI_FORM_CHUNK && memcmp(file.at + at, pattern, 8) == 0) return at + 4;
  ck_abort_msg("no reference to chunk %u", number);
  return 0;
}

START_TEST(test_a_chunk_is_referred_to_once_and_by_its_owner)
{
  make_file();
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  size_t index = find_reference(last);
  for (uint32_t other = 0; other < last + 3; other++) {
    patch_put(file.at, index, 4, other);
    if (other == last)
      ck_assert_int_eq(load_patched(), 0);
    else
      ck_assert_msg(load_patched() == SBF_CODE_PACKED_RECORD, "%u for %u", other, last);
  }
  sbf_buffer_free(&file);
}
END_TEST

START_TEST(test_addresses_of_the_table_must_agree)
{
  make_file();
  for (uint32_t i = 1; i < patch_get(file.at, 40, 4); i++) {
    const int fields[][2] = {{PATCH_OWNER, 4}, {PATCH_LEVEL, 4}, {PATCH_FIELD, 2}, {PATCH_LIST, 2}};
    for (int k = 0; k < 4; k++) {
      size_t at = patch_entry(i, (size_t)fields[k][0]);
      uint64_t kept = patch_get(file.at, at, fields[k][1]);
      patch_put(file.at, at, fields[k][1], kept + 1);
      ck_assert_msg(load_patched() == SBF_CODE_PACKED_RECORD, "chunk %u", i);
      patch_put(file.at, at, fields[k][1], kept);
    }
  }
  ck_assert_int_eq(load_patched(), 0);
  sbf_buffer_free(&file);
}
END_TEST

/* The list is still there, but its record has lost it: field 65535 is not known to any version. */
START_TEST(test_chunks_that_nothing_refers_to)
{
  make_file();
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  size_t head = find_reference(last) - 8;
  patch_put(file.at, head, 2, 65535);
  ck_assert_int_eq(load_patched(), SBF_CODE_PACKED_RECORD);
  patch_put(file.at, 10, 2, SBFI_PACKED_MINOR + 1); /* in a newer version it may be something new */
  ck_assert_int_eq(load_patched(), 0);
  sbf_buffer_free(&file);
}
END_TEST

START_TEST(test_items_have_the_size_of_their_field)
{
  make_file();
  uint32_t last = (uint32_t)patch_get(file.at, 40, 4) - 1;
  size_t entry = patch_entry(last, 0);
  ck_assert_uint_eq(patch_get(file.at, entry + PATCH_STRIDE, 4), 8);
  patch_put(file.at, entry + PATCH_STRIDE, 4, 4);
  patch_put(file.at, entry + PATCH_COUNT, 8, 2 * patch_get(file.at, entry + PATCH_COUNT, 8));
  ck_assert_int_eq(load_patched(), SBF_CODE_PACKED_RECORD);
  sbf_buffer_free(&file);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("packed_record");
  TCase *tests = tcase_create("packed_record");
  tcase_add_test(tests, test_a_record_by_hand_loads);
  tcase_add_test(tests, test_fields_stand_in_order_and_once);
  tcase_add_test(tests, test_a_field_that_is_cut_short);
  tcase_add_test(tests, test_fields_of_a_newer_version_are_passed_over);
  tcase_add_test(tests, test_forms_and_sizes_of_values);
  tcase_add_test(tests, test_texts);
  tcase_add_test(tests, test_bools_are_false_or_true);
  tcase_add_test(tests, test_counts_of_children);
  tcase_add_test(tests, test_lists);
  tcase_add_test(tests, test_filtered_lists);
  tcase_add_test(tests, test_a_chunk_is_referred_to_once_and_by_its_owner);
  tcase_add_test(tests, test_addresses_of_the_table_must_agree);
  tcase_add_test(tests, test_chunks_that_nothing_refers_to);
  tcase_add_test(tests, test_items_have_the_size_of_their_field);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
