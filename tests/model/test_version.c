#include "model/version.h"

#include "harness.h"
#include "sbfmt/model.h"

START_TEST(test_verdicts)
{
  ck_assert_int_eq(sbfi_version_check(SBF_FORMAT_VERSION), SBFI_VERSION_KNOWN);
  ck_assert_int_eq(sbfi_version_check("1.0"), SBFI_VERSION_KNOWN);
  ck_assert_int_eq(sbfi_version_check("0.9"), SBFI_VERSION_KNOWN);
  ck_assert_int_eq(sbfi_version_check("1.4294967295"), SBFI_VERSION_NEWER_MINOR);
  ck_assert_int_eq(sbfi_version_check("2.0"), SBFI_VERSION_TOO_NEW);
  ck_assert_int_eq(sbfi_version_check("10.0"), SBFI_VERSION_TOO_NEW);
}
END_TEST

START_TEST(test_malformed)
{
  static const char *const texts[] = {
      "", "1", "1.", ".0", "1.0.0", "1,0", " 1.0", "1.0 ", "+1.0", "1.-0", "one", "1.0b", "4294967296.0"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    ck_assert_msg(sbfi_version_check(texts[i]) == SBFI_VERSION_MALFORMED, "`%s`", texts[i]);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("version");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_verdicts);
  tcase_add_test(all, test_malformed);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
