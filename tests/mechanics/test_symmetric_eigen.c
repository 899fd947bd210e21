#include "mechanics/symmetric_eigen.h"

#include <math.h>

#include "harness.h"

START_TEST(known_matrix)
{
  double matrix[9] = {2, -1, 0, -1, 2, -1, 0, -1, 2}, vectors[9];
  sbfi_symmetric_compute_eigen(3, matrix, vectors);
  double sum = 0, product = 1;
  for (int i = 0; i < 3; i++) {
    double value = matrix[4 * i], x = vectors[i], y = vectors[3 + i], z = vectors[6 + i];
    sum += value;
    product *= value;
    ck_assert_double_eq_tol(x * x + y * y + z * z, 1, 1e-12);
    ck_assert_double_eq_tol(2 * x - y, value * x, 1e-12);
    ck_assert_double_eq_tol(-x + 2 * y - z, value * y, 1e-12);
  }
  ck_assert_double_eq_tol(sum, 6, 1e-12);
  ck_assert_double_eq_tol(product, 4, 1e-12); /* 2 - sqrt(2), 2, 2 + sqrt(2) */
}
END_TEST

START_TEST(large_matrices_are_decomposed)
{
  enum { N = 30 };
  double matrix[N * N], kept[N * N], vectors[N * N];
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) matrix[i * N + j] = kept[i * N + j] = 1.0 / (1 + i + j) + (i == j);
  sbfi_symmetric_compute_eigen(N, matrix, vectors);
  for (int e = 0; e < N; e++)
    for (int i = 0; i < N; i++) {
      double sum = 0;
      for (int j = 0; j < N; j++) sum += kept[i * N + j] * vectors[j * N + e];
      ck_assert_double_eq_tol(sum, matrix[e * (N + 1)] * vectors[i * N + e], 1e-10);
    }
}
END_TEST

START_TEST(nothing_to_do)
{
  double matrix[4] = {0}, vectors[4], diagonal[4] = {3, 0, 0, -1};
  sbfi_symmetric_compute_eigen(2, matrix, vectors);
  ck_assert(matrix[0] == 0 && vectors[0] == 1 && vectors[1] == 0 && vectors[3] == 1);
  sbfi_symmetric_compute_eigen(2, diagonal, vectors);
  ck_assert(diagonal[0] == 3 && diagonal[3] == -1);
  double odd[4] = {NAN, 1, 1, 2}; /* terminates with any result */
  sbfi_symmetric_compute_eigen(2, odd, vectors);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("symmetric_eigen");
  TCase *c = tcase_create("symmetric_eigen");
  tcase_add_test(c, known_matrix);
  tcase_add_test(c, large_matrices_are_decomposed);
  tcase_add_test(c, nothing_to_do);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
