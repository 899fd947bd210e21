#include "shapes/bounds_tree.h"

#include <string.h>

#include "harness.h"

enum { COUNT = 500 };

static float random_of(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (float)(*seed >> 8) / 16777216.0f;
}

/* Every box that overlaps the query box is found exactly once. */
START_TEST(a_traversal_finds_all_overlaps)
{
  static sbri_box boxes[COUNT];
  static sbri_bounds_node nodes[2 * COUNT + 1];
  static uint32_t items[COUNT];
  uint32_t seed = 1;
  for (int i = 0; i < COUNT; i++) {
    sbf_vec3 low = {random_of(&seed) * 10, random_of(&seed) * 10, random_of(&seed) * 10};
    boxes[i] = (sbri_box){low, sbri_add(low, sbri_vec3(random_of(&seed), random_of(&seed), 0))};
  }
  sbri_bounds_tree tree = {.nodes = nodes, .items = items};
  const uint32_t counts[4] = {0, 1, 5, COUNT};
  for (int n = 0; n < 4; n++) {
    sbri_bounds_tree_make(&tree, boxes, counts[n]);
    ck_assert_uint_le(tree.node_count, sbri_bounds_tree_nodes(counts[n]));
    for (int k = 0; k < 50; k++) {
      sbf_vec3 low = {random_of(&seed) * 10, random_of(&seed) * 10, random_of(&seed) * 10};
      sbri_box asked = {low, sbri_add(low, sbri_vec3(2, 2, 2))};
      uint32_t seen[COUNT] = {0}, item;
      sbri_bounds_walk walk;
      sbri_bounds_walk_begin(&walk, &tree, asked);
      while (sbri_bounds_walk_next(&walk, &item)) seen[item]++;
      for (uint32_t i = 0; i < counts[n]; i++) {
        ck_assert_uint_le(seen[i], 1);
        if (sbri_boxes_overlap(&asked, &boxes[i])) ck_assert_uint_eq(seen[i], 1);
      }
    }
  }
}
END_TEST

/* After boxes moved far, a refitted tree finds the same as a rebuilt one. */
START_TEST(a_refitted_tree_finds_all_overlaps)
{
  static sbri_box boxes[COUNT];
  static sbri_bounds_node nodes[2 * COUNT + 1];
  static uint32_t items[COUNT];
  uint32_t seed = 7;
  sbri_bounds_tree tree = {.nodes = nodes, .items = items};
  for (int round = 0; round < 4; round++) {
    for (int i = 0; i < COUNT; i++) {
      sbf_vec3 low = {random_of(&seed) * 10, random_of(&seed) * 10, random_of(&seed) * 10};
      boxes[i] = (sbri_box){low, sbri_add(low, sbri_vec3(random_of(&seed), 0, random_of(&seed)))};
    }
    if (round == 0)
      sbri_bounds_tree_make(&tree, boxes, COUNT);
    else
      sbri_bounds_tree_refit(&tree, boxes);
    sbri_box whole = boxes[0];
    for (int i = 1; i < COUNT; i++) whole = sbri_box_join(whole, boxes[i]);
    ck_assert_int_eq(memcmp(&whole, &tree.nodes[0].box, sizeof whole), 0);
    for (int k = 0; k < 50; k++) {
      sbf_vec3 low = {random_of(&seed) * 10, random_of(&seed) * 10, random_of(&seed) * 10};
      sbri_box asked = {low, sbri_add(low, sbri_vec3(2, 2, 2))};
      uint32_t seen[COUNT] = {0}, item;
      sbri_bounds_walk walk;
      sbri_bounds_walk_begin(&walk, &tree, asked);
      while (sbri_bounds_walk_next(&walk, &item)) seen[item]++;
      for (uint32_t i = 0; i < COUNT; i++) ck_assert_uint_ge(1, seen[i]);
      for (uint32_t i = 0; i < COUNT; i++)
        if (sbri_boxes_overlap(&asked, &boxes[i])) ck_assert_uint_eq(seen[i], 1);
    }
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("bounds_tree");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_traversal_finds_all_overlaps);
  tcase_add_test(tests, a_refitted_tree_finds_all_overlaps);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
