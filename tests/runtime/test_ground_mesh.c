#include <math.h>

#include "harness.h"
#include "sbrun/terrain.h"

enum { SIDE = 20, POINTS = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };
static sbf_vec3 points[POINTS];
static uint32_t triangles[3 * TRIANGLES];

/* A hilly sheet of 19 m, tilted planes between whole metres. */
static void make(void) {
  uint32_t n = 0;
  for (uint32_t r = 0; r < SIDE; r++)
    for (uint32_t c = 0; c < SIDE; c++)
      points[r * SIDE + c] = (sbf_vec3){(float)c, (float)((7 * r + 3 * c) % 5) * 0.2f, (float)r};
  for (uint32_t r = 0; r + 1 < SIDE; r++)
    for (uint32_t c = 0; c + 1 < SIDE; c++) {
      uint32_t a = r * SIDE + c, corners[6] = {a, a + SIDE, a + 1, a + 1, a + SIDE, a + SIDE + 1};
      for (int i = 0; i < 6; i++) triangles[n++] = corners[i];
    }
}

START_TEST(heights_and_normals_are_those_of_the_triangles)
{
  make();
  sbr_ground_mesh *mesh;
  ck_assert_int_eq(
      sbr_ground_mesh_create(NULL, points, POINTS, triangles, TRIANGLES, -1, &mesh, NULL), SBF_OK);
  sbr_ground g = sbr_ground_from_mesh(mesh);
  sbf_vec3 normal;
  for (uint32_t i = 0; i < POINTS; i++)
    ck_assert_double_eq_tol(
        g.height(&g, (double)points[i].x, (double)points[i].z, &normal), (double)points[i].y, 1e-6);
  double x = 3.25, z = 7.5, d = 1e-4, y = g.height(&g, x, z, &normal);
  sbf_vec3 unused;
  double along = (g.height(&g, x + d, z, &unused) - y) / d;
  ck_assert_double_eq_tol(along, -(double)normal.x / (double)normal.y, 1e-4);
  ck_assert_double_eq(g.height(&g, -3, 5, &normal), -1);
  ck_assert_double_eq(g.height(&g, 3, 50, &normal), -1);
  sbr_ground_mesh_destroy(mesh);
}
END_TEST

START_TEST(the_highest_of_two_floors_counts)
{
  static const sbf_vec3 p[6] = {{0, 0, 0}, {0, 0, 4}, {4, 0, 0}, {0, 2, 0}, {0, 2, 1}, {1, 2, 0}};
  static const uint32_t t[6] = {0, 1, 2, 3, 5, 4};
  sbr_ground_mesh *mesh;
  ck_assert_int_eq(sbr_ground_mesh_create(NULL, p, 6, t, 2, 0, &mesh, NULL), SBF_OK);
  sbr_ground g = sbr_ground_from_mesh(mesh);
  sbf_vec3 normal;
  ck_assert_double_eq_tol(g.height(&g, 0.2, 0.2, &normal), 2, 1e-6);
  ck_assert_float_gt(normal.y, 0.99f); /* upwards, whichever way it is wound */
  ck_assert_double_eq_tol(g.height(&g, 1, 1, &normal), 0, 1e-6);
  sbr_ground_mesh_destroy(mesh);
}
END_TEST

START_TEST(bad_calls_and_little_memory_are_refused)
{
  make();
  sbr_ground_mesh *mesh;
  uint32_t bad[3] = {0, 1, 99999};
  ck_assert_int_eq(sbr_ground_mesh_create(NULL, points, POINTS, bad, 1, 0, &mesh, NULL), SBF_FAILED);
  for (size_t allowed = 0; allowed < 3; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    ck_assert_int_eq(
        sbr_ground_mesh_create(&memory.allocator, points, POINTS, triangles, TRIANGLES, 0, &mesh, NULL),
        SBF_FAILED);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("ground_mesh");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, heights_and_normals_are_those_of_the_triangles);
  tcase_add_test(tests, the_highest_of_two_floors_counts);
  tcase_add_test(tests, bad_calls_and_little_memory_are_refused);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
