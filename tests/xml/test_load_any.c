#define _XOPEN_SOURCE 700
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fill_asset.h"
#include "model/asset_box.h"
#include "xml_samples.h"

static void save_and_load(const char *path, bool packed) {
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 3}), *again = NULL;
  sbf_load_options options = fill_load_options(asset);
  sbf_diagnostic error = {0};
  size_t size;
  ck_assert_msg(sbf_save_file(asset, path, NULL, &error) == SBF_OK, "%s", error.message);
  char *bytes = harness_read(path, &size);
  ck_assert_int_eq((unsigned char)bytes[0] == 0x89, packed);
  ck_assert_msg(sbf_load_file(path, &options, &again, &error) == SBF_OK, "%s", error.message);
  char where[256] = "";
  ck_assert_msg(sbf_asset_equal(asset, again, where, sizeof where), "%s", where);
  sbf_asset_free(again);
  sbf_asset_free(asset);
  free(bytes);
}

START_TEST(test_saving_follows_the_name_and_loading_the_bytes)
{
  save_and_load(harness_scratch("any.sbf"), false);
  save_and_load(harness_scratch("any.sbfz"), true);
  save_and_load(harness_scratch("ANY.SBFZ"), true);
  save_and_load(harness_scratch("any"), false);
  save_and_load(harness_scratch("sbfz"), false);
  /* the name counts for nothing when loading */
  char from[1024], to[1024];
  snprintf(from, sizeof from, "%s", harness_scratch("any.sbfz"));
  snprintf(to, sizeof to, "%s", harness_scratch("misnamed.sbf"));
  ck_assert_int_eq(rename(from, to), 0);
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 3}), *again;
  sbf_load_options options = fill_load_options(asset);
  ck_assert_int_eq(sbf_load_file(to, &options, &again, NULL), SBF_OK);
  sbf_asset_free(again);
  sbf_asset_free(asset);
}
END_TEST

static void expect(const char *bytes, size_t size, sbf_code code) {
  const char *path = harness_scratch("odd");
  sbf_asset *asset;
  sbf_diagnostic error = {0};
  ck_assert(harness_write(path, bytes, size));
  ck_assert_int_eq(sbf_load_file(path, NULL, &asset, &error), SBF_BAD_INPUT);
  ck_assert_ptr_null(asset);
  ck_assert_msg(error.code == (int32_t)code, "code %d, not %d: %s", error.code, (int)code, error.message);
  ck_assert_str_eq(error.file, path);
}

START_TEST(test_other_content)
{
  expect("", 0, SBF_CODE_IO_UNKNOWN_FORMAT);
  expect("v 0 0 0\n", 8, SBF_CODE_IO_UNKNOWN_FORMAT);
  expect("\xff\xff\xff", 3, SBF_CODE_IO_UNKNOWN_FORMAT);
  expect("  \n<COLLADA/>", 13, SBF_CODE_XML_NOT_SBF);
  expect("<COLLADA/>", 10, SBF_CODE_XML_NOT_SBF);
  expect("\xef\xbb\xbf<COLLADA/>", 13, SBF_CODE_XML_NOT_SBF);
  expect("\xff\xfe<\0s\0", 6, SBF_CODE_XML_SYNTAX);
  expect("\0<\0s", 4, SBF_CODE_XML_SYNTAX);
  expect("\x89", 1, SBF_CODE_PACKED_TRUNCATED);
  expect("\x89SBF\n\x1a\n", 7, SBF_CODE_PACKED_MAGIC);
  expect("\tSBF\r\n\x1a\n", 8, SBF_CODE_PACKED_MAGIC);
}
END_TEST

START_TEST(test_missing_file)
{
  sbf_asset *asset;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbf_load_file(harness_scratch("no such"), NULL, &asset, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_READ);
  ck_assert_int_eq(sbf_load_file(harness_scratch("no such"), NULL, &asset, NULL), SBF_FAILED);
  ck_assert_int_eq(sbf_load_file("/", NULL, &asset, &error), SBF_FAILED);
}
END_TEST

