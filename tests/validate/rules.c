#include "rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char found[1 << 16];

static void add_finding(void *user, const sbf_diagnostic *d) {
  (void)user;
  size_t used = strlen(found);
  char index[32] = "";
  const sbf_code_info *info = sbf_code_find(d->code);
  ck_assert_ptr_nonnull(info);
  ck_assert_int_eq(d->severity, info->severity);
  ck_assert_msg(*d->message && !strchr(d->message, '\n'), "%s: %s", info->name, d->message);
  ck_assert_msg(!strstr(d->message, "''"), "something without a name: %s", d->message);
  if (d->index >= 0) snprintf(index, sizeof index, " #%lld", (long long)d->index);
  int length =
      snprintf(found + used, sizeof found - used, "%s%s %s%s", used ? "\n" : "", info->name, d->path, index);
  ck_assert_int_lt(length, (int)(sizeof found - used));
}

sbf_asset *rules_load(const char *inside, bool repairable) {
  char text[1 << 14];
  sbf_asset *asset;
  sbf_diagnostic error = {0};
  sbf_load_options options = {.repairable = repairable};
  int length = snprintf(text, sizeof text, "<sbf version=\"" SBF_FORMAT_VERSION "\">%s</sbf>", inside);
  ck_assert_int_lt(length, (int)sizeof text);
  sbf_status status = sbf_xml_load_memory(text, (size_t)length, &options, &asset, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
  return asset;
}

const char *rules_findings(const sbf_asset *asset, const sbf_validate_options *given) {
  sbf_validate_options options = {.folder = NULL};
  sbf_validate_result result;
  sbf_diagnostic error;
  if (given) options = *given;
  options.report = add_finding;
  *found = 0;
  ck_assert_int_eq(sbf_validate(asset, &options, &result, &error), SBF_OK);
  ck_assert_int_eq(result.errors + result.warnings + result.infos == 0, *found == 0);
  return found;
}

void rules_expect(const char *inside, const char *expected) {
  sbf_asset *asset = rules_load(inside, false);
  ck_assert_str_eq(rules_findings(asset, NULL), expected);
  sbf_asset_free(asset);
}

sbf_asset *rules_expect_fix(const char *inside, const char *repaired, const char *left) {
  sbf_asset *asset = rules_load(inside, true), *fixed = NULL, *again = NULL;
  sbf_fix_options options = {.report = add_finding};
  sbf_fix_result result;
  sbf_diagnostic error = {0};
  *found = 0;
  sbf_status status = sbf_fix(asset, &options, &fixed, &result, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
  ck_assert_str_eq(found, repaired);
  ck_assert_int_eq(result.repaired > 0, *repaired != 0);
  ck_assert_uint_eq(sbf_asset_check(fixed, NULL, NULL, 0), 0);
  ck_assert_str_eq(rules_findings(fixed, NULL), left);
  ck_assert_int_eq(sbf_fix(fixed, NULL, &again, &result, NULL), SBF_OK); /* once is enough */
  ck_assert_uint_eq(result.repaired, 0);
  ck_assert(sbf_asset_equal(fixed, again, NULL, 0));
  sbf_asset_free(again);
  sbf_asset_free(asset);
  return fixed;
}

Suite *rules_suite(const char *name, const TTest *const *tests, size_t count) {
  Suite *suite = suite_create(name);
  TCase *all = tcase_create("all");
  for (size_t i = 0; i < count; i++) tcase_add_test(all, tests[i]);
  suite_add_tcase(suite, all);
  return suite;
}
