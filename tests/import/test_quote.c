#include "import/quote.h"

#include <string.h>

#include "harness.h"

static void expect(const char *text, size_t size, const char *expected) {
  char to[64];
  memset(to, 'x', sizeof to);
  sbfi_quote_into(to, size, sbfi_span_of(text));
  ck_assert_str_eq(to, expected);
  ck_assert_int_eq(to[size], 'x');
}

START_TEST(short_text_is_unchanged)
{
  expect("Leg1.L", 16, "Leg1.L");
  expect("", 16, "");
  expect("Schw\xC3\xA4nzchen", 16, "Schw\xC3\xA4nzchen");
}
END_TEST

START_TEST(bytes_that_are_not_text_become_a_mark)
{
  expect("a\x1b[31m\tb\x7f", 16, "a?[31m?b?");
  expect("a\xFFz\xC3(\x80", 16, "a?z?(?");
}
END_TEST

START_TEST(long_text_is_cut_between_characters)
{
  expect("0123456789", 10, "012345...");
  expect("01234567", 9, "01234567");
  expect("01234\xE2\x82\xAC\xE2\x82\xAC", 10, "01234...");
  expect("0123\xE2\x82\xAC\xE2\x82\xAC\xE2\x82\xAC", 12, "0123\xE2\x82\xAC...");
}
END_TEST

static Suite *quote_suite(void) {
  Suite *suite = suite_create("quote");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, short_text_is_unchanged);
  tcase_add_test(tests, bytes_that_are_not_text_become_a_mark);
  tcase_add_test(tests, long_text_is_cut_between_characters);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(quote_suite());
}
