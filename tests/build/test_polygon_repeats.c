#include "build/geometry/polygon_repeats.h"

#include "harness.h"

START_TEST(test_any_order)
{
  static const uint32_t sizes[] = {3, 4, 3, 4, 3, 4, 3, 5};
  static const uint32_t points[] = {
      0, 1, 2, 4, 3, 2, 1, 1, 2, 0, 1, 2, 3, 4, 2, 1, 0, 1, 2, 3, 5, 0, 1, 3, 4, 3, 2, 1, 1};
  static const uint32_t expected[] = {
      0, 1, 0, 1, 0, 5, 6, 7}; /* the last has a corner more, one of its own */
  uint32_t firsts[8];
  sbfi_arena arena;
  sbfi_arena_init(&arena, NULL, 0);
  sbf_polygon_mesh mesh = {.polygon_sizes = {sizes, 8}, .polygon_points = {points, 29}};
  ck_assert(sbfi_polygon_repeats_find(&mesh, firsts, &arena));
  for (int i = 0; i < 8; i++) ck_assert_uint_eq(firsts[i], expected[i]);
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(test_large_polygons)
{
  enum { CORNERS = 100000 };
  static uint32_t points[2 * CORNERS], firsts[2];
  static const uint32_t sizes[] = {CORNERS, CORNERS};
  sbfi_arena arena;
  sbfi_arena_init(&arena, NULL, 0);
  for (uint32_t i = 0; i < CORNERS; i++) {
    points[i] = i;
    points[2 * CORNERS - 1 - i] = i;
  }
  sbf_polygon_mesh mesh = {.polygon_sizes = {sizes, 2}, .polygon_points = {points, 2 * CORNERS}};
  ck_assert(sbfi_polygon_repeats_find(&mesh, firsts, &arena));
  ck_assert_uint_eq(firsts[1], 0);
  points[CORNERS] = 7;
  ck_assert(sbfi_polygon_repeats_find(&mesh, firsts, &arena));
  ck_assert_uint_eq(firsts[1], 1);
  sbfi_arena_free(&arena);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("polygon_repeats");
  TCase *c = tcase_create("polygon_repeats");
  tcase_add_test(c, test_any_order);
  tcase_add_test(c, test_large_polygons);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
