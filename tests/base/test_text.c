#include "harness.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

static sbfi_span span(const char *text) {
  return sbfi_span_of(text);
}

START_TEST(spans_are_compared_and_trimmed)
{
  ck_assert(sbfi_span_is(span("bone"), "bone"));
  ck_assert(!sbfi_span_is(span("bone"), "bones"));
  ck_assert(!sbfi_span_is(span("bones"), "bone"));
  ck_assert(sbfi_span_is(sbfi_span_of(NULL), ""));
  ck_assert(sbfi_span_begins(span("bones"), "bone"));
  ck_assert(!sbfi_span_begins(span("bon"), "bone"));
  ck_assert(sbfi_span_is(sbfi_span_trim(span(" \t\r\nleg arm\n ")), "leg arm"));
  ck_assert_uint_eq(sbfi_span_trim(span(" \n ")).length, 0);
}
END_TEST

START_TEST(words_are_split_one_by_one)
{
  sbfi_span rest = span("\t v 1.5  -2\r\n"), word;
  const char *expected[] = {"v", "1.5", "-2"};
  for (int i = 0; i < 3; i++) {
    ck_assert(sbfi_span_next_word(&rest, &word));
    ck_assert(sbfi_span_is(word, expected[i]));
  }
  ck_assert(!sbfi_span_next_word(&rest, &word));
  ck_assert_uint_eq(word.length, 0);
  rest = sbfi_span_of(NULL);
  ck_assert(!sbfi_span_next_word(&rest, &word));
}
END_TEST

START_TEST(lines_end_in_any_convention)
{
  sbfi_span rest = span("a\nb\r\n\rc"), line;
  const char *expected[] = {"a", "b", "", "c"};
  for (int i = 0; i < 4; i++) {
    ck_assert(sbfi_span_next_line(&rest, &line));
    ck_assert(sbfi_span_is(line, expected[i]));
  }
  ck_assert(!sbfi_span_next_line(&rest, &line));
  rest = span("\r");
  ck_assert(sbfi_span_next_line(&rest, &line));
  ck_assert_uint_eq(line.length, 0);
  ck_assert(!sbfi_span_next_line(&rest, &line));
}
END_TEST

START_TEST(utf8_is_checked_to_the_byte)
{
  const struct {
    const char *text;
    size_t good; /* SIZE_MAX: all of it */
  } cases[] = {{"", SIZE_MAX}, {"plain text longer than eight", SIZE_MAX}, {"Kr\xC3\xB6te", SIZE_MAX},
      {"\xEF\xBF\xBF \xE2\x82\xAC", SIZE_MAX}, {"\xF0\x9F\xA6\x8E", SIZE_MAX}, {"\xF4\x8F\xBF\xBF", SIZE_MAX},
      {"\xED\x9F\xBF\xEE\x80\x80", SIZE_MAX}, {"12345678\x80", 8}, {"1234567\xFF", 7}, {"\xC0\xAF", 0},
      {"\xC1\xBF", 0}, {"\xE0\x9F\xBF", 0}, {"\xED\xA0\x80", 0}, {"\xF0\x8F\xBF\xBF", 0},
      {"\xF4\x90\x80\x80", 0}, {"\xF5\x80\x80\x80", 0}, {"a\xC3", 1}, {"a\xE2\x82", 1}, {"a\xF0\x9F\xA6", 1},
      {"\xE2\x82x", 0}, {"\xC3\xC3\xB6", 0}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    size_t length = strlen(cases[i].text), good = cases[i].good == SIZE_MAX ? length : cases[i].good;
    ck_assert_msg(sbfi_utf8_check(cases[i].text, length) == good, "case %zu", i);
  }
}
END_TEST

START_TEST(every_code_point_is_well_formed_and_cut_whole)
{
  for (uint32_t code = 0x80; code <= 0x10FFFF; code++) {
    char text[4];
    size_t length = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    const uint8_t lead[] = {0, 0, 0xC0, 0xE0, 0xF0};
    for (size_t i = 0; i < length; i++) text[i] = (char)(0x80 | (code >> 6 * (length - 1 - i) & 0x3F));
    text[0] = (char)(lead[length] | code >> 6 * (length - 1));
    bool surrogate = code >= 0xD800 && code < 0xE000;
    bool good = sbfi_utf8_check(text, length) == (surrogate ? 0 : length);
    if (!surrogate) good &= sbfi_utf8_cut(text, length, length) == length;
    for (size_t limit = 0; limit < length && !surrogate; limit++)
      good &= sbfi_utf8_cut(text, length, limit) == 0;
    if (!good) ck_abort_msg("U+%04X", (unsigned)code);
  }
}
END_TEST

