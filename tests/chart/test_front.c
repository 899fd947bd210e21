/* The Pareto front of small sets, and of random ones against its own definition. */
#include "chart/front.h"

#include <math.h>
#include <stdbool.h>

#include "harness.h"

START_TEST(only_undominated_entries_are_on_the_front)
{
  const chart_point points[] = {{4, 1}, {1, 5}, {2, 3}, {3, 3}, {2, 3}, {5, 2}, {NAN, 0}, {0.5, NAN}, {8, 0}};
  uint32_t front[9];
  ck_assert_uint_eq(chart_front_of(points, 9, front), 4);
  ck_assert_uint_eq(front[0], 1);
  ck_assert_uint_eq(front[1], 2); /* the first of two equal ones */
  ck_assert_uint_eq(front[2], 0);
  ck_assert_uint_eq(front[3], 8);
}
END_TEST

START_TEST(no_entries_have_no_front)
{
  uint32_t front[1];
  ck_assert_uint_eq(chart_front_of(NULL, 0, front), 0);
  ck_assert_uint_eq(chart_front_of(&(chart_point){NAN, NAN}, 1, front), 0);
}
END_TEST

START_TEST(every_other_point_is_beaten)
{
  enum { COUNT = 200 };
  chart_point points[COUNT];
  uint32_t front[COUNT], random = 11;
  for (int i = 0; i < COUNT; i++) {
    random = random * 1664525u + 1013904223u;
    points[i] = (chart_point){(random >> 16) % 40, (random >> 8) % 40};
  }
  uint32_t count = chart_front_of(points, COUNT, front);
  ck_assert_uint_gt(count, 1);
  for (uint32_t i = 1; i < count; i++) {
    ck_assert_double_lt(points[front[i - 1]].cost, points[front[i]].cost);
    ck_assert_double_gt(points[front[i - 1]].error, points[front[i]].error);
  }
  for (int i = 0; i < COUNT; i++) {
    bool beaten = false;
    for (uint32_t k = 0; k < count; k++)
      beaten =
          beaten || (points[front[k]].cost <= points[i].cost && points[front[k]].error <= points[i].error);
    ck_assert(beaten);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("front");
  TCase *c = tcase_create("front");
  tcase_add_test(c, only_undominated_entries_are_on_the_front);
  tcase_add_test(c, no_entries_have_no_front);
  tcase_add_test(c, every_other_point_is_beaten);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
