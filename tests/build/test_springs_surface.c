#include "build/springs/springs.h"

#include <math.h>

#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static sbfi_surface_springs surface_springs(const sbf_polygon_mesh *mesh) {
  sbfi_topology t;
  sbfi_surface_springs springs;
  ck_assert(sbfi_topology_build(&t, mesh, &arena));
  ck_assert(sbfi_springs_surface(&springs, mesh, &t, true, &arena));
  return springs;
}

static bool has(sbfi_spring_list list, uint32_t a, uint32_t b) {
  for (uint32_t i = 0; i < list.count; i++)
    if ((list.at[i].at[0] == a && list.at[i].at[1] == b) || (list.at[i].at[0] == b && list.at[i].at[1] == a))
      return true;
  return false;
}

START_TEST(single_cube)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0});
  sbfi_surface_springs springs = surface_springs(&mesh);
  ck_assert_uint_eq(springs.structural.count, 12);
  ck_assert_uint_eq(springs.shear.count, 12);
  ck_assert_uint_eq(springs.flexion.count, 0); /* at a corner every two neighbours share a face */
  const uint32_t *c = mesh.polygon_points.at;
  ck_assert_uint_eq(springs.structural.at[0].at[0], c[0]);
  ck_assert_uint_eq(springs.structural.at[0].at[1], c[1]);
  ck_assert_uint_eq(springs.structural.at[3].at[0], c[3]);
  ck_assert_uint_eq(springs.structural.at[3].at[1], c[0]);
  ck_assert_uint_eq(springs.shear.at[0].at[0], c[0]);
  ck_assert_uint_eq(springs.shear.at[0].at[1], c[2]);
  ck_assert_uint_eq(springs.shear.at[1].at[0], c[1]);
  ck_assert_uint_eq(springs.shear.at[1].at[1], c[3]);
}
END_TEST

START_TEST(sheet_of_quads)
{
  sbf_polygon_mesh mesh = shape_sheet(asset, 4, 3);
  sbfi_surface_springs springs = surface_springs(&mesh);
  ck_assert_uint_eq(springs.structural.count, 4 * 4 + 3 * 5);
  ck_assert_uint_eq(springs.shear.count, 2 * 12);
  ck_assert_uint_eq(springs.flexion.count, 3 * 4 + 2 * 5); /* two apart along each line */
  ck_assert(has(springs.flexion, 0, 2));
  ck_assert(has(springs.flexion, 1, 9));
  ck_assert(!has(springs.flexion, 0, 10)); /* two apart across a corner point is no line */
}
END_TEST

START_TEST(triangles)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 4, 4), mesh = shape_triangulated(asset, &sheet);
  sbfi_surface_springs springs = surface_springs(&mesh);
  uint32_t inner_edges = 16 + 2 * 4 * 3;
  ck_assert_uint_eq(springs.structural.count, 2 * 4 * 5 + 16);
  ck_assert_uint_eq(springs.shear.count, inner_edges);
  /* Inside, six neighbours and three lines: both grid lines and the cut diagonal's. */
  ck_assert(has(springs.flexion, 6, 8));
  ck_assert(has(springs.flexion, 2, 12));
  ck_assert(has(springs.flexion, 0, 12));
  ck_assert(!has(springs.flexion, 2, 10));
}
END_TEST

/* A fan of seven triangles about point 0. Neighbours at 170 and 185 degrees both see the one at 0 straightest
 * across the point; it sees that at 185, and is joined with that alone. */
START_TEST(flexion_is_mutual)
{
  static const double degrees[] = {170, 185, 240, 300, 0, 50, 110};
  sbf_vec3 positions[8] = {{0, 0, 0}};
  uint32_t sizes[7], corners[21];
  for (uint32_t i = 0; i < 7; i++) {
    double angle = degrees[i] * 3.14159265358979 / 180;
    positions[i + 1] = (sbf_vec3){(float)cos(angle), 0, (float)sin(angle)};
    sizes[i] = 3;
    corners[3 * i] = 0, corners[3 * i + 1] = i + 1, corners[3 * i + 2] = (i + 1) % 7 + 1;
  }
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){positions, 8};
  mesh.polygon_sizes = (sbf_u32_list){sizes, 7};
  mesh.polygon_points = (sbf_u32_list){corners, 21};
  sbfi_surface_springs springs = surface_springs(&mesh);
  ck_assert_uint_eq(springs.flexion.count, 3);
  ck_assert(has(springs.flexion, 2, 5));
  ck_assert(has(springs.flexion, 3, 6));
  ck_assert(has(springs.flexion, 4, 7));
}
END_TEST

/* Four quads about point 0, whose other corners are 5 to 8; neighbours are at 0, 170, 220 and 300 degrees.
 * The one at 170 is straightest across from that at 0, but a polygon holds both: what lies opposite is the
 * one at 220. */
START_TEST(flexion_passes_over_corners_of_one_polygon)
{
  static const double degrees[] = {0, 170, 220, 300};
  sbf_vec3 positions[9] = {{0, 0, 0}};
  const uint32_t sizes[4] = {4, 4, 4, 4};
  uint32_t corners[16];
  for (uint32_t i = 0; i < 4; i++) {
    double angle = degrees[i] * 3.14159265358979 / 180, next = degrees[(i + 1) % 4] + (i == 3 ? 360 : 0),
           middle = (degrees[i] + next) / 2 * 3.14159265358979 / 180;
    positions[i + 1] = (sbf_vec3){(float)cos(angle), 0, (float)sin(angle)};
    positions[i + 5] = (sbf_vec3){(float)(2 * cos(middle)), 0, (float)(2 * sin(middle))};
    corners[4 * i] = 0, corners[4 * i + 1] = i + 1, corners[4 * i + 2] = i + 5,
                corners[4 * i + 3] = (i + 1) % 4 + 1;
  }
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){positions, 9};
  mesh.polygon_sizes = (sbf_u32_list){sizes, 4};
  mesh.polygon_points = (sbf_u32_list){corners, 16};
  sbfi_surface_springs springs = surface_springs(&mesh);
  ck_assert(has(springs.flexion, 1, 3));
  ck_assert(has(springs.flexion, 2, 4));
}
END_TEST

START_TEST(no_pair_twice)
{
  /* A tetrahedron: every two corners have an edge already. */
  const uint32_t sizes[] = {3, 3, 3, 3}, corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){positions, 4};
  mesh.polygon_sizes = (sbf_u32_list){sizes, 4};
  mesh.polygon_points = (sbf_u32_list){corners, 12};
  sbfi_surface_springs springs = surface_springs(&mesh);
  ck_assert_uint_eq(springs.structural.count, 6);
  ck_assert_uint_eq(springs.shear.count, 0);
  ck_assert_uint_eq(springs.flexion.count, 0);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("springs_surface");
  TCase *c = tcase_create("springs_surface");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, single_cube);
  tcase_add_test(c, sheet_of_quads);
  tcase_add_test(c, triangles);
  tcase_add_test(c, flexion_is_mutual);
  tcase_add_test(c, flexion_passes_over_corners_of_one_polygon);
  tcase_add_test(c, no_pair_twice);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