/* What cannot be sought in: a named pipe that another process writes to. */
static sbf_status load_through_pipe(const char *name, sbf_asset **asset) {
  char pipe_path[1024];
  size_t size;
  snprintf(pipe_path, sizeof pipe_path, "%s", harness_scratch("pipe"));
  char *bytes = harness_read(harness_scratch(name), &size);
  unlink(pipe_path);
  ck_assert_int_eq(mkfifo(pipe_path, 0600), 0);
  pid_t child = fork();
  if (child == 0) {
    FILE *pipe_end =
        fopen(pipe_path, "wb"); /* not harness_write, which would put a file in the pipe's place */
    _exit(pipe_end && fwrite(bytes, 1, size, pipe_end) == size && fclose(pipe_end) == 0 ? 0 : 1);
  }
  sbf_diagnostic error = {0};
  sbf_status status = sbf_load_file(pipe_path, NULL, asset, &error);
  if (status != SBF_OK) fprintf(stderr, "%s\n", error.message);
  waitpid(child, NULL, 0);
  unlink(pipe_path);
  free(bytes);
  return status;
}

START_TEST(test_pipes)
{
  sbf_diagnostic error;
  sbf_asset *asset =
      samples_load(samples_document("<soft_body id=\"a\"><interior>1 2 3</interior></soft_body>"), &error);
  sbf_save_file(asset, harness_scratch("piped.sbf"), NULL, NULL);
  sbf_save_file(asset, harness_scratch("piped.sbfz"), &(sbf_save_options){.store = true}, NULL);
  static const char *const names[] = {"piped.sbf", "piped.sbfz"};
  for (int i = 0; i < 2; i++) {
    sbf_asset *again = NULL;
    ck_assert_int_eq(load_through_pipe(names[i], &again), SBF_OK);
    ck_assert(sbf_asset_equal(asset, again, NULL, 0));
    sbf_asset_free(again);
  }
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_all_findings_of_a_file)
{
  static const char text[] = "<sbf version=\"1.0\">\n"
                             "<soft_body id=\"a\"><attributes density=\"0\"/></soft_body>\n"
                             "<soft_body id=\"a\"/>\n"
                             "</sbf>\n";
  const char *path = harness_scratch("findings.sbf");
  sbf_diagnostic found[5];
  uint32_t count = 9;
  sbf_asset *asset;
  ck_assert(harness_write(path, text, sizeof text - 1));
  ck_assert_int_eq(sbf_load_file_findings(path, NULL, &asset, found, 5, &count), SBF_BAD_INPUT);
  ck_assert_ptr_null(asset);
  ck_assert_uint_eq(count, 2);
  ck_assert_int_eq(found[0].code, SBF_CODE_VALUE_OUT_OF_RANGE);
  ck_assert_uint_eq(found[0].line, 2);
  ck_assert_int_eq(found[1].code, SBF_CODE_ID_REPEATED);
  ck_assert_uint_eq(found[1].line, 3);
  ck_assert_str_eq(found[1].file, path);
  ck_assert_int_eq(sbf_load_file_findings(path, NULL, &asset, found, 1, &count), SBF_BAD_INPUT);
  ck_assert_uint_eq(count, 1);
  ck_assert_int_eq(
      sbf_load_file_findings(harness_scratch("no such"), NULL, &asset, found, 5, &count), SBF_FAILED);
  ck_assert_uint_eq(count, 1);
  path = harness_source("spec/samples/valid/minimal.sbf");
  ck_assert_int_eq(sbf_load_file_findings(path, NULL, &asset, found, 5, &count), SBF_OK);
  ck_assert_uint_eq(count, 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_lines_of_findings_made_elsewhere)
{
  const char *path = harness_source("spec/samples/valid/jelly.sbf");
  sbf_diagnostic found[] = {
      {.path = "/sbf/skeleton/bone[2]/@length", .index = -1},
      {.path = "/sbf/soft_body[1]/level[1]/tetrahedron_mesh", .index = 1}, /* an element has no items */
      {.path = "/sbf/soft_body[1]/level[2]/positions", .index = 4},
      {.path = "/sbf/soft_body[1]/level[2]/positions", .index = 600},
      {.path = "/sbf/soft_body[7]", .index = -1},
      {.path = "/sbf/skeleton", .index = -1, .line = 4242},
      {.path = "", .index = -1},
  };
  sbf_locate_findings(path, NULL, found, 7);
  size_t size;
  char *text = harness_read(path, &size);
  static const char *const begins[] = {
      "<bone id=\"tip\"", "<tetrahedron_mesh", "0 1.6 0 0 1.2 0", "<positions>"};
  for (int i = 0; i < 4; i++) {
    const char *line = text;
    for (uint32_t k = 1; k < found[i].line; k++) line = strchr(line, '\n') + 1;
    line += strspn(line, " ");
    ck_assert_msg(strncmp(line, begins[i], strlen(begins[i])) == 0, "%d: %.30s", i, line);
  }
  ck_assert_uint_eq(found[4].line, 0);
  ck_assert_uint_eq(found[5].line, 4242); /* as it was */
  ck_assert_uint_eq(found[6].line, 0);
  free(text);
  sbf_locate_findings(harness_scratch("no such"), NULL, found, 7);
}
END_TEST

/* Loads the file with `limits`: the code of the failure, or SBF_CODE_NONE. */
static int32_t code_with(const char *path, const sbf_asset *asset, sbf_limits limits, uint64_t *used_bytes) {
  sbf_load_options options = fill_load_options(asset);
  sbf_asset *loaded;
  sbf_diagnostic error = {0};
  harness_memory memory;
  harness_memory_init(&memory, SIZE_MAX);
  options.allocator = &memory.allocator;
  options.limits = limits;
  options.copy_file = true;
  sbf_status status = sbf_load_file(path, &options, &loaded, &error);
  if (status == SBF_OK && used_bytes) *used_bytes = sbfi_asset_box_of(loaded)->arena.used_bytes;
  ck_assert((status == SBF_OK) == (loaded != NULL));
  sbf_asset_free(loaded);
  ck_assert_uint_eq(memory.held_bytes, 0);
  return status == SBF_OK ? SBF_CODE_NONE : error.code;
}

/* Every limit of either form, from a file: at it the file loads, one past it nothing is made. What a packed
 * file inflates to is limited in test_packed_load.c. */
START_TEST(test_limits_of_files_at_and_past)
{
  static const char *const names[] = {"limited.sbf", "limited.sbfz"};
  static const int32_t too_deep[] = {SBF_CODE_XML_TOO_DEEP, SBF_CODE_PACKED_RECORD};
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 4, .items = 600});
  const char *path = harness_scratch(names[_i]);
  ck_assert_int_eq(sbf_save_file(asset, path, NULL, NULL), SBF_OK);
  uint64_t used = 0;
  size_t size;
  ck_assert_int_eq(code_with(path, asset, (sbf_limits){0}, &used), SBF_CODE_NONE);
  free(harness_read(path, &size));

  ck_assert_int_eq(code_with(path, asset, (sbf_limits){.file_bytes = size}, NULL), SBF_CODE_NONE);
  ck_assert_int_eq(code_with(path, asset, (sbf_limits){.file_bytes = size - 1}, NULL), SBF_CODE_IO_TOO_LARGE);
  uint64_t memory = used; /* the least that will do: what keeps the file itself is not the asset's */
  ck_assert_int_eq(code_with(path, asset, (sbf_limits){.memory_bytes = memory}, NULL), SBF_CODE_NONE);
  while (code_with(path, asset, (sbf_limits){.memory_bytes = memory - 1}, NULL) == SBF_CODE_NONE) memory--;
  ck_assert_uint_lt(used - memory, 128);
  ck_assert_int_eq(
      code_with(path, asset, (sbf_limits){.memory_bytes = memory - 1}, NULL), SBF_CODE_OUT_OF_MEMORY);

  uint32_t items = 1, depth = 1;
  while (code_with(path, asset, (sbf_limits){.list_items = items}, NULL) != SBF_CODE_NONE) items *= 2;
  for (uint32_t step = items / 2; step; step /= 2)
    if (code_with(path, asset, (sbf_limits){.list_items = items - step}, NULL) == SBF_CODE_NONE)
      items -= step;
  ck_assert_uint_ge(items, 600);
  ck_assert_int_eq(
      code_with(path, asset, (sbf_limits){.list_items = items - 1}, NULL), SBF_CODE_LIST_TOO_LONG);
  while (code_with(path, asset, (sbf_limits){.depth = depth}, NULL) != SBF_CODE_NONE)
    ck_assert_int_eq(code_with(path, asset, (sbf_limits){.depth = depth++}, NULL), too_deep[_i]);
  ck_assert_uint_gt(depth, 3);
  ck_assert_uint_lt(depth, 32);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("load_any");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_saving_follows_the_name_and_loading_the_bytes);
  tcase_add_test(all, test_other_content);
  tcase_add_test(all, test_missing_file);
  tcase_add_test(all, test_pipes);
  tcase_add_test(all, test_all_findings_of_a_file);
  tcase_add_test(all, test_lines_of_findings_made_elsewhere);
  tcase_add_loop_test(all, test_limits_of_files_at_and_past, 0, 2);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
