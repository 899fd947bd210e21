#include "import/scene/row_table.h"

#include "harness.h"

START_TEST(rows_are_numbered_in_order)
{
  sbfi_row_table table;
  sbfi_row_table_init(&table, NULL);
  for (int round = 0; round < 2; round++) {
    for (uint32_t i = 0; i < 5000; i++)
      ck_assert_int_eq(sbfi_row_table_add(&table, (sbfi_row){{i % 7, i, 0, i / 3}}), i);
    ck_assert_int_eq(sbfi_row_table_add(&table, (sbfi_row){{0, 0, 0, 0}}), 0);
    ck_assert_int_eq(sbfi_row_table_add(&table, (sbfi_row){{0, 0, 0, 1}}), 5000);
    sbfi_row_table_clear(&table);
    ck_assert_uint_eq(table.rows.count, 0);
  }
  sbfi_row_table_free(&table);
}
END_TEST

START_TEST(zeros_of_either_sign_are_equal)
{
  ck_assert_uint_eq(sbfi_float_word(-0.0f), sbfi_float_word(0.0f));
  ck_assert_uint_ne(sbfi_float_word(1.0f), sbfi_float_word(1.0000001f));
  ck_assert_uint_eq(sbfi_float_word(1.0f), 0x3f800000);
}
END_TEST

START_TEST(memory_may_run_out)
{
  for (size_t allowed = 0; allowed < 4; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_row_table table;
    sbfi_row_table_init(&table, &memory.allocator);
    int64_t number = 0;
    for (uint32_t i = 0; i < 200 && number >= 0; i++)
      number = sbfi_row_table_add(&table, (sbfi_row){{i, 0, 0, 0}});
    ck_assert_int_eq(number, -1);
    sbfi_row_table_free(&table);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

static Suite *row_table_suite(void) {
  Suite *suite = suite_create("row_table");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, rows_are_numbered_in_order);
  tcase_add_test(tests, zeros_of_either_sign_are_equal);
  tcase_add_test(tests, memory_may_run_out);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(row_table_suite());
}
