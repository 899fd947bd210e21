#include "build/sections/section_caps.h"

#include "build/geometry/topology.h"
#include "harness.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"
#include "skinned_limb.h"

static sbfi_arena arena;

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
}

static void teardown(void) {
  sbfi_arena_free(&arena);
}

static sbfi_topology topology_of(const sbf_polygon_mesh *mesh) {
  sbfi_topology t;
  ck_assert(sbfi_topology_build(&t, mesh, &arena));
  return t;
}

START_TEST(a_tube_is_closed_at_both_ends)
{
  const skinned_limb of = {.bones = 2, .sides = 8, .rings_a_bone = 2, .radius = 0.5f, .open = true};
  sbf_asset *asset = skinned_limb_make(&of);
  sbf_polygon_mesh mesh = asset->render_meshes.at[0].mesh;
  uint32_t points = mesh.positions.count, polygons = mesh.polygon_sizes.count;
  sbfi_caps caps;
  ck_assert(sbfi_section_caps_make(&mesh, &caps, &arena));
  ck_assert_uint_eq(caps.loops, 2);
  ck_assert_uint_eq(caps.left_sides, 0);
  ck_assert_uint_eq(mesh.positions.count, points + 2);
  ck_assert_uint_eq(mesh.polygon_sizes.count, polygons + 16);
  sbfi_topology t = topology_of(&mesh);
  ck_assert_uint_eq(t.boundary_edge_count + t.nonmanifold_edge_count + t.clashing_edge_count, 0);
  sbf_surface_measures whole;
  sbf_surface_measure(&mesh, NULL, &whole);
  ck_assert_double_eq_tol(whole.volume, 2 * 8 * 0.5 * 0.5 * 0.5 * 0.7071067811865476, 1e-6);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(closed_meshes_are_unchanged)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_polygon_mesh mesh = shape_cube(asset, 2, 1, (sbf_vec3){0, 0, 0});
  const uint32_t *points = mesh.polygon_points.at;
  sbfi_caps caps;
  ck_assert(sbfi_section_caps_make(&mesh, &caps, &arena));
  ck_assert_uint_eq(caps.loops, 0);
  ck_assert_ptr_eq(mesh.polygon_points.at, points);
  /* Without one quad: one quad again. */
  mesh.polygon_sizes.count--;
  mesh.polygon_points.count -= 4;
  ck_assert(sbfi_section_caps_make(&mesh, &caps, &arena));
  ck_assert_uint_eq(caps.loops, 1);
  ck_assert_uint_eq(mesh.polygon_sizes.count, 24);
  ck_assert_uint_eq(mesh.positions.count, 26);
  ck_assert_uint_eq(topology_of(&mesh).boundary_edge_count, 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(holes_with_a_common_point_are_two)
{
  /* Two quads out of one face of a cube, diagonal from each other. */
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_polygon_mesh mesh = shape_cube(asset, 2, 1, (sbf_vec3){0, 0, 0});
  static uint32_t corners[22 * 4];
  uint32_t next = 0;
  for (uint32_t p = 0; p < 24; p++)
    for (uint32_t k = 0; k < 4 && p != 0 && p != 3; k++) corners[next++] = mesh.polygon_points.at[4 * p + k];
  mesh.polygon_points = (sbf_u32_list){corners, 22 * 4};
  mesh.polygon_sizes.count = 22;
  sbfi_caps caps;
  ck_assert(sbfi_section_caps_make(&mesh, &caps, &arena));
  ck_assert_uint_eq(caps.loops, 2);
  ck_assert_uint_eq(mesh.polygon_sizes.count, 24);
  ck_assert_uint_eq(topology_of(&mesh).boundary_edge_count, 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(three_sheets_on_an_edge)
{
  /* A book of three pages: each page closes with the next where it can. */
  static const sbf_vec3 at[] = {
      {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 1}, {-1, 1, 1}, {-1, 0, -1}, {-1, 1, -1}};
  static const uint32_t sizes[] = {4, 4, 4}, corners[] = {0, 2, 3, 1, 0, 4, 5, 1, 0, 6, 7, 1};
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){at, 8};
  mesh.polygon_sizes = (sbf_u32_list){sizes, 3};
  mesh.polygon_points = (sbf_u32_list){corners, 12};
  sbfi_caps caps;
  ck_assert(sbfi_section_caps_make(&mesh, &caps, &arena));
  ck_assert_uint_eq(caps.loops + caps.left_sides > 0, 1);
  for (uint32_t i = 0; i < mesh.polygon_points.count; i++)
    ck_assert_uint_lt(mesh.polygon_points.at[i], mesh.positions.count);
}
END_TEST

START_TEST(memory_may_run_out)
{
  const skinned_limb of = {.bones = 2, .sides = 8, .rings_a_bone = 2, .radius = 0.5f, .open = true};
  sbf_asset *asset = skinned_limb_make(&of);
  bool good = false;
  for (size_t allowed = 0; allowed < 100 && !good; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena small;
    sbfi_arena_init(&small, &memory.allocator, 0);
    sbf_polygon_mesh mesh = asset->render_meshes.at[0].mesh;
    sbfi_caps caps;
    good = sbfi_section_caps_make(&mesh, &caps, &small);
    sbfi_arena_free(&small);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert(good);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_caps");
  TCase *c = tcase_create("section_caps");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_tube_is_closed_at_both_ends);
  tcase_add_test(c, closed_meshes_are_unchanged);
  tcase_add_test(c, holes_with_a_common_point_are_two);
  tcase_add_test(c, three_sheets_on_an_edge);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
