#include "build/lattice/lattice_hinges.h"

#include <stdlib.h>
#include <string.h>

#include "base/union_find.h"
#include "build/lattice/lattice.h"
#include "build/lattice/lattice_limbs.h"
#include "harness.h"
#include "shapes.h"

static sbfi_arena arena;
static sbfi_lattice_grid grid;
static uint8_t *states, *inside;

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_lattice_grid_fit(&grid, (sbfi_d3){0, 0, 0}, (sbfi_d3){8, 8, 8}, 1));
  states = sbfi_arena_allocate(&arena, grid.node_count, 1);
  inside = sbfi_arena_allocate(&arena, grid.node_count, 1);
}
static void teardown(void) {
  sbfi_arena_free(&arena);
}

static uint32_t node(int32_t x, int32_t y, int32_t z) {
  return sbfi_lattice_node(&grid, x, y, z);
}

static uint32_t joined(void) {
  uint32_t count;
  ck_assert(sbfi_lattice_join_hinges(&grid, states, inside, &count, &arena));
  return count;
}

/* Two nodes inside, four apart along x, meet at the node between them. */
START_TEST(a_hinge_node_is_forced_inside)
{
  states[node(8, 10, 10)] = states[node(12, 10, 10)] = SBFI_LATTICE_NODE_INSIDE;
  states[node(10, 10, 10)] = states[node(8, 12, 10)] = SBFI_LATTICE_NODE_ON;
  ck_assert_uint_eq(joined(), 1);
  ck_assert_uint_eq(inside[node(10, 10, 10)], SBFI_LATTICE_INSIDE | SBFI_LATTICE_FORCED);
  ck_assert_uint_eq(inside[node(8, 12, 10)], 0);
}
END_TEST

/* The same with a way around: a ring has no hinge. */
START_TEST(nodes_joined_elsewhere_are_unchanged)
{
  for (int32_t x = 8; x <= 12; x += 2) states[node(x, 14, 10)] = SBFI_LATTICE_NODE_INSIDE;
  for (int32_t y = 10; y <= 14; y += 2)
    states[node(8, y, 10)] = states[node(12, y, 10)] = SBFI_LATTICE_NODE_INSIDE;
  states[node(10, 10, 10)] = SBFI_LATTICE_NODE_ON;
  ck_assert_uint_eq(joined(), 0);
  ck_assert_uint_eq(inside[node(10, 10, 10)], 0);
}
END_TEST

/* A middle and a corner next to each other share tetrahedra. */
START_TEST(neighbours_are_one_part)
{
  states[node(10, 10, 10)] = states[node(11, 11, 11)] = SBFI_LATTICE_NODE_INSIDE;
  states[node(11, 11, 9)] = states[node(12, 10, 10)] = SBFI_LATTICE_NODE_ON;
  ck_assert_uint_eq(joined(), 0);
}
END_TEST

typedef struct side {
  uint32_t points[3], tetrahedron;
} side;

static int compare_sides(const void *a, const void *b) {
  return memcmp(a, b, sizeof((const side *)a)->points);
}

static int compare_points(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return x < y ? -1 : x > y;
}

static uint32_t sets_of(const uint32_t *parents, uint32_t count) {
  uint32_t sets = 0;
  for (uint32_t i = 0; i < count; i++) sets += parents[i] == i;
  return sets;
}

/* Pieces that points join, and every point is in some. */
static uint32_t pieces_of(const sbfi_tetrahedra *made) {
  uint32_t *parents = sbfi_arena_allocate(&arena, made->point_count, sizeof *parents);
  sbfi_sets_begin(parents, made->point_count);
  for (uint32_t t = 0; t < made->count; t++)
    for (int k = 1; k < 4; k++) sbfi_sets_join(parents, made->at[t].at[0], made->at[t].at[k]);
  return sets_of(parents, made->point_count);
}

/* Parts that faces join. */
static uint32_t parts_of(const sbfi_tetrahedra *made) {
  side *sides = sbfi_arena_allocate(&arena, 4 * (size_t)made->count, sizeof *sides);
  uint32_t *parents = sbfi_arena_allocate(&arena, made->count, sizeof *parents);
  for (uint32_t t = 0; t < made->count; t++)
    for (uint32_t left = 0; left < 4; left++) {
      side *s = &sides[4 * t + left];
      s->tetrahedron = t;
      for (uint32_t k = 0, next = 0; k < 4; k++)
        if (k != left) s->points[next++] = made->at[t].at[k];
      qsort(s->points, 3, sizeof *s->points, compare_points);
    }
  qsort(sides, 4 * (size_t)made->count, sizeof *sides, compare_sides);
  sbfi_sets_begin(parents, made->count);
  for (size_t i = 1; i < 4 * (size_t)made->count; i++)
    if (compare_sides(&sides[i - 1], &sides[i]) == 0)
      sbfi_sets_join(parents, sides[i - 1].tetrahedron, sides[i].tetrahedron);
  return sets_of(parents, made->count);
}

/* At a cell of 2.061 its left hand hung on two points, and swung by 26 m. */
START_TEST(no_hand_of_the_armadillo_swings)
{
  const char *path = harness_shared("armadillo/armadillo_25k.obj");
  if (!path) return;
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_polygon_mesh mesh = shape_of_obj(asset, path);
  sbfi_soup soup;
  sbfi_winding winding;
  ck_assert(sbfi_soup_make(&soup, &mesh, &arena));
  ck_assert(sbfi_winding_make(&winding, &soup, &arena));
  for (double cell = 2.0610006; cell > 0.6; cell /= 1.17) {
    sbfi_lattice lattice;
    ck_assert_int_eq(
        sbfi_lattice_make(&lattice, &winding, cell, (sbfi_progress){0}, &arena), SBFI_LATTICE_MADE);
    ck_assert_uint_eq(parts_of(&lattice.made), pieces_of(&lattice.made));
  }
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("lattice_hinges");
  TCase *c = tcase_create("lattice_hinges");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_hinge_node_is_forced_inside);
  tcase_add_test(c, nodes_joined_elsewhere_are_unchanged);
  tcase_add_test(c, neighbours_are_one_part);
  tcase_add_test(c, no_hand_of_the_armadillo_swings);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
