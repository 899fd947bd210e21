#include "build/geometry/winding_number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;
static sbfi_soup soup;
static sbfi_winding winding;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
}
static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static void wind(const sbf_polygon_mesh *mesh) {
  ck_assert(sbfi_soup_make(&soup, mesh, &arena));
  ck_assert(sbfi_winding_make(&winding, &soup, &arena));
}

static double number_at(double x, double y, double z) {
  sbfi_d3 at = {x, y, z};
  return sbfi_winding_of_closed(&winding, at) - sbfi_winding_of_caps(&winding, at);
}

START_TEST(a_closed_cube)
{
  sbf_polygon_mesh cube = shape_cube(asset, 4, 2, (sbf_vec3){0, 0, 0});
  wind(&cube);
  ck_assert_uint_eq(soup.point_count, 98);
  ck_assert_uint_eq(soup.triangle_count, 192);
  ck_assert_uint_eq(soup.cap_count + soup.flipped_count, 0);
  for (double x = -1.875; x < 2; x += 0.25)
    for (double y = -1.875; y < 2; y += 0.25)
      ck_assert_int_eq(sbfi_winding_of_closed(&winding, (sbfi_d3){x, y, 0.1}), fabs(x) < 1 && fabs(y) < 1);
}
END_TEST

START_TEST(turned_patches_are_found)
{
  sbf_polygon_mesh cube = shape_cube(asset, 4, 2, (sbf_vec3){0, 0, 0});
  uint32_t *corners = (uint32_t *)(uintptr_t)cube.polygon_points.at;
  for (uint32_t p = 0; p < 7; p++) {
    uint32_t swap = corners[4 * p + 1];
    corners[4 * p + 1] = corners[4 * p + 3];
    corners[4 * p + 3] = swap;
  }
  wind(&cube);
  ck_assert_uint_eq(soup.flipped_count, 14);
  ck_assert_uint_eq(soup.cap_count, 0);
  ck_assert_double_eq(number_at(0.3, 0.2, 0.1), 1);
  ck_assert_double_eq(number_at(1.3, 0.2, 0.1), 0);
}
END_TEST

/* A cube without one side: its caps must not affect the number, which is 5/6 at the middle. */
START_TEST(an_open_cube)
{
  sbf_polygon_mesh cube = shape_cube(asset, 2, 2, (sbf_vec3){0, 0, 0});
  sbf_vec3 *positions = (sbf_vec3 *)(uintptr_t)cube.positions.at;
  uint32_t kept = 0, *corners = (uint32_t *)(uintptr_t)cube.polygon_points.at;
  for (uint32_t p = 0; p < cube.polygon_sizes.count; p++) {
    double top = 0;
    for (int k = 0; k < 4; k++) top += positions[corners[4 * p + k]].y;
    if (top == 4) continue;
    for (int k = 0; k < 4; k++) corners[4 * kept + k] = corners[4 * p + k];
    kept++;
  }
  ck_assert_uint_eq(kept, 20);
  cube.polygon_sizes.count = kept;
  cube.polygon_points.count = 4 * kept;
  wind(&cube);
  ck_assert_uint_eq(soup.cap_count, 8);
  ck_assert_double_eq_tol(number_at(0, 0, 0), 5.0 / 6, 1e-9);
  ck_assert_double_eq_tol(number_at(0, 30, 0), 1 / (3.14159265 * 29 * 29), 2e-5);
  ck_assert(sbfi_winding_inside(1, 0.4));
  ck_assert(!sbfi_winding_inside(1, 0.6));
  ck_assert(sbfi_winding_inside(-1, 0));
}
END_TEST

/* Two cubes in one another, and one of them inside out beside them. */
START_TEST(soups)
{
  sbf_polygon_mesh a = shape_cube(asset, 3, 2, (sbf_vec3){0, 0, 0});
  sbf_vec3 points[3 * 56];
  uint32_t sizes[3 * 54], corners[3 * 216];
  for (uint32_t c = 0; c < 3; c++) {
    float shift = c == 1 ? 1 : c == 2 ? 8 : 0;
    for (uint32_t i = 0; i < 56; i++) {
      points[c * 56 + i] = a.positions.at[i];
      points[c * 56 + i].x += shift;
    }
    for (uint32_t p = 0; p < 54; p++) {
      sizes[c * 54 + p] = 4;
      for (uint32_t k = 0; k < 4; k++)
        corners[c * 216 + 4 * p + k] = c * 56 + a.polygon_points.at[4 * p + (c == 2 ? 3 - k : k)];
    }
  }
  sbf_polygon_mesh all = a;
  all.positions = (sbf_vec3_list){points, 168};
  all.polygon_sizes = (sbf_u32_list){sizes, 162};
  all.polygon_points = (sbf_u32_list){corners, 648};
  wind(&all);
  ck_assert_double_eq(number_at(0.5, 0.1, 0.2), 2);
  ck_assert_double_eq(number_at(-0.5, 0.1, 0.2), 1);
  ck_assert_double_eq(number_at(8, 0.1, 0.2), -1);
  ck_assert_double_eq(number_at(4, 0.1, 0.2), 0);
}
END_TEST

