#include "import/scene/trs.h"

#include <math.h>

#include "harness.h"

#define PI 3.14159265358979323846

static void expect_same(const sbfi_matrix *a, const sbfi_matrix *b, double tolerance) {
  for (int i = 0; i < 16; i++) ck_assert_double_eq_tol(a->at[i / 4][i % 4], b->at[i / 4][i % 4], tolerance);
}

START_TEST(a_quarter_turn_about_z)
{
  double half = sqrt(0.5);
  sbfi_trs trs = {{1, 2, 3}, {0, 0, half, half}, {2, 3, 4}};
  sbfi_matrix m = sbfi_trs_compose(&trs);
  static const sbfi_matrix expected = {{{0, -3, 0, 1}, {2, 0, 0, 2}, {0, 0, 4, 3}, {0, 0, 0, 1}}};
  expect_same(&m, &expected, 1e-15);
}
END_TEST

/* Rotations all over, so that each of the four ways to a quaternion is taken; mirrored and not. */
START_TEST(parts_multiply_to_the_whole)
{
  uint32_t seed = 1;
  for (int n = 0; n < 2000; n++) {
    double v[10];
    for (int i = 0; i < 10; i++) {
      seed = seed * 1664525 + 1013904223;
      v[i] = (double)(seed >> 8) / (1 << 23) - 1;
    }
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
    if (length < 0.1) continue;
    sbfi_trs trs = {{v[4], v[5], v[6]}, {v[0] / length, v[1] / length, v[2] / length, v[3] / length},
        {v[7] < 0 ? v[7] - 0.1 : v[7] + 0.1, fabs(v[8]) + 0.1, fabs(v[9]) + 0.1}};
    sbfi_matrix m = sbfi_trs_compose(&trs);
    sbfi_trs parts = sbfi_trs_decompose(&m);
    sbfi_matrix again = sbfi_trs_compose(&parts);
    expect_same(&m, &again, 1e-12);
    double q = 0;
    for (int i = 0; i < 4; i++) q += parts.rotation[i] * parts.rotation[i];
    ck_assert_double_eq_tol(q, 1, 1e-12);
  }
}
END_TEST

START_TEST(a_flat_transform_has_no_rotation)
{
  sbfi_matrix m = sbfi_matrix_identity();
  m.at[1][1] = 0;
  sbfi_trs parts = sbfi_trs_decompose(&m);
  ck_assert(parts.rotation[3] == 1 && parts.scale[1] == 0 && parts.scale[0] == 1);
}
END_TEST

START_TEST(inverses)
{
  sbfi_trs trs = {{1, 2, 3}, {0.5, 0.5, 0.5, 0.5}, {2, -3, 0.25}};
  sbfi_matrix m = sbfi_trs_compose(&trs), inverse, flat = sbfi_matrix_identity();
  ck_assert(sbfi_matrix_invert(&m, &inverse));
  sbfi_matrix product = sbfi_matrix_multiply(&m, &inverse), identity = sbfi_matrix_identity();
  expect_same(&product, &identity, 1e-12);
  ck_assert(sbfi_matrix_invert(&m, &m));
  expect_same(&m, &inverse, 1e-15);
  flat.at[2][2] = 0;
  ck_assert(!sbfi_matrix_invert(&flat, &inverse));
}
END_TEST

static Suite *trs_suite(void) {
  Suite *suite = suite_create("trs");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_quarter_turn_about_z);
  tcase_add_test(tests, parts_multiply_to_the_whole);
  tcase_add_test(tests, a_flat_transform_has_no_rotation);
  tcase_add_test(tests, inverses);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(trs_suite());
}
