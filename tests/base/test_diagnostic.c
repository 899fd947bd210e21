#include "harness.h"

#include <string.h>

#include "base/diagnostic.h"
#include "base/text.h"

START_TEST(a_code_sets_status_and_severity)
{
  sbf_diagnostic d;
  ck_assert_int_eq(sbfi_diagnose(&d, SBF_CODE_XML_BAD_VALUE, "\"%s\" is no number", "x"), SBF_BAD_INPUT);
  ck_assert_int_eq(d.code, SBF_CODE_XML_BAD_VALUE);
  ck_assert_int_eq(d.severity, SBF_SEVERITY_ERROR);
  ck_assert_str_eq(d.message, "\"x\" is no number");
  ck_assert_str_eq(d.path, "");
  ck_assert_str_eq(d.file, "");
  ck_assert_uint_eq(d.line, 0);
  ck_assert_int_eq(d.offset, -1);
  ck_assert_int_eq(d.index, -1);
  ck_assert_int_eq(sbfi_diagnose(&d, SBF_CODE_OUT_OF_MEMORY, "no memory"), SBF_FAILED);
  ck_assert_int_eq(sbfi_diagnose(NULL, SBF_CODE_OUT_OF_MEMORY, "no memory"), SBF_FAILED);
}
END_TEST

START_TEST(every_code_has_the_values_of_its_table)
{
  uint32_t count;
  const sbf_code_info *table = sbf_code_table(&count);
  ck_assert_uint_gt(count, 10);
  for (uint32_t i = 0; i < count; i++) {
    sbf_diagnostic d;
    sbf_status expected = table[i].severity == SBF_SEVERITY_ERROR ? table[i].fault : SBF_OK;
    ck_assert_msg(sbfi_diagnose(&d, table[i].code, "m") == expected, "%s", table[i].name);
    ck_assert_msg(d.severity == table[i].severity, "%s", table[i].name);
  }
}
END_TEST

START_TEST(texts_are_cut_between_characters)
{
  char long_text[600] = "", field[8];
  for (int i = 0; i < 298; i++) strcat(long_text, "\xC3\xB6");
  for (int shift = 0; shift < 2; shift++) {
    sbf_diagnostic d;
    sbfi_diagnose(&d, SBF_CODE_NOT_UTF8, "%s%s", shift ? "x" : "", long_text);
    size_t length = strlen(d.message);
    ck_assert_uint_ge(length, sizeof d.message - 2);
    ck_assert_uint_eq(sbfi_utf8_check(d.message, length), length);
  }
  sbfi_copy_text(field, sizeof field, "abcdef\xE2\x82\xAC");
  ck_assert_str_eq(field, "abcdef");
  sbfi_copy_text(field, sizeof field, "abcdefg");
  ck_assert_str_eq(field, "abcdefg");
  sbfi_copy_text(field, sizeof field, "");
  ck_assert_str_eq(field, "");
}
END_TEST

static void remember(void *user, const sbf_diagnostic *diagnostic) {
  *(int32_t *)user = diagnostic->code;
}

START_TEST(a_reporter_counts_and_calls)
{
  int32_t last = 0;
  sbfi_reporter reporter = {.report = remember, .user = &last};
  sbf_diagnostic d = {.code = 7, .severity = SBF_SEVERITY_WARNING};
  sbfi_report(&reporter, &d);
  ck_assert_int_eq(last, 7);
  d.severity = SBF_SEVERITY_ERROR;
  sbfi_report(&reporter, &d);
  d.severity = SBF_SEVERITY_INFO;
  sbfi_report(&reporter, &d);
  ck_assert_uint_eq(reporter.warnings, 1);
  ck_assert_uint_eq(reporter.errors, 1);
  sbfi_report(NULL, &d);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("diagnostic");
  TCase *c = tcase_create("diagnostic");
  tcase_add_test(c, a_code_sets_status_and_severity);
  tcase_add_test(c, every_code_has_the_values_of_its_table);
  tcase_add_test(c, texts_are_cut_between_characters);
  tcase_add_test(c, a_reporter_counts_and_calls);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
