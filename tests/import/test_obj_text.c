#include "import/obj/obj_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"

/* A copy that ends with its last byte, so that a sanitizer sees a read beyond it. */
static sbf_status read_exact(sbfi_obj_text *text, const char *bytes, size_t size, sbf_diagnostic *error) {
  char *copy = malloc(size ? size : 1);
  memcpy(copy, bytes, size);
  sbf_status status = sbfi_obj_text_read(text, copy, size, NULL, error);
  /* Names point into the copy: a test that looks at them uses the text it was made from. */
  free(copy);
  return status;
}

static void refused(const char *bytes, sbf_code code, uint32_t line) {
  sbfi_obj_text text;
  sbf_diagnostic error = {0};
  sbf_status status = read_exact(&text, bytes, strlen(bytes), &error);
  ck_assert_msg(status == SBF_BAD_INPUT, "was read: %s", bytes);
  ck_assert_msg(error.code == (int32_t)code, "%s: code %d, %s", bytes, (int)error.code, error.message);
  ck_assert_msg(error.line == line, "%s: line %u, %s", bytes, error.line, error.message);
  ck_assert_uint_gt(strlen(error.message), 10);
  ck_assert_uint_eq(text.points.count, 0);
}

static void accepted(sbfi_obj_text *text, const char *bytes) {
  sbf_diagnostic error = {0};
  sbf_status status = sbfi_obj_text_read(text, bytes, strlen(bytes), NULL, &error);
  ck_assert_msg(status == SBF_OK, "%s: line %u %s", bytes, error.line, error.message);
}

static void expect_corners(const sbfi_obj_text *text, const int32_t (*expected)[3], size_t count) {
  ck_assert_uint_eq(text->corners.count, count);
  ck_assert_int_eq(memcmp(text->corners.at, expected, count * sizeof *expected), 0);
}

