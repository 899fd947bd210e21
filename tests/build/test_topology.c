#include "build/geometry/topology.h"

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

static sbf_polygon_mesh mesh_of(uint32_t points, uint32_t polygons, const uint32_t *sizes, uint32_t corners,
    const uint32_t *corner_points) {
  static const sbf_vec3 somewhere[16];
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){somewhere, points};
  mesh.polygon_sizes = (sbf_u32_list){sizes, polygons};
  mesh.polygon_points = (sbf_u32_list){corner_points, corners};
  return mesh;
}

START_TEST(cube_is_closed)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 3, 1, (sbf_vec3){0, 0, 0});
  sbfi_topology t;
  ck_assert(sbfi_topology_build(&t, &mesh, &arena));
  ck_assert_uint_eq(t.point_count, 56);
  ck_assert_uint_eq(t.edge_count, 2 * 54);
  ck_assert_uint_eq(t.point_count - t.edge_count + t.polygon_count, 2); /* Euler */
  ck_assert_uint_eq(t.boundary_edge_count, 0);
  ck_assert_uint_eq(t.nonmanifold_edge_count, 0);
  ck_assert_uint_eq(t.clashing_edge_count, 0);
  ck_assert_uint_eq(t.unused_point_count, 0);
  ck_assert_uint_eq(t.component_count, 1);
  uint32_t threes = 0;
  for (uint32_t i = 0; i < t.point_count; i++)
    threes += t.point_edge_begins[i + 1] - t.point_edge_begins[i] == 3;
  ck_assert_uint_eq(threes, 8);
}
END_TEST

START_TEST(edges_stand_in_the_order_of_the_walk)
{
  const uint32_t sizes[] = {3, 3}, corners[] = {2, 0, 1, 1, 3, 2};
  sbf_polygon_mesh mesh = mesh_of(5, 2, sizes, 6, corners);
  sbfi_topology t;
  ck_assert(sbfi_topology_build(&t, &mesh, &arena));
  const sbf_uint2 expected[] = {{{2, 0}}, {{0, 1}}, {{1, 2}}, {{1, 3}}, {{3, 2}}};
  ck_assert_uint_eq(t.edge_count, 5);
  ck_assert_mem_eq(t.edges, expected, sizeof expected);
  ck_assert_uint_eq(t.corner_edges[5], 2); /* 2 to 1, walked before from 1 to 2 */
  ck_assert_uint_eq(t.boundary_edge_count, 4);
  ck_assert_uint_eq(t.clashing_edge_count, 0);
  ck_assert_uint_eq(t.unused_point_count, 1);
  ck_assert_uint_eq(t.point_components[4], SBFI_NO_INDEX);
  ck_assert_uint_eq(t.edge_polygon_begins[3] - t.edge_polygon_begins[2], 2);
}
END_TEST

START_TEST(faults_are_counted)
{
  /* Three triangles at the edge 0-1, one of them wound the other way, a fourth apart, a side without length.
   */
  const uint32_t sizes[] = {3, 3, 3, 4}, corners[] = {0, 1, 2, 0, 1, 3, 1, 0, 4, 5, 6, 7, 7};
  sbf_polygon_mesh mesh = mesh_of(8, 4, sizes, 13, corners);
  sbfi_topology t;
  ck_assert(sbfi_topology_build(&t, &mesh, &arena));
  ck_assert_uint_eq(t.nonmanifold_edge_count, 1);
  ck_assert_uint_eq(t.degenerate_side_count, 1);
  ck_assert_uint_eq(t.component_count, 2);
  ck_assert_uint_eq(t.point_components[4], 0);
  ck_assert_uint_eq(t.point_components[7], 1);

  const uint32_t facing_away[] = {0, 1, 2, 0, 1, 3};
  mesh = mesh_of(4, 2, sizes, 6, facing_away);
  ck_assert(sbfi_topology_build(&t, &mesh, &arena));
  ck_assert_uint_eq(t.clashing_edge_count, 1);
}
END_TEST

START_TEST(an_empty_mesh_is_valid)
{
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  sbfi_topology t;
  ck_assert(sbfi_topology_build(&t, &mesh, &arena));
  ck_assert_uint_eq(t.edge_count, 0);
  ck_assert_uint_eq(t.component_count, 0);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 8, 1, (sbf_vec3){0, 0, 0});
  size_t allowed = 0;
  for (bool done = false; !done; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena failing;
    sbfi_arena_init(&failing, &memory.allocator, 0);
    sbfi_topology t;
    done = sbfi_topology_build(&t, &mesh, &failing);
    sbfi_arena_free(&failing);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert_uint_gt(allowed, 2);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("topology");
  TCase *c = tcase_create("topology");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, cube_is_closed);
  tcase_add_test(c, edges_stand_in_the_order_of_the_walk);
  tcase_add_test(c, faults_are_counted);
  tcase_add_test(c, an_empty_mesh_is_valid);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
