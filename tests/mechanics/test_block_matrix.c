#include "mechanics/block_matrix.h"

#include "harness.h"

/* Two points joined with each other, a third alone. */
static sbfi_arena arena;
static sbfi_block_matrix matrix;

static void setup(void) {
  sbf_allocator allocator = sbfi_allocator_or_default(NULL);
  sbfi_arena_init(&arena, &allocator, 0);
  uint64_t pairs[] = {(uint64_t)1 << 32, 1, 1, (uint64_t)1 << 32};
  ck_assert(sbfi_block_matrix_make(&matrix, 3, pairs, 4, &arena));
  for (uint32_t row = 0; row < 3; row++)
    for (int k = 0; k < 3; k++) matrix.blocks[9 * matrix.diagonals[row] + 4 * k] = 4;
  matrix.blocks[9 * sbfi_block_matrix_find(&matrix, 0, 1)] = -1;
  matrix.blocks[9 * sbfi_block_matrix_find(&matrix, 1, 0)] = -1;
  sbfi_block_matrix_prepare(&matrix);
}
static void teardown(void) {
  sbfi_arena_free(&arena);
}

START_TEST(pattern)
{
  const uint32_t begins[] = {0, 2, 4, 5}, columns[] = {0, 1, 0, 1, 2}, diagonals[] = {0, 3, 4};
  ck_assert_mem_eq(matrix.begins, begins, sizeof begins);
  ck_assert_mem_eq(matrix.columns, columns, sizeof columns);
  ck_assert_mem_eq(matrix.diagonals, diagonals, sizeof diagonals);
}
END_TEST

START_TEST(product)
{
  const double x[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  double y[9];
  sbfi_block_matrix_multiply(&matrix, x, y);
  const double expected[9] = {0, 8, 12, 15, 20, 24, 28, 32, 36};
  for (int i = 0; i < 9; i++) ck_assert_double_eq(y[i], expected[i]);
}
END_TEST

START_TEST(sweep_inverts_its_own_matrix)
{
  /* M = (D + L) D^-1 (D + U) has 4, -1, -1, 4 + 1/4 for the first coordinates: applied to (1, 1), (3, 3.25).
   */
  const double r[9] = {3, 8, 0, 3.25, 4, 0, 0, 0, 2};
  double z[9];
  sbfi_block_matrix_sweep(&matrix, r, z);
  const double expected[9] = {1, 2, 0, 1, 1, 0, 0, 0, 0.5};
  for (int i = 0; i < 9; i++) ck_assert_double_eq_tol(z[i], expected[i], 1e-15);
}
END_TEST

START_TEST(rows_without_stiffness_are_unchanged)
{
  for (int k = 0; k < 9; k++) matrix.blocks[9 * matrix.diagonals[2] + k] = 0;
  sbfi_block_matrix_prepare(&matrix);
  const double r[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  double z[9];
  sbfi_block_matrix_sweep(&matrix, r, z);
  for (int i = 6; i < 9; i++) ck_assert_double_eq(z[i], 0);
  ck_assert_double_gt(z[0], 0);
}
END_TEST

int main(void) {
  Suite *s = suite_create("block_matrix");
  TCase *c = tcase_create("block_matrix");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, pattern);
  tcase_add_test(c, product);
  tcase_add_test(c, sweep_inverts_its_own_matrix);
  tcase_add_test(c, rows_without_stiffness_are_unchanged);
  suite_add_tcase(s, c);
  return harness_run(s);
}
