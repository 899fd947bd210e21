#include "model/bulk_check.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "harness.h"

enum { LONGEST = 1600 }; /* several blocks and a rest */

START_TEST(test_floats)
{
  static float at[LONGEST];
  static const float faults[] = {NAN, -NAN, INFINITY, -INFINITY, 1.0000001f, -0.5000001f};
  for (size_t count = 0; count <= LONGEST; count += 97) {
    for (size_t i = 0; i < count; i++) at[i] = i % 3 ? 1.0f : -0.5f; /* the bounds themselves are inside */
    ck_assert_uint_eq(sbfi_find_f32_outside(at, count, -0.5f, 1), count);
    for (size_t i = 0; i < count; i += 13) {
      float kept = at[i];
      at[i] = faults[i % (sizeof faults / sizeof *faults)];
      ck_assert_uint_eq(sbfi_find_f32_outside(at, count, -0.5f, 1), i);
      at[i] = kept;
    }
  }
  at[0] = FLT_MAX;
  ck_assert_uint_eq(sbfi_find_f32_outside(at, 1, -FLT_MAX, FLT_MAX), 1);
  at[0] = -0.0f;
  ck_assert_uint_eq(sbfi_find_f32_outside(at, 1, 0, 1), 1);
  at[0] = 0;
  ck_assert_uint_eq(sbfi_find_f32_outside(at, 1, FLT_TRUE_MIN, 1), 0);
}
END_TEST

START_TEST(test_integers)
{
  static uint32_t at[LONGEST];
  for (size_t count = 0; count <= LONGEST; count += 97) {
    for (size_t i = 0; i < count; i++) at[i] = i % 2 ? 3 : 9;
    ck_assert_uint_eq(sbfi_find_u32_outside(at, count, 3, 9), count);
    for (size_t i = 0; i < count; i += 11) {
      uint32_t kept = at[i];
      at[i] = i % 3 == 0 ? 2 : i % 3 == 1 ? 10 : UINT32_MAX;
      ck_assert_uint_eq(sbfi_find_u32_outside(at, count, 3, 9), i);
      at[i] = kept;
    }
  }
  at[0] = UINT32_MAX;
  ck_assert_uint_eq(sbfi_find_u32_outside(at, 1, 0, UINT32_MAX), 1);
  ck_assert_uint_eq(sbfi_find_u32_outside(at, 1, 5, 4), 0); /* nothing is inside */
  ck_assert_uint_eq(sbfi_find_u32_outside(at, 0, 0, 0), 0);
}
END_TEST

START_TEST(test_tetrahedra)
{
  static const sbf_vec3 p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1e-20f, 0, 0}, {0, 1e-20f, 0},
      {0, 0, 1e-20f}, {FLT_MAX, 0, 0}};
  static const sbf_uint4 good[] = {{{0, 1, 2, 3}}, {{1, 2, 0, 3}}, {{0, 4, 5, 6}}, {{0, 7, 2, 3}}};
  ck_assert_uint_eq(sbfi_find_not_positive(good, 4, p), 4);
  static const sbf_uint4 bad[] = {{{0, 1, 2, 3}}, {{1, 0, 2, 3}}, {{0, 1, 2, 4}}, {{0, 0, 2, 3}}};
  ck_assert_uint_eq(sbfi_find_not_positive(bad, 4, p), 1);
  ck_assert_uint_eq(sbfi_find_not_positive(bad + 2, 2, p), 0);
  ck_assert_uint_eq(sbfi_find_not_positive(bad + 3, 1, p), 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("bulk_check");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_floats);
  tcase_add_test(all, test_integers);
  tcase_add_test(all, test_tetrahedra);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
