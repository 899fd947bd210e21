/* Loads as a whole: round trips, the samples, limits, and what goes wrong. */
#define _XOPEN_SOURCE 700
#include <libxml/xmlmemory.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fill_asset.h"
#include "promises.h"
#include "xml_samples.h"

static sbf_buffer saved(const sbf_asset *asset) {
  sbf_buffer buffer;
  sbf_diagnostic error = {0};
  sbf_status status = sbf_xml_save_memory(asset, NULL, NULL, &buffer, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
  return buffer;
}

/* --- round trips --- */

static void round_trip(const fill_options *filled) {
  sbf_asset *asset = fill_asset(filled), *again = NULL;
  sbf_load_options options = fill_load_options(asset);
  sbf_buffer first = saved(asset);
  sbf_diagnostic error = {0};
  char path[256] = "";
  sbf_status status = sbf_xml_load_memory(first.at, first.size, &options, &again, &error);
  ck_assert_msg(status == SBF_OK, "line %u, %s: %s", error.line, error.path, error.message);
  ck_assert_msg(sbf_asset_equal(asset, again, path, sizeof path), "%s", path);
  sbf_buffer second = saved(again);
  ck_assert_uint_eq(first.size, second.size);
  ck_assert_int_eq(memcmp(first.at, second.at, first.size), 0);
  sbf_buffer_free(&first);
  sbf_buffer_free(&second);
  sbf_asset_free(again);
  sbf_asset_free(asset);
}

START_TEST(test_round_trip_of_every_field)
{
  for (uint64_t seed = 0; seed < 20; seed++) round_trip(&(fill_options){.seed = seed});
  round_trip(&(fill_options){.seed = 99, .items = 3000}); /* lists of many pieces */
}
END_TEST

START_TEST(test_round_trip_under_a_comma_locale)
{
  static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
  const char *found = NULL;
  for (size_t i = 0; i < sizeof names / sizeof *names && !found; i++) found = setlocale(LC_ALL, names[i]);
  if (!found) { /* the numbers themselves are tested in test_number_parse and test_number_print */
    harness_skip("no locale with a decimal comma is installed");
    return;
  }
  round_trip(&(fill_options){.seed = 7});
  samples_expect(samples_document("<environment control_tick=\"1.5\"/>\n"), SBF_CODE_VALUE_OUT_OF_RANGE, 2,
      "/sbf/environment/@control_tick", -1);
  sbf_diagnostic error;
  samples_load(samples_document("<environment control_tick=\"1.5\"/>\n"), &error);
  ck_assert_ptr_nonnull(strstr(error.message, "1.5"));
  setlocale(LC_ALL, "C");
}
END_TEST

/* --- samples --- */

static void expect_canonical(const char *path) {
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  size_t size;
  char *text = harness_read(path, &size);
  sbf_status status = sbf_xml_load_file(path, NULL, &asset, &error);
  ck_assert_msg(status == SBF_OK, "%s:%u: %s: %s", path, error.line, error.path, error.message);
  sbf_buffer again = saved(asset);
  ck_assert_msg(again.size == size && memcmp(again.at, text, size) == 0, "%s is not in canonical form", path);
  sbf_buffer_free(&again);
  sbf_asset_free(asset);
  free(text);
}

START_TEST(test_valid_samples)
{ ck_assert_uint_ge(samples_each("spec/samples/valid", ".sbf", expect_canonical), 2); }
END_TEST

/* The first message of a report, which the program printed a key a line. */
static bool read_first_message(const char *report, sbf_diagnostic *first, char *code) {
  char *text = harness_read(report, NULL);
  ck_assert_msg(text != NULL, "%s is not there", report);
  char *begin = strstr(text, "\"messages\": ["), *end = begin ? strstr(begin, "\n    }") : NULL;
  *first = (sbf_diagnostic){.index = -1};
  *code = 0;
  if (end) *end = 0;
  for (char *row = begin ? strtok(begin, "\n") : NULL; row; row = strtok(NULL, "\n")) {
    long long index;
    sscanf(row, " \"code\": \"%63[^\"]", code);
    sscanf(row, " \"path\": \"%255[^\"]", first->path);
    sscanf(row, " \"line\": %u", &first->line);
    if (sscanf(row, " \"index\": %lld", &index) == 1) first->index = index;
  }
  free(text);
  return *code != 0;
}

static uint32_t refused_count;

/* What loads is for the rules of validate/; the rest is refused with the first finding of its report. */
static void expect_report(const char *path) {
  char report[1024], code[64];
  sbf_diagnostic expected, error = {0};
  sbf_asset *asset = NULL;
  if (sbf_load_file(path, NULL, &asset, &error) == SBF_OK) {
    sbf_asset_free(asset);
    return;
  }
  refused_count++;
  snprintf(report, sizeof report, "%.*s.json", (int)(strlen(path) - strlen(".sbf")), path);
  ck_assert_msg(read_first_message(report, &expected, code), "%s has no message", report);
  ck_assert_ptr_null(asset);
  const sbf_code_info *info = sbf_code_find(error.code);
  ck_assert_msg(
      info && strcmp(info->name, code) == 0, "%s: %s: %s", path, info ? info->name : "?", error.message);
  ck_assert_msg(error.line == expected.line, "%s: line %u, not %u", path, error.line, expected.line);
  ck_assert_msg(strcmp(error.path, expected.path) == 0, "%s: at %s, not %s", path, error.path, expected.path);
  ck_assert_msg(error.index == expected.index, "%s: item %lld, not %lld", path, (long long)error.index,
      (long long)expected.index);
  ck_assert_str_eq(error.file, path);
  ck_assert_msg(*error.message && !strchr(error.message, '\n'), "%s: %s", path, error.message);
}

START_TEST(test_invalid_samples)
{
  refused_count = 0;
  samples_each("spec/samples/invalid", ".sbf", expect_report);
  ck_assert_uint_ge(refused_count, 60);
}
END_TEST

/* --- omitted and ignored parts --- */

START_TEST(test_newer_minor_version)
{
  sbf_diagnostic error;
  sbf_asset *asset =
      samples_load("<sbf version=\"1.99\" mood=\"new\">\n"
                   "  <skeleton colour=\"red\">\n"
                   "    <bone id=\"root\" head=\"0 0 0\" muscle=\"3\"><nerve x=\"1\">4 5</nerve></bone>\n"
                   "    <cartilage><deep/></cartilage>\n"
                   "  </skeleton>\n"
                   "  <weather>rain<drop/></weather>\n"
                   "</sbf>\n",
          &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  ck_assert_uint_eq(asset->bones.count, 1);
  ck_assert_str_eq(asset->version, SBF_FORMAT_VERSION); /* it has no parts of a newer version */
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_ignored_syntax)
{
  sbf_diagnostic error;
  sbf_asset *asset =
      samples_load("\xef\xbb\xbf<?xml version='1.0' encoding='utf-8'?>\r\n"
                   "<!-- a comment --><?pi x?>\r\n"
                   "<sbf xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\r\n"
                   " xsi:noNamespaceSchemaLocation=\"sbf.xsd\" xml:lang=\"en\" version=\"1.0\">\r\n"
                   "<skeleton/><materials> <!-- none --> </materials><environment/>\r\n"
                   "<soft_body id='b'><interior><!-- 1 2 3 --></interior></soft_body></sbf>",
          &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  ck_assert_uint_eq(asset->bones.count, 0);
  ck_assert_uint_eq(asset->soft_bodies.at[0].interior.count, 0);
  ck_assert_ptr_null(asset->soft_bodies.at[0].interior.at);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_bodies_may_be_separate)
{
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(
      samples_document("<soft_body id=\"a\"/><render_mesh id=\"m\"/><soft_body id=\"b\"/>\n"), &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  ck_assert_uint_eq(asset->soft_bodies.count, 2);
  ck_assert_str_eq(asset->soft_bodies.at[1].id, "b");
  sbf_asset_free(asset);
}
END_TEST

/* --- limits --- */

static sbf_code code_with(const char *text, sbf_limits limits) {
  sbf_load_options options = {.limits = limits};
  sbf_asset *asset;
  sbf_diagnostic error = {0};
  sbf_status status = sbf_xml_load_memory(text, strlen(text), &options, &asset, &error);
  ck_assert_int_eq(status == SBF_OK, asset != NULL);
  sbf_asset_free(asset);
  return status == SBF_OK ? SBF_CODE_NONE : (sbf_code)error.code;
}

START_TEST(test_limits)
{
  const char *text =
      samples_document("<soft_body id=\"a\"><interior>0 0 0 1 1 1 2 2 2</interior></soft_body>\n");
  uint64_t size = strlen(text);
  ck_assert_int_eq(code_with(text, (sbf_limits){.list_items = 3}), SBF_CODE_NONE);
  ck_assert_int_eq(code_with(text, (sbf_limits){.list_items = 2}), SBF_CODE_LIST_TOO_LONG);
  ck_assert_int_eq(code_with(text, (sbf_limits){.depth = 3}), SBF_CODE_NONE);
  ck_assert_int_eq(code_with(text, (sbf_limits){.depth = 2}), SBF_CODE_XML_TOO_DEEP);
  ck_assert_int_eq(code_with(text, (sbf_limits){.file_bytes = size}), SBF_CODE_NONE);
  ck_assert_int_eq(code_with(text, (sbf_limits){.file_bytes = size - 1}), SBF_CODE_IO_TOO_LARGE);
  uint64_t enough = 0;
  while (code_with(text, (sbf_limits){.memory_bytes = ++enough}) != SBF_CODE_NONE)
    ck_assert_int_eq(code_with(text, (sbf_limits){.memory_bytes = enough}), SBF_CODE_OUT_OF_MEMORY);
  ck_assert_uint_gt(enough, 9 * sizeof(float));
  ck_assert_uint_lt(enough, 4096);
}
END_TEST

/* Ten million characters are where libxml2's tree would give up. */
START_TEST(test_long_lists_and_texts)
{
  enum { ITEMS = 1100000, ROW = 12 };
  static const char row[] = "0.5 -1.25 3 ";
  size_t size = 0, capacity = (size_t)ITEMS * ROW + 200;
  char *text = malloc(capacity);
  size += (size_t)sprintf(text, "<sbf version=\"1.0\"><soft_body id=\"a\"><interior>");
  for (int i = 0; i < ITEMS; i++, size += ROW) memcpy(text + size, row, ROW);
  size += (size_t)sprintf(text + size, "</interior></soft_body></sbf>");
  sbf_asset *asset;
  sbf_diagnostic error = {0};
  ck_assert_msg(sbf_xml_load_memory(text, size, NULL, &asset, &error) == SBF_OK, "%s", error.message);
  ck_assert_uint_eq(asset->soft_bodies.at[0].interior.count, ITEMS);
  ck_assert_float_eq(asset->soft_bodies.at[0].interior.at[ITEMS - 1].y, -1.25f);
  sbf_asset_free(asset);

  size = (size_t)sprintf(text, "<sbf version=\"1.0\"><extensions><extension name=\"X\"><data>");
  memset(text + size, 'x', 11000000);
  size += 11000000;
  size += (size_t)sprintf(text + size, "</data></extension></extensions></sbf>");
  ck_assert_msg(sbf_xml_load_memory(text, size, NULL, &asset, &error) == SBF_OK, "%s", error.message);
  ck_assert_uint_eq(strlen(asset->extensions.at[0].data), 11000000);
  sbf_asset_free(asset);

  /* an attribute or a comment of that size is nobody's file */
  size = (size_t)sprintf(text, "<sbf version=\"1.0\"><asset title=\"");
  memset(text + size, 'x', 11000000);
  size += 11000000;
  size += (size_t)sprintf(text + size, "\"/></sbf>");
  ck_assert_int_eq(sbf_xml_load_memory(text, size, NULL, &asset, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_XML_SYNTAX);
  free(text);
}
END_TEST

/* --- lists that the caller hands over --- */

static sbf_status load_given(
    const char *text, const sbf_given_list *lists, uint32_t count, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options options = {.given_lists = lists, .given_list_count = count, .limits.list_items = 4};
  *error = (sbf_diagnostic){0};
  return sbf_xml_load_memory(text, strlen(text), &options, asset, error);
}

#define GIVEN_BODY(NUMBER)                                                                                   \
  "<sbf version=\"1.0\"><soft_body id=\"a\"><interior given=\"" NUMBER "\">7 8 "                             \
  "9</interior></soft_body></sbf>"

START_TEST(test_lists_in_memory)
{
  static const float numbers[] = {1, 2, 3, 4, 5, 0.1f, 6, 7, 8, 9, 10, 11, 1, 1, 1};
  static const float endless[] = {0, 0, INFINITY};
  const sbf_given_list lists[] = {{numbers, 0}, {numbers, 6 * sizeof(float)}, {numbers, sizeof numbers},
      {numbers, 5 * sizeof(float)}, {numbers, 7}, {endless, sizeof endless}};
  sbf_asset *asset;
  sbf_diagnostic error;
  ck_assert_int_eq(load_given(GIVEN_BODY("1"), lists, 6, &asset, &error), SBF_OK);
  ck_assert_uint_eq(asset->soft_bodies.at[0].interior.count, 3); /* those given, and the text's */
  ck_assert_float_eq(asset->soft_bodies.at[0].interior.at[1].z, 0.1f);
  ck_assert_float_eq(asset->soft_bodies.at[0].interior.at[2].x, 7);
  sbf_asset_free(asset);
  ck_assert_int_eq(load_given(GIVEN_BODY("0"), lists, 6, &asset, &error), SBF_OK);
  ck_assert_uint_eq(asset->soft_bodies.at[0].interior.count, 1);
  sbf_asset_free(asset);

  static const struct {
    const char *text;
    sbf_code code;
  } bad[] = {{GIVEN_BODY("2"), SBF_CODE_LIST_TOO_LONG}, {GIVEN_BODY("3"), SBF_CODE_WRONG_LENGTH},
      {GIVEN_BODY("4"), SBF_CODE_WRONG_LENGTH}, {GIVEN_BODY("5"), SBF_CODE_VALUE_NOT_FINITE},
      {GIVEN_BODY("6"), SBF_CODE_XML_BAD_VALUE}, {GIVEN_BODY("-1"), SBF_CODE_XML_BAD_VALUE},
      {GIVEN_BODY("one"), SBF_CODE_XML_BAD_VALUE}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    ck_assert_int_eq(load_given(bad[i].text, lists, 6, &asset, &error), SBF_BAD_INPUT);
    ck_assert_ptr_null(asset);
    ck_assert_msg(error.code == (int32_t)bad[i].code, "%zu: %d %s", i, error.code, error.message);
    ck_assert_str_eq(error.path, "/sbf/soft_body[1]/interior");
  }
  /* a file, with which nothing is handed over, has no such attribute */
  ck_assert_int_eq(load_given(GIVEN_BODY("0"), NULL, 0, &asset, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_XML_UNKNOWN_ATTRIBUTE);
}
END_TEST

/* --- damage --- */

START_TEST(test_truncated_everywhere)
{
  size_t size;
  char *text = harness_read(harness_source("spec/samples/valid/jelly.sbf"), &size);
  size_t last = size;
  while (text[last - 1] != '>') last--;
  for (size_t cut = 0; cut <= size; cut++) {
    char *part = malloc(cut + 1); /* of that size, so that a sanitizer sees every step past its end */
    memcpy(part, text, cut);
    sbf_asset *asset;
    sbf_diagnostic error = {0};
    sbf_status status = sbf_xml_load_memory(part, cut, NULL, &asset, &error);
    ck_assert_int_eq(status, cut < last ? SBF_BAD_INPUT : SBF_OK);
    if (status != SBF_OK) {
      ck_assert_msg(
          error.code == SBF_CODE_XML_SYNTAX || error.code == SBF_CODE_NOT_UTF8, "%s", error.message);
      ck_assert_uint_gt(error.line, 0);
    }
    sbf_asset_free(asset);
    free(part);
  }
  free(text);
}
END_TEST

/* Any byte changed: it loads or it does not, and says where; nothing else happens. */
START_TEST(test_damaged_everywhere)
{
  size_t size;
  char *text = harness_read(harness_source("spec/samples/valid/jelly.sbf"), &size);
  static const char bytes[] = {0, '<', '>', '&', '"', ' ', '9', '-', 'e', '\xff'};
  for (size_t i = 0; i < size; i++) {
    char kept = text[i];
    text[i] = bytes[i % sizeof bytes];
    sbf_asset *asset;
    sbf_diagnostic error = {0};
    if (sbf_xml_load_memory(text, size, NULL, &asset, &error) == SBF_OK)
      ck_assert_promises_kept(asset);
    else
      ck_assert_uint_gt(error.line, 0);
    sbf_asset_free(asset);
    text[i] = kept;
  }
  free(text);
}
END_TEST

START_TEST(test_our_memory_runs_out)
{
  size_t size;
  char *text = harness_read(harness_source("spec/samples/valid/jelly.sbf"), &size);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_load_options options = {.allocator = &memory.allocator};
    sbf_asset *asset;
    sbf_diagnostic error = {0};
    sbf_status status = sbf_xml_load_memory(text, size, &options, &asset, &error);
    if (status == SBF_OK) {
      sbf_asset_free(asset);
      ck_assert_uint_eq(memory.held_bytes, 0);
      ck_assert_uint_gt(allowed, 20);
      break;
    }
    ck_assert_int_eq(status, SBF_FAILED);
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    ck_assert_ptr_null(asset);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  free(text);
}
END_TEST

static size_t parser_calls, parser_allowed;

static void *parser_malloc(size_t size) {
  return parser_calls++ < parser_allowed ? malloc(size) : NULL;
}
static void *parser_realloc(void *memory, size_t size) {
  return parser_calls++ < parser_allowed ? realloc(memory, size) : NULL;
}
static char *parser_strdup(const char *text) {
  return parser_calls++ < parser_allowed ? strdup(text) : NULL;
}

/* libxml2's own allocations. */
START_TEST(test_memory_of_the_parser_runs_out)
{
  size_t size;
  char *text = harness_read(harness_source("spec/samples/valid/jelly.sbf"), &size);
  parser_allowed = SIZE_MAX;
  ck_assert_int_eq(xmlMemSetup(free, parser_malloc, parser_realloc, parser_strdup), 0);
  sbf_asset *expected, *asset;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(
      sbf_xml_load_memory(text, size, NULL, &expected, &error), SBF_OK); /* the expected result */
  for (size_t allowed = 0;; allowed++) {
    parser_calls = 0;
    parser_allowed = allowed;
    sbf_status status = sbf_xml_load_memory(text, size, NULL, &asset, &error);
    bool all_served = parser_calls <= allowed;
    if (status == SBF_OK)
      ck_assert(sbf_asset_equal(asset, expected, NULL, 0)); /* it could do without */
    else
      ck_assert_msg(error.code == SBF_CODE_OUT_OF_MEMORY, "%d: %s", error.code, error.message);
    ck_assert_int_eq(status == SBF_OK, asset != NULL);
    sbf_asset_free(asset);
    if (!all_served) continue;
    ck_assert_int_eq(status, SBF_OK);
    ck_assert_uint_gt(allowed, 10);
    break;
  }
  sbf_asset_free(expected);
  parser_allowed = SIZE_MAX;
  free(text);
}
END_TEST

/* --- files --- */

START_TEST(test_files)
{
  sbf_asset *asset;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbf_xml_load_file(harness_scratch("not_there.sbf"), NULL, &asset, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_READ);
  ck_assert_ptr_nonnull(strstr(error.file, "not_there.sbf"));
  ck_assert_int_eq(
      sbf_xml_load_file("/dev/null", NULL, &asset, &error), SBF_BAD_INPUT); /* not a regular one */
  ck_assert_int_eq(error.code, SBF_CODE_XML_SYNTAX);
  ck_assert_int_eq(sbf_xml_load_file(harness_scratch("not_there.sbf"), NULL, &asset, NULL), SBF_FAILED);

  sbf_load_options options = {.name = "in memory"};
  ck_assert_int_eq(sbf_xml_load_memory("<a/>", 4, &options, &asset, &error), SBF_BAD_INPUT);
  ck_assert_str_eq(error.file, "in memory");
}
END_TEST

int main(void) {
  Suite *suite = suite_create("xml_load");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_round_trip_of_every_field);
  tcase_add_test(all, test_round_trip_under_a_comma_locale);
  tcase_add_test(all, test_valid_samples);
  tcase_add_test(all, test_invalid_samples);
  tcase_add_test(all, test_newer_minor_version);
  tcase_add_test(all, test_ignored_syntax);
  tcase_add_test(all, test_bodies_may_be_separate);
  tcase_add_test(all, test_limits);
  tcase_add_test(all, test_long_lists_and_texts);
  tcase_add_test(all, test_lists_in_memory);
  tcase_add_test(all, test_truncated_everywhere);
  tcase_add_test(all, test_damaged_everywhere);
  tcase_add_test(all, test_our_memory_runs_out);
  tcase_add_test(all, test_memory_of_the_parser_runs_out);
  tcase_add_test(all, test_files);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
