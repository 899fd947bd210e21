#include <math.h>

#include "harness.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;

static void setup(void) {
  asset = sbf_asset_create(NULL);
}
static void teardown(void) {
  sbf_asset_free(asset);
}

START_TEST(cube)
{
  for (uint32_t n = 1; n < 5; n++) {
    sbf_polygon_mesh mesh = shape_cube(asset, n, 2, (sbf_vec3){100, -50, 3});
    sbf_surface_measures m;
    sbf_surface_measure(&mesh, NULL, &m);
    ck_assert_double_eq_tol(m.volume, 8, 1e-4);
    ck_assert_double_eq_tol(m.area, 24, 1e-4);
    ck_assert_double_eq_tol(m.opening, 0, 1e-6);
  }
}
END_TEST

START_TEST(deformed_positions_stand_in)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 2, 2, (sbf_vec3){0, 0, 0});
  sbf_vec3 moved[26];
  for (int i = 0; i < 26; i++) {
    sbf_vec3 p = mesh.positions.at[i];
    moved[i] = (sbf_vec3){-p.x, p.y, 3 * p.z}; /* mirrored: inside out */
  }
  sbf_surface_measures m;
  sbf_surface_measure(&mesh, moved, &m);
  ck_assert_double_eq_tol(m.volume, -24, 1e-9);
  ck_assert_double_eq_tol(m.area, 2 * 4 + 4 * 12, 1e-9);
}
END_TEST

START_TEST(open_surfaces)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 5, 4), box = shape_cube(asset, 1, 2, (sbf_vec3){0, 0, 0});
  sbf_surface_measures m;
  sbf_surface_measure(&sheet, NULL, &m);
  ck_assert_double_eq_tol(m.area, 20, 1e-9);
  ck_assert_double_eq_tol(m.volume, 0, 1e-9);
  ck_assert_double_eq_tol(m.opening, 1, 1e-9);
  box.polygon_sizes.count--; /* a box without its lid keeps five of its six pyramids */
  box.polygon_points.count -= 4;
  sbf_surface_measure(&box, NULL, &m);
  ck_assert_double_eq_tol(m.volume, 8 * 5.0 / 6, 1e-9);
  ck_assert_double_eq_tol(m.opening, 0.2, 1e-9);
}
END_TEST

START_TEST(tributary_areas)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 2, 2);
  float areas[9];
  sbf_surface_point_areas(&sheet, areas);
  ck_assert_float_eq_tol(areas[0], 0.25f, 1e-6f);
  ck_assert_float_eq_tol(areas[1], 0.5f, 1e-6f);
  ck_assert_float_eq_tol(areas[4], 1, 1e-6f);
}
END_TEST

START_TEST(normals)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 2, 2, (sbf_vec3){5, 0, 0});
  sbf_vec3 found[26];
  sbf_surface_point_normals(&mesh, found);
  for (int i = 0; i < 26; i++) {
    /* Of a cube about its centre, the way to the point with its coordinates made -1, 0, 1: along the
     * diagonal. */
    sbf_vec3 p = mesh.positions.at[i];
    float length = sqrtf((p.x - 5) * (p.x - 5) + p.y * p.y + p.z * p.z);
    ck_assert_float_eq_tol(found[i].x, (p.x - 5) / length, 1e-5f);
    ck_assert_float_eq_tol(found[i].y, p.y / length, 1e-5f);
  }
}
END_TEST

static sbf_vec3 turned(sbf_quat q, sbf_vec3 v) {
  float tx = 2 * (q.y * v.z - q.z * v.y), ty = 2 * (q.z * v.x - q.x * v.z), tz = 2 * (q.x * v.y - q.y * v.x);
  return (sbf_vec3){v.x + q.w * tx + q.y * tz - q.z * ty, v.y + q.w * ty + q.z * tx - q.x * tz,
      v.z + q.w * tz + q.x * ty - q.y * tx};
}

START_TEST(solid_box)
{
  /* A box of 1 x 2 x 3 at an angle: moments V (b^2 + c^2) / 12, axes along its sides. */
  const sbf_quat attitudes[] = {
      {0, 0, 0, 1}, {0.5f, 0.5f, 0.5f, 0.5f}, {0.1f, -0.7f, 0.1f, 0.7f}, {0.6f, 0, 0.8f, 0}, {0, 1, 0, 0}};
  for (int a = 0; a < 5; a++) {
    sbf_polygon_mesh mesh = shape_cube(asset, 2, 1, (sbf_vec3){0, 0, 0});
    sbf_vec3 moved[26];
    for (int i = 0; i < 26; i++) {
      sbf_vec3 p = mesh.positions.at[i], q = turned(attitudes[a], (sbf_vec3){3 * p.x, p.y, 2 * p.z});
      moved[i] = (sbf_vec3){q.x + 5, q.y, q.z - 7};
    }
    mesh.positions.at = moved;
    sbf_solid solid;
    sbf_solid_measure(&mesh, &solid);
    ck_assert_double_eq_tol(solid.volume, 6, 1e-4);
    ck_assert_float_eq_tol(solid.center.x, 5, 1e-5f);
    ck_assert_float_eq_tol(solid.center.z, -7, 1e-5f);
    ck_assert_float_eq_tol(solid.inertia.x, 6 * 5 / 12.0f, 1e-4f);  /* about the longest side */
    ck_assert_float_eq_tol(solid.inertia.y, 6 * 10 / 12.0f, 1e-4f); /* about the side of 2 */
    ck_assert_float_eq_tol(solid.inertia.z, 6 * 13 / 12.0f, 1e-4f); /* about the shortest */
    sbf_vec3 longest = turned(attitudes[a], (sbf_vec3){1, 0, 0});
    sbf_vec3 axis = turned(solid.inertia_rotation, (sbf_vec3){1, 0, 0});
    float cosine = longest.x * axis.x + longest.y * axis.y + longest.z * axis.z;
    ck_assert_float_eq_tol(cosine * cosine, 1, 1e-4f);
    sbf_quat q = solid.inertia_rotation;
    ck_assert_float_eq_tol(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-5f);
  }
}
END_TEST

START_TEST(solid_of_nothing)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 2, 2);
  sbf_solid solid;
  sbf_solid_measure(&sheet, &solid);
  ck_assert(solid.volume == 0 && solid.inertia.x == 0 && solid.inertia_rotation.w == 1);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("surface_measure");
  TCase *c = tcase_create("surface_measure");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, cube);
  tcase_add_test(c, deformed_positions_stand_in);
  tcase_add_test(c, open_surfaces);
  tcase_add_test(c, tributary_areas);
  tcase_add_test(c, normals);
  tcase_add_test(c, solid_box);
  tcase_add_test(c, solid_of_nothing);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