/* Triangles that a query visits. */
static uint32_t visits_at(const sbfi_winding_tree *tree, sbfi_d3 at) {
  uint32_t waiting[128], count = 0, visits = 0;
  if (tree->node_count) waiting[count++] = 0;
  while (count) {
    const sbfi_winding_node *node = &tree->nodes[waiting[--count]];
    sbfi_d3 displacement = sbfi_d3_sub(node->middle, at);
    if (sbfi_d3_dot(displacement, displacement) > node->far2) continue;
    visits += node->count;
    for (uint32_t child = 0; !node->count && child < 2; child++) waiting[count++] = node->first + child;
  }
  return visits;
}

static double random_side(uint32_t *state) {
  *state = *state * 1664525u + 1013904223u;
  return (*state >> 8) / 16777216.0;
}

/* Long triangles everywhere: the cost of a query does not grow with their number. */
START_TEST(open_soups_of_long_triangles)
{
  enum { MAX = 4096, QUERIES = 200 };
  static sbf_vec3 points[3 * MAX];
  static uint32_t sizes[MAX], corners[3 * MAX];
  uint32_t state = 7;
  for (uint32_t i = 0; i < 3 * MAX; i++) {
    points[i] =
        (sbf_vec3){(float)random_side(&state), (float)random_side(&state), (float)random_side(&state)};
    corners[i] = i;
    sizes[i / 3] = 3;
  }
  for (uint32_t triangles = 256; triangles <= MAX; triangles *= 4) {
    sbf_polygon_mesh mesh = {.positions = {points, 3 * triangles},
        .polygon_sizes = {sizes, triangles},
        .polygon_points = {corners, 3 * triangles}};
    wind(&mesh);
    double visits = 0;
    for (uint32_t i = 0; i < QUERIES; i++) {
      sbfi_d3 at = {random_side(&state), random_side(&state), random_side(&state)};
      visits += visits_at(&winding.closed, at) + visits_at(&winding.caps, at);
    }
    ck_assert_double_lt(visits / QUERIES, 256);
    /* Outside the bounds it is exact. */
    for (uint32_t i = 0; i < QUERIES; i++)
      ck_assert_double_eq(number_at(random_side(&state), random_side(&state), 1.01), 0);
  }
}
END_TEST

/* A closed tube of slivers keeps its exact number. */
START_TEST(a_tube_of_slivers)
{
  enum { SIDES = 1000 };
  static sbf_vec3 points[2 * SIDES];
  static uint32_t sizes[SIDES + 2], corners[6 * SIDES];
  for (uint32_t i = 0; i < SIDES; i++) {
    double angle = 6.283185307179586 * i / SIDES;
    for (uint32_t end = 0; end < 2; end++)
      points[2 * i + end] = (sbf_vec3){(float)cos(angle), end ? 20.0f : -20.0f, (float)sin(angle)};
    const uint32_t next = (i + 1) % SIDES, side[4] = {2 * i, 2 * i + 1, 2 * next + 1, 2 * next};
    memcpy(corners + 4 * i, side, sizeof side);
    sizes[i] = 4;
    corners[4 * SIDES + i] = 2 * i;
    corners[5 * SIDES + i] = 2 * (SIDES - 1 - i) + 1;
  }
  sizes[SIDES] = sizes[SIDES + 1] = SIDES;
  sbf_polygon_mesh mesh = {.positions = {points, 2 * SIDES},
      .polygon_sizes = {sizes, SIDES + 2},
      .polygon_points = {corners, 6 * SIDES}};
  wind(&mesh);
  ck_assert_uint_eq(soup.cap_count, 0);
  for (double y = -19.5; y < 20; y += 1) {
    ck_assert_int_eq(abs(sbfi_winding_of_closed(&winding, (sbfi_d3){0.3, y, 0.5})), 1);
    ck_assert_int_eq(sbfi_winding_of_closed(&winding, (sbfi_d3){1.2, y, 0.5}), 0);
  }
}
END_TEST

/* The tree takes less than 200 bytes a triangle; building it takes more. */
START_TEST(memory_is_freed)
{
  sbf_polygon_mesh cube = shape_cube(asset, 60, 2, (sbf_vec3){0, 0, 0});
  wind(&cube);
  ck_assert_uint_eq(soup.triangle_count, 43200);
  ck_assert_uint_lt(arena.used_bytes, 200 * (size_t)soup.triangle_count);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 2, 2);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena small;
    sbfi_arena_init(&small, &memory.allocator, 0);
    bool good = sbfi_soup_make(&soup, &sheet, &small) && sbfi_winding_make(&winding, &soup, &small);
    sbfi_arena_free(&small);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (good) break;
    ck_assert_uint_lt(allowed, 100);
  }
  ck_assert_uint_eq(soup.cap_count, 8);
}
END_TEST

int main(void) {
  Suite *s = suite_create("winding_number");
  TCase *c = tcase_create("winding_number");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_closed_cube);
  tcase_add_test(c, turned_patches_are_found);
  tcase_add_test(c, an_open_cube);
  tcase_add_test(c, soups);
  tcase_add_test(c, open_soups_of_long_triangles);
  tcase_add_test(c, a_tube_of_slivers);
  tcase_add_test(c, memory_is_freed);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return harness_run(s);
}