static const char four[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt .5 1\nvn 0 0 1\nvn 0 1 0\n";

static void with_four(sbfi_obj_text *text, const char *rest) {
  static char bytes[512];
  snprintf(bytes, sizeof bytes, "%s%s", four, rest);
  accepted(text, bytes);
}

START_TEST(corners_in_every_form)
{
  sbfi_obj_text text;
  with_four(&text, "f 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//2 3//1\nf 1/1/1 2/ 3/2/ 4//2\n");
  static const int32_t expected[][3] = {{0, -1, -1}, {1, -1, -1}, {2, -1, -1}, {0, 0, -1}, {1, 1, -1},
      {2, 2, -1}, {0, -1, 0}, {1, -1, 1}, {2, -1, 0}, {0, 0, 0}, {1, -1, -1}, {2, 1, -1}, {3, -1, 1}};
  expect_corners(&text, expected, 13);
  sbfi_obj_text_free(&text);
}
END_TEST

START_TEST(negative_indices_count_back_from_the_line)
{
  sbfi_obj_text text;
  accepted(&text, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf -3/-1 -2/-1 -1/-1\nv 5 5 5\nf -1 -2 -3\n");
  static const int32_t expected[][3] = {
      {0, 0, -1}, {1, 0, -1}, {2, 0, -1}, {3, -1, -1}, {2, -1, -1}, {1, -1, -1}};
  expect_corners(&text, expected, 6);
  sbfi_obj_text_free(&text);
}
END_TEST

START_TEST(a_face_may_come_before_its_vertices)
{
  sbfi_obj_text text;
  accepted(&text, "f 1/1 2/1 3/1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n");
  static const int32_t expected[][3] = {{0, 0, -1}, {1, 0, -1}, {2, 0, -1}};
  expect_corners(&text, expected, 3);
  ck_assert_uint_eq(text.forward.count, 0);
  sbfi_obj_text_free(&text);
}
END_TEST

static const char *const line_ends[] = {"\n", "\r\n", "\r"};

START_TEST(lines_end_with_lf_crlf_or_cr)
{
  char bytes[512] = "";
  const char *lines[] = {"# made by hand", "o First part", "v 0 0 0", "v\t1  0 0 ", " v 0 1 0 # corner", "",
      "g a b", "usemtl red paint", "f 1 2 \\", "  3", "mtllib my colours.mtl"};
  for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
    strcat(bytes, lines[i]);
    strcat(bytes, line_ends[_i]);
  }
  sbfi_obj_text text;
  accepted(&text, bytes);
  ck_assert_uint_eq(text.points.count, 3);
  ck_assert_uint_eq(text.polygons.count, 1);
  ck_assert(sbfi_span_is(*(const sbfi_span *)text.objects.at, "First part"));
  ck_assert(sbfi_span_is(*(const sbfi_span *)text.groups.names.at, "a b"));
  ck_assert(sbfi_span_is(*(const sbfi_span *)text.materials.names.at, "red paint"));
  ck_assert(sbfi_span_is(*(const sbfi_span *)text.libraries.at, "my colours.mtl"));
  ck_assert_int_eq(((const sbfi_obj_polygon *)text.polygons.at)->material, 0);
  ck_assert_uint_eq(text.ignored_count, 0);
  sbfi_obj_text_free(&text);
  strcat(bytes, "f 1 2 9");
  refused(bytes, SBF_CODE_IMPORT_INDEX, 12);
}
END_TEST

START_TEST(comments_are_not_continued_over_their_backslash)
{
  sbfi_obj_text text;
  accepted(&text, "# C:\\models\\\nv 0 0 0\nv 1 0 0 # D:\\\nv 0 1 0 \\\n 0.5 0.5 0.5\nf 1 2 3");
  ck_assert_uint_eq(text.points.count, 3);
  ck_assert_uint_eq(text.polygons.count, 1);
  sbfi_obj_text_free(&text);
}
END_TEST

START_TEST(weights_and_colours_are_passed_over)
{
  sbfi_obj_text text;
  accepted(&text, "v 1 2 3 0.5\nv 4 5 6 1 0 0\nv 7 8 9 # plain\nvt 1\nvt 1 2 3\nf 1/1 2/2 3/2\n");
  const sbf_vec3 *points = text.points.at;
  ck_assert(points[1].x == 4 && points[1].y == 5 && points[1].z == 6 && points[2].z == 9);
  const sbf_vec2 *uvs = text.uvs.at;
  ck_assert(uvs[0].x == 1 && uvs[0].y == 0 && uvs[1].y == 2);
  sbfi_obj_text_free(&text);
}
END_TEST

START_TEST(runs_and_blocks)
{
  sbfi_obj_text text;
  accepted(&text,
      "v 0 0 0\nvt 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 3\nv 2 2 2\ng x\nv 3 3 3\nf 1 2 4\ng y\ng x\nf 1 2 5\n");
  const sbfi_obj_run *runs = text.runs.at;
  ck_assert_uint_eq(text.runs.count, 5);
  ck_assert(runs[0].object == -1 && runs[0].group == -1 && runs[0].first_polygon == 0);
  ck_assert(runs[1].object == 0 && runs[1].group == -1 && runs[1].first_polygon == 0);
  ck_assert(runs[2].object == 0 && runs[2].group == 0 && runs[2].first_polygon == 1);
  ck_assert(runs[3].group == 1 && runs[3].first_polygon == 2);
  ck_assert(runs[4].group == 0 && runs[4].first_polygon == 2);
  const sbfi_obj_block *blocks = text.blocks.at;
  ck_assert_uint_eq(text.blocks.count, 3);
  ck_assert(blocks[0].first_point == 0 && blocks[0].run == 0);
  ck_assert(blocks[1].first_point == 3 && blocks[1].run == 1);
  ck_assert(blocks[2].first_point == 4 && blocks[2].run == 2);
  sbfi_obj_text_free(&text);
}
END_TEST

START_TEST(other_statements_are_counted)
{
  sbfi_obj_text text;
  accepted(&text, "s 1\ns off\nvp 1 2\nl 1 2\np 1\ncurv 0 1 1 2\n");
  ck_assert_uint_eq(text.ignored_count, 3);
  ck_assert_uint_eq(text.ignored_line, 4);
  ck_assert(sbfi_span_is(text.ignored_keyword, "l"));
  sbfi_obj_text_free(&text);
}
END_TEST

START_TEST(errors_name_their_line)
{
  refused("v 0 0 0\nv 1 0\n", SBF_CODE_IMPORT_SYNTAX, 2);
  refused("v 0 0 # 0\n", SBF_CODE_IMPORT_SYNTAX, 1);
  refused("\n\nv 0 0 abc\n", SBF_CODE_IMPORT_SYNTAX, 3);
  refused("v 0 0 0x10\n", SBF_CODE_IMPORT_SYNTAX, 1);
  refused("v 0 1,5 0\n", SBF_CODE_IMPORT_SYNTAX, 1);
  refused("vt\n", SBF_CODE_IMPORT_SYNTAX, 1);
  refused("vn 0 1\n", SBF_CODE_IMPORT_SYNTAX, 1);
  refused("v 0 0 nan\n", SBF_CODE_IMPORT_NOT_FINITE, 1);
  refused("v 0 -inf 0\n", SBF_CODE_IMPORT_NOT_FINITE, 1);
  refused("v 0 0 1.#QNAN\n", SBF_CODE_IMPORT_NOT_FINITE, 1);
  refused("v 0 0 -1.#IND\n", SBF_CODE_IMPORT_NOT_FINITE, 1);
  refused("v 1e39 0 0\n", SBF_CODE_IMPORT_NOT_FINITE, 1);
  refused("vn 0 0 NaN\n", SBF_CODE_IMPORT_NOT_FINITE, 1);
  refused("v 0 0 0\n\nf 1 1 2\n", SBF_CODE_IMPORT_INDEX, 3);
  refused("v 0 0 0\nf 0 1 1\n", SBF_CODE_IMPORT_INDEX, 2);
  refused("v 0 0 0\nf 1 1 -2\n", SBF_CODE_IMPORT_INDEX, 2);
  refused("v 0 0 0\nf 1/1 1 1\n", SBF_CODE_IMPORT_INDEX, 2);
  refused("v 0 0 0\nf 1//1 1 1\n", SBF_CODE_IMPORT_INDEX, 2);
  refused("v 0 0 0\nf 1 1 99999999999999999999\n", SBF_CODE_IMPORT_INDEX, 2);
  refused("v 0 0 0\nf 1 1 4294967297\n", SBF_CODE_IMPORT_INDEX, 2);
  refused("v 0 0 0\nf 1 1 \\\n\\\n2\nv 0 0 0 bad\nf 1 1 3", SBF_CODE_IMPORT_INDEX, 6);
  refused("v 0 0 0\nf 1 1\n", SBF_CODE_IMPORT_POLYGON, 2);
  refused("f\n", SBF_CODE_IMPORT_POLYGON, 1);
  refused("v 0 0 0\nf 1 1 one\n", SBF_CODE_IMPORT_SYNTAX, 2);
  refused("v 0 0 0\nf 1 1 1.5\n", SBF_CODE_IMPORT_SYNTAX, 2);
  refused("v 0 0 0\nf 1 1 1/1/1/1\n", SBF_CODE_IMPORT_SYNTAX, 2);
  refused("v 0 0 0\nf 1 1 -\n", SBF_CODE_IMPORT_SYNTAX, 2);
  refused("\xFF\xFEv", SBF_CODE_IMPORT_SYNTAX, 0);
}
END_TEST

START_TEST(binary_is_no_obj)
{
  sbfi_obj_text text;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(read_exact(&text, "v 0 0 0\0\n", 9, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_SYNTAX);
  ck_assert_uint_eq(error.line, 1);
}
END_TEST

static void nul_in_line(const char *bytes, size_t size, uint32_t line) {
  sbfi_obj_text text;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(read_exact(&text, bytes, size, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_SYNTAX);
  ck_assert_uint_eq(error.line, line);
}

START_TEST(a_nul_is_refused_with_its_line)
{
  enum { FAR = 100000 }; /* bytes of comments before it */
  nul_in_line("v 0 0 0\nv 1 0 0\n\nv 0\0 0 0\n", 27, 4);
  nul_in_line("v 0 0 0\rv 1 0 0\ro a\0b\r", 22, 3);
  nul_in_line("v 0 0 0\r\n# a\0b\r\n", 16, 2);
  char *text = malloc(FAR + 1);
  ck_assert_ptr_nonnull(text);
  memset(text, '#', FAR);
  for (int i = 99; i < FAR; i += 100) text[i] = '\n';
  text[FAR] = 0;
  nul_in_line(text, FAR + 1, FAR / 100 + 1);
  free(text);
}
END_TEST

START_TEST(messages_contain_text_bytes_only)
{
  sbfi_obj_text text;
  sbf_diagnostic error = {0};
  const char bytes[] = "v 0 0 \x1b[31m\xC3\x28\n";
  ck_assert_int_eq(read_exact(&text, bytes, sizeof bytes - 1, &error), SBF_BAD_INPUT);
  ck_assert_ptr_null(strchr(error.message, '\x1b'));
  ck_assert_uint_eq(sbfi_utf8_check(error.message, strlen(error.message)), strlen(error.message));
}
END_TEST

START_TEST(a_mark_of_utf8_is_passed_over)
{
  sbfi_obj_text text;
  accepted(&text, "\xEF\xBB\xBFv 1 2 3\n");
  ck_assert_uint_eq(text.points.count, 1);
  sbfi_obj_text_free(&text);
}
END_TEST

static const char everything[] =
    "mtllib a.mtl\no one\ng left\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl m\n"
    "f 1/1/1 2/1/1 \\\n 3/1/1 4/1/1\ng right\nv 1 1 0 # late\nusemtl n\nf -1 -2 -3\nl 1 2\n";

/* The reader terminates with a result for any truncated file. */
START_TEST(cut_off_at_every_byte)
{
  for (size_t size = 0; size < sizeof everything; size++) {
    sbfi_obj_text text;
    sbf_diagnostic error = {0};
    if (read_exact(&text, everything, size, &error) == SBF_OK)
      sbfi_obj_text_free(&text);
    else
      ck_assert_int_ne(error.code, 0);
  }
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_obj_text text;
    sbf_diagnostic error = {0};
    sbf_status status =
        sbfi_obj_text_read(&text, everything, sizeof everything - 1, &memory.allocator, &error);
    if (status == SBF_OK) sbfi_obj_text_free(&text);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_int_eq(status, SBF_FAILED);
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    ck_assert_uint_lt(allowed, 1000);
  }
}
END_TEST

/* Read on, a face of millions would take gigabytes before anything is wrong with it. */
START_TEST(a_face_has_a_bounded_number_of_corners)
{
  sbfi_obj_text text;
  size_t max = 65535, length = strlen(four);
  char *bytes = malloc(length + 2 * max + 8);
  memcpy(bytes, four, length);
  bytes[length++] = 'f';
  for (size_t i = 0; i < max; i++) bytes[length++] = ' ', bytes[length++] = (char)('1' + i % 4);
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbfi_obj_text_read(&text, bytes, length, NULL, &error), SBF_OK);
  sbfi_obj_text_free(&text);
  memcpy(bytes + length, " 1\n", 4);
  refused(bytes, SBF_CODE_IMPORT_POLYGON, 10);
  free(bytes);
}
END_TEST

static Suite *obj_text_suite(void) {
  Suite *suite = suite_create("obj_text");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, corners_in_every_form);
  tcase_add_test(tests, negative_indices_count_back_from_the_line);
  tcase_add_test(tests, a_face_may_come_before_its_vertices);
  tcase_add_loop_test(tests, lines_end_with_lf_crlf_or_cr, 0, 3);
  tcase_add_test(tests, comments_are_not_continued_over_their_backslash);
  tcase_add_test(tests, weights_and_colours_are_passed_over);
  tcase_add_test(tests, runs_and_blocks);
  tcase_add_test(tests, other_statements_are_counted);
  tcase_add_test(tests, errors_name_their_line);
  tcase_add_test(tests, a_face_has_a_bounded_number_of_corners);
  tcase_add_test(tests, binary_is_no_obj);
  tcase_add_test(tests, a_nul_is_refused_with_its_line);
  tcase_add_test(tests, messages_contain_text_bytes_only);
  tcase_add_test(tests, a_mark_of_utf8_is_passed_over);
  tcase_add_test(tests, cut_off_at_every_byte);
  tcase_add_test(tests, every_allocation_may_fail);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(obj_text_suite());
}
