#include "import/scene/name_table.h"

#include <stdio.h>

#include "harness.h"

START_TEST(names_are_numbered_in_order)
{
  static char texts[1000][8];
  sbfi_name_table table;
  sbfi_name_table_init(&table, NULL);
  ck_assert_int_eq(sbfi_name_table_find(&table, sbfi_span_of("n0")), -1);
  for (int i = 0; i < 1000; i++) {
    snprintf(texts[i], sizeof texts[i], "n%d", i);
    ck_assert_int_eq(sbfi_name_table_add(&table, sbfi_span_of(texts[i])), i);
  }
  for (int i = 0; i < 1000; i++) {
    ck_assert_int_eq(sbfi_name_table_add(&table, sbfi_span_of(texts[i])), i);
    ck_assert_int_eq(sbfi_name_table_find(&table, sbfi_span_of(texts[i])), i);
  }
  ck_assert_int_eq(sbfi_name_table_find(&table, sbfi_span_of("n1000")), -1);
  ck_assert_int_eq(sbfi_name_table_add(&table, sbfi_span_of("")), 1000);
  ck_assert_uint_eq(table.names.count, 1001);
  sbfi_name_table_free(&table);
}
END_TEST

START_TEST(memory_may_run_out)
{
  for (size_t allowed = 0; allowed < 4; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_name_table table;
    sbfi_name_table_init(&table, &memory.allocator);
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz";
    int64_t number = 0;
    for (int i = 0; i < 26 && number >= 0; i++)
      number = sbfi_name_table_add(&table, (sbfi_span){letters + i, 1});
    ck_assert_int_eq(number, -1);
    ck_assert_int_eq(sbfi_name_table_find(&table, sbfi_span_of("a")), allowed >= 2 ? 0 : -1);
    sbfi_name_table_free(&table);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

static Suite *name_table_suite(void) {
  Suite *suite = suite_create("name_table");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, names_are_numbered_in_order);
  tcase_add_test(tests, memory_may_run_out);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(name_table_suite());
}
