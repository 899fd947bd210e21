/* Files come into a folder together or not at all. */
#define _POSIX_C_SOURCE 200809L
#include "chart/out_folder.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness.h"

static void put(const chart_folder *folder, const char *name, const char *text) {
  char path[4400];
  ck_assert(chart_folder_file(folder, name, path, sizeof path));
  FILE *file = fopen(path, "w");
  ck_assert_ptr_nonnull(file);
  fputs(text, file);
  fclose(file);
}

static bool is_there(const char *folder, const char *name) {
  char path[4400];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return access(path, F_OK) == 0;
}

START_TEST(a_folder_is_made_with_all_files_or_not_at_all)
{
  char path[512];
  chart_folder folder;
  sbf_diagnostic error;
  snprintf(path, sizeof path, "%s", harness_scratch("chart_folder"));
  ck_assert_int_eq(chart_folder_check(path, &error), SBF_OK);
  ck_assert_int_eq(chart_folder_begin(&folder, path, &error), SBF_OK);
  put(&folder, "a.csv", "1");
  chart_folder_abandon(&folder);
  ck_assert(!is_there(path, "") && access(folder.temporary, F_OK) != 0);
  ck_assert_int_eq(chart_folder_begin(&folder, path, &error), SBF_OK);
  put(&folder, "a.csv", "1"), put(&folder, "b.svg", "2");
  ck_assert(!is_there(path, "a.csv"));
  ck_assert_int_eq(chart_folder_commit(&folder, &error), SBF_OK);
  ck_assert(is_there(path, "a.csv") && is_there(path, "b.svg") && access(folder.temporary, F_OK) != 0);
  /* and again, over the existing files and beside others */
  ck_assert_int_eq(chart_folder_begin(&folder, path, &error), SBF_OK);
  put(&folder, "b.svg", "3"), put(&folder, "c.csv", "4");
  ck_assert_int_eq(chart_folder_commit(&folder, &error), SBF_OK);
  ck_assert(is_there(path, "a.csv") && is_there(path, "c.csv") && access(folder.temporary, F_OK) != 0);
  static const char *const names[] = {"a.csv", "b.svg", "c.csv"};
  for (int i = 0; i < 3; i++) {
    char file[4400];
    snprintf(file, sizeof file, "%s/%s", path, names[i]);
    ck_assert_int_eq(unlink(file), 0);
  }
  ck_assert_int_eq(rmdir(path), 0);
}
END_TEST

START_TEST(invalid_output_folders_are_reported_first)
{
  char path[512];
  sbf_diagnostic error;
  snprintf(path, sizeof path, "%s", harness_scratch("chart_no_folder"));
  ck_assert(harness_write(path, "x", 1));
  ck_assert_int_eq(chart_folder_check(path, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "name a folder"));
  unlink(path);
  snprintf(path, sizeof path, "%s/b/c", harness_scratch("chart_nowhere"));
  ck_assert_int_eq(chart_folder_check(path, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "no folder"));
  ck_assert_int_eq(chart_folder_check("", &error), SBF_FAILED);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("out_folder");
  TCase *c = tcase_create("out_folder");
  tcase_add_test(c, a_folder_is_made_with_all_files_or_not_at_all);
  tcase_add_test(c, invalid_output_folders_are_reported_first);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
