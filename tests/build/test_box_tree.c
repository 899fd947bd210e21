#include "build/geometry/box_tree.h"

#include <math.h>

#include "harness.h"

static sbfi_arena arena;

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
}
static void teardown(void) {
  sbfi_arena_free(&arena);
}

static double box_distance(const void *user, uint32_t item, const double point[3]) {
  return sbfi_box_distance((const sbfi_box *)user + item, point);
}

static double enter_at(const void *user, uint32_t item, const double origin[3], const double direction[3]) {
  (void)origin;
  (void)direction;
  return ((const double *)user)[item];
}

START_TEST(distance_to_a_box)
{
  const sbfi_box box = {{0, 0, 0}, {1, 2, 3}};
  ck_assert(sbfi_box_distance(&box, (double[]){0.5, 1, 3}) == 0);
  ck_assert(sbfi_box_distance(&box, (double[]){2, 1, 3}) == 1);
  ck_assert(sbfi_box_distance(&box, (double[]){-1, 3, 5}) == 1 + 1 + 4);
}
END_TEST

START_TEST(of_equals_the_lowest_number)
{
  /* A hundred boxes at one position: item 0 in any order of the tree. */
  sbfi_box boxes[100];
  for (int i = 0; i < 100; i++) boxes[i] = (sbfi_box){{1, 1, 1}, {2, 2, 2}};
  sbfi_box_tree tree;
  ck_assert(sbfi_box_tree_build(&tree, boxes, 100, &arena));
  double min = INFINITY;
  ck_assert_uint_eq(sbfi_box_tree_nearest(&tree, (double[]){0, 1, 1}, box_distance, boxes, &min), 0);
  ck_assert(min == 1);
  /* An equal distance does not replace the caller's present result. */
  ck_assert_uint_eq(sbfi_box_tree_nearest(&tree, (double[]){0, 1, 1}, box_distance, boxes, &min), UINT32_MAX);
  double positions[100];
  for (int i = 0; i < 100; i++) positions[i] = 5;
  ck_assert_uint_eq(sbfi_box_tree_pierced(
                        &tree, (double[]){0, 1.5, 1.5}, (double[]){1, 0, 0}, INFINITY, enter_at, positions),
      0);
}
END_TEST

START_TEST(every_item_is_found)
{
  sbfi_box boxes[1000];
  for (int i = 0; i < 1000; i++) {
    float x = (float)(i % 10), y = (float)(i / 10 % 10), z = (float)(i / 100);
    boxes[i] = (sbfi_box){{x, y, z}, {x, y, z}};
  }
  sbfi_box_tree tree;
  ck_assert(sbfi_box_tree_build(&tree, boxes, 1000, &arena));
  ck_assert_uint_le(tree.node_count, 2000);
  for (uint32_t i = 0; i < 1000; i++) {
    double min = INFINITY, at[3] = {boxes[i].low[0] + 0.2, boxes[i].low[1] - 0.3, boxes[i].low[2] + 0.1};
    ck_assert_uint_eq(sbfi_box_tree_nearest(&tree, at, box_distance, boxes, &min), i);
  }
}
END_TEST

START_TEST(boxes_without_size_or_bound)
{
  const sbfi_box boxes[] = {{{-3e38f, -3e38f, 0}, {3e38f, 3e38f, 0}}, {{1, 1, 1}, {1, 1, 1}},
      {{0, 0, 0}, {0, 0, 0}}, {{7, 0, 0}, {7, 0, 0}}, {{0, 7, 0}, {0, 7, 0}}, {{0, 0, 7}, {0, 0, 7}}};
  sbfi_box_tree tree;
  ck_assert(sbfi_box_tree_build(&tree, boxes, 6, &arena));
  double min = INFINITY;
  ck_assert_uint_eq(sbfi_box_tree_nearest(&tree, (double[]){1, 1, 1}, box_distance, boxes, &min), 1);
  ck_assert(sbfi_box_tree_build(&tree, boxes, 0, &arena));
  min = INFINITY;
  ck_assert_uint_eq(sbfi_box_tree_nearest(&tree, (double[]){1, 1, 1}, box_distance, boxes, &min), UINT32_MAX);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("box_tree");
  TCase *c = tcase_create("box_tree");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, distance_to_a_box);
  tcase_add_test(c, of_equals_the_lowest_number);
  tcase_add_test(c, every_item_is_found);
  tcase_add_test(c, boxes_without_size_or_bound);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