START_TEST(paths_that_leave_their_folder_are_detected_from_their_text)
{
  static const char *const leave[] = {"/a", "..", "../a", "a/../../b", "/../LWO", "C:/a.png", "a\\b", "./.."};
  static const char *const stay[] = {"", "a", "a/b.png", "a/../b", "./a", "a//b", "a..b", "..a"};
  for (size_t i = 0; i < sizeof leave / sizeof *leave; i++) ck_assert(sbfi_path_leaves_folder(leave[i]));
  for (size_t i = 0; i < sizeof stay / sizeof *stay; i++) ck_assert(!sbfi_path_leaves_folder(stay[i]));
}
END_TEST

START_TEST(the_buffer_appends_every_type)
{
  sbfi_text text;
  sbfi_text_init(&text, NULL);
  ck_assert(sbfi_text_string(&text, "f "));
  ck_assert(sbfi_text_f32(&text, -0.25f));
  ck_assert(sbfi_text_char(&text, ' '));
  ck_assert(sbfi_text_i32(&text, -7));
  ck_assert(sbfi_text_repeat(&text, '\t', 2));
  ck_assert(sbfi_text_u32(&text, 4294967295u));
  ck_assert(sbfi_text_append(&text, "", 0));
  ck_assert(sbfi_text_u64(&text, 10000000000u));
  const char *expected = "f -0.25 -7\t\t429496729510000000000";
  ck_assert_uint_eq(text.length, strlen(expected));
  ck_assert_mem_eq(text.at, expected, text.length);
  ck_assert(!sbfi_text_f32(&text, NAN));
  ck_assert(!text.failed);
  ck_assert_uint_eq(text.length, strlen(expected));
  sbfi_text_clear(&text);
  ck_assert_uint_eq(text.length, 0);
  sbfi_text_free(&text);
}
END_TEST

START_TEST(a_failed_buffer_stays_failed)
{
  harness_memory memory;
  for (size_t allowed = 0;; allowed++) {
    sbfi_text text;
    harness_memory_init(&memory, allowed);
    sbfi_text_init(&text, &memory.allocator);
    size_t good = 0;
    for (int i = 0; i < 1000; i++) good += sbfi_text_u32(&text, 123456789);
    ck_assert_uint_eq(text.length, 9 * good);
    ck_assert(text.failed == (good < 1000));
    for (size_t i = 0; i < good; i++) ck_assert_mem_eq(text.at + 9 * i, "123456789", 9);
    if (text.failed) {
      memory.allowed = SIZE_MAX; /* failed is failed, even if memory comes back */
      ck_assert(!sbfi_text_string(&text, "x"));
    }
    bool failed = text.failed;
    sbfi_text_free(&text);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (!failed) {
      ck_assert_uint_ge(allowed, 3);
      break;
    }
  }
}
END_TEST

START_TEST(an_absurd_size_fails_cleanly)
{
  sbfi_text text;
  sbfi_text_init(&text, NULL);
  sbfi_text_string(&text, "abc");
  ck_assert_ptr_null(sbfi_text_reserve(&text, SIZE_MAX - 1));
  ck_assert(text.failed);
  ck_assert_uint_eq(text.length, 3);
  sbfi_text_free(&text);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("text");
  TCase *c = tcase_create("spans");
  tcase_add_test(c, spans_are_compared_and_trimmed);
  tcase_add_test(c, words_are_split_one_by_one);
  tcase_add_test(c, lines_end_in_any_convention);
  suite_add_tcase(s, c);
  c = tcase_create("utf8");
  tcase_add_test(c, utf8_is_checked_to_the_byte);
  tcase_add_test(c, every_code_point_is_well_formed_and_cut_whole);
  suite_add_tcase(s, c);
  c = tcase_create("paths");
  tcase_add_test(c, paths_that_leave_their_folder_are_detected_from_their_text);
  suite_add_tcase(s, c);
  c = tcase_create("buffer");
  tcase_add_test(c, the_buffer_appends_every_type);
  tcase_add_test(c, a_failed_buffer_stays_failed);
  tcase_add_test(c, an_absurd_size_fails_cleanly);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
