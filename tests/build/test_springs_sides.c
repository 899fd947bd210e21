#include "build/springs/springs_sides.h"

#include "harness.h"

/* Two tetrahedra that share a face have nine sides. */
START_TEST(each_side_is_listed_once)
{
  static const sbf_uint4 two[] = {{{0, 1, 2, 3}}, {{4, 3, 2, 1}}};
  static const uint32_t wanted[9][2] = {
      {0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}, {3, 4}, {2, 4}, {1, 4}};
  sbfi_arena arena;
  sbfi_spring_list springs;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_springs_sides(&springs, two, 2, &arena));
  ck_assert_uint_eq(springs.count, 9);
  for (int s = 0; s < 9; s++)
    for (int end = 0; end < 2; end++) ck_assert_uint_eq(springs.at[s].at[end], wanted[s][end]);
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(an_empty_mesh_has_no_sides)
{
  sbfi_arena arena;
  sbfi_spring_list springs;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_springs_sides(&springs, NULL, 0, &arena));
  ck_assert_uint_eq(springs.count, 0);
  sbfi_arena_free(&arena);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("springs_sides");
  TCase *c = tcase_create("springs_sides");
  tcase_add_test(c, each_side_is_listed_once);
  tcase_add_test(c, an_empty_mesh_has_no_sides);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
