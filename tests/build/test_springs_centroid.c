#include "build/springs/springs.h"

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

START_TEST(centroid_of_a_cube)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 1, 2, (sbf_vec3){1, 1, 1});
  sbfi_centroid_interior interior;
  ck_assert(sbfi_springs_centroid(&interior, &mesh, 5, &arena));
  ck_assert_uint_eq(interior.point_count, 7);
  ck_assert_uint_eq(interior.internal.count, 8 + 6 * 5);
  ck_assert(interior.points[0].x == 1 && interior.points[0].y == 1 && interior.points[0].z == 1);
  /* The first face is at x = 0: four corners and the centre, 0.2 on average. */
  ck_assert_float_eq_tol(interior.points[1].x, 0.2f, 1e-6f);
  ck_assert_float_eq_tol(interior.points[1].y, 1, 1e-6f);
  uint32_t centre = 8 + 5;
  for (uint32_t i = 0; i < 8; i++) {
    ck_assert_uint_eq(interior.internal.at[i].at[0], centre);
    ck_assert_uint_eq(interior.internal.at[i].at[1], i);
  }
  for (uint32_t q = 0; q < 6; q++) {
    const sbf_uint2 *five = interior.internal.at + 8 + 5 * q;
    ck_assert_uint_eq(interior.polygon_points[q], q + 1);
    for (uint32_t k = 0; k < 4; k++) {
      ck_assert_uint_eq(five[k].at[0], centre + q + 1);
      ck_assert_uint_eq(five[k].at[1], mesh.polygon_points.at[4 * q + k]);
    }
    ck_assert_uint_eq(five[4].at[0], centre + q + 1);
    ck_assert_uint_eq(five[4].at[1], centre);
  }
}
END_TEST

START_TEST(centroid_of_triangles)
{
  sbf_polygon_mesh cube = shape_cube(asset, 1, 2, (sbf_vec3){0, 0, 0}),
                   mesh = shape_triangulated(asset, &cube);
  sbfi_centroid_interior interior;
  ck_assert(sbfi_springs_centroid(&interior, &mesh, 0, &arena));
  ck_assert_uint_eq(interior.point_count, 1 + 12);
  ck_assert_uint_eq(interior.internal.count, 8 + 12 * 4);
}
END_TEST

START_TEST(reference_lizard)
{
  const char *path = harness_shared("lizard/liz.obj");
  if (!path) return;
  shape_sections_of_obj(asset, path);
  ck_assert_uint_eq(asset->soft_bodies.count, 18);
  uint32_t structural = 0, shear = 0, internal = 0, points = 0, unused = 0, boundary = 0, nonmanifold = 0;
  for (uint32_t b = 0; b < 18; b++) {
    const sbf_polygon_mesh *mesh = &asset->soft_bodies.at[b].surface;
    sbfi_topology t;
    sbfi_surface_springs springs;
    sbfi_centroid_interior interior;
    ck_assert(sbfi_topology_build(&t, mesh, &arena));
    ck_assert(sbfi_springs_surface(&springs, mesh, &t, false, &arena));
    ck_assert(sbfi_springs_centroid(&interior, mesh, 0, &arena));
    structural += springs.structural.count;
    shear += springs.shear.count;
    internal += interior.internal.count;
    points += interior.point_count;
    unused += t.unused_point_count;
    boundary += t.boundary_edge_count;
    nonmanifold += t.nonmanifold_edge_count;
    ck_assert_uint_eq(springs.flexion.count, 0);
  }
  ck_assert_uint_eq(structural, 977);
  ck_assert_uint_eq(shear, 976);
  ck_assert_uint_eq(internal, 2965);
  ck_assert_uint_eq(points, 506);
  ck_assert_uint_eq(unused, 1);
  ck_assert_uint_eq(boundary, 1);
  ck_assert_uint_eq(nonmanifold, 2);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("springs_centroid");
  TCase *c = tcase_create("springs_centroid");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, centroid_of_a_cube);
  tcase_add_test(c, centroid_of_triangles);
  tcase_add_test(c, reference_lizard);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
