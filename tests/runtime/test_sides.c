/* Edges of triangles: rims, ridges, and their positions. */
#include "shapes/sides.h"

#include "harness.h"

static const uint32_t two[6] = {0, 1, 2, 2, 1, 3};

START_TEST(two_triangles_have_one_common_side)
{
  uint32_t beside[6], table[64];
  ck_assert_uint_le(sbri_sides_table(2), 64);
  sbri_sides_find(two, 2, beside, table);
  ck_assert_uint_eq(beside[0], SBRI_RIM);
  ck_assert_uint_eq(beside[1], 3); /* the other's third corner */
  ck_assert_uint_eq(beside[2], SBRI_RIM);
  ck_assert_uint_eq(beside[3], SBRI_SAME_SIDE);
  ck_assert_uint_eq(beside[4], SBRI_RIM);
  ck_assert_uint_eq(beside[5], SBRI_RIM);
}
END_TEST

/* Bent by 15 degrees it is flat, by 20 and up to closing it is bent. */
START_TEST(folds_are_bent_and_flat_ones_are_not)
{
  const sbf_vec3 a = {0, 0, 0}, b = {1, 0, 0}, own = {0.3f, 0, 1};
  const sbf_vec3 flat = {0.6f, 0.2588f, -0.9659f}, bent = {0.6f, 0.342f, -0.9397f}, right = {0.6f, 1, 0},
                 closed = {0.6f, 0.1f, 0.99f};
  ck_assert(!sbri_side_is_bent(a, b, own, flat));
  ck_assert(sbri_side_is_bent(a, b, own, bent));
  ck_assert(sbri_side_is_bent(a, b, own, right));
  ck_assert(sbri_side_is_bent(a, b, own, closed));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("sides");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, two_triangles_have_one_common_side);
  tcase_add_test(tests, folds_are_bent_and_flat_ones_are_not);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
