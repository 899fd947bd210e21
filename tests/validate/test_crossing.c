#include <math.h>
#include <stdlib.h>

#include "rules.h"
#include "shapes.h"
#include "validate/rules/crossing.h"

static sbfi_arena arena;
static sbf_asset *asset;

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
  asset = sbf_asset_create(NULL);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static uint32_t crossing_count(const sbf_polygon_mesh *mesh) {
  uint32_t *partners = calloc(mesh->polygon_sizes.count, sizeof *partners), count = 0;
  ck_assert(sbfi_crossings_find(mesh, partners, &arena));
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) {
    if (partners[p] == SBFI_NO_CROSSING) continue;
    ck_assert_uint_gt(partners[p], p);
    ck_assert_uint_lt(partners[p], mesh->polygon_sizes.count);
    count++;
  }
  free(partners);
  return count;
}

/* Triangles with points of their own. */
static sbf_polygon_mesh soup(const float *positions, uint32_t triangles) {
  sbf_vec3 *points = sbf_asset_allocate(asset, 3 * triangles, sizeof *points);
  uint32_t *sizes = sbf_asset_allocate(asset, triangles, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(asset, 3 * triangles, sizeof *corners);
  for (uint32_t i = 0; i < 3 * triangles; i++) {
    points[i] = (sbf_vec3){positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
    corners[i] = i;
    sizes[i / 3] = 3;
  }
  return (sbf_polygon_mesh){.positions = {points, 3 * triangles},
      .polygon_sizes = {sizes, triangles},
      .polygon_points = {corners, 3 * triangles}};
}

START_TEST(test_closed_surfaces_do_not_cross)
{
  setup();
  sbf_polygon_mesh cube = shape_cube(asset, 8, 1, (sbf_vec3){3, 4, 5});
  ck_assert_uint_eq(crossing_count(&cube), 0);
  sbf_polygon_mesh triangles = shape_triangulated(asset, &cube);
  ck_assert_uint_eq(crossing_count(&triangles), 0);
  teardown();
}
END_TEST

START_TEST(test_two_triangles)
{
  static const struct {
    float positions[18];
    uint32_t crossings;
  } cases[] = {
      {{0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5f, 0.5f, -1, 0.5f, 0.5f, 1, 2, 2, 1},
          1},                                                                  /* a side through the inside */
      {{0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5f, 0.5f, 0, 0.5f, 0.5f, 1, 2, 2, 1}, 0}, /* a corner on it */
      {{0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5f, 0.5f, 0.1f, 0.5f, 0.5f, 1, 2, 2, 1}, 0}, /* above it */
      {{0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5f, 0.5f, 0, 1, 0.5f, 0, 0.5f, 1, 0}, 0},    /* in its plane */
      {{0, 0, 0, 2, 0, 0, 0, 2, 0, 3, 0, -1, 3, 0, 1, 4, 0, 0}, 0},               /* beside it */
      {{0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 0, -1, 1, 0, 1, 1, -1, 0}, 0},              /* through its side */
      {{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 0, 1, 1, -1, 1, 0.5f, 1}, 1}, /* a corner in common, and through */
  };
  setup();
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    sbf_polygon_mesh mesh = soup(cases[i].positions, 2);
    ck_assert_msg(crossing_count(&mesh) == cases[i].crossings, "case %zu", i);
  }
  teardown();
}
END_TEST

START_TEST(test_one_polygon_has_no_self_crossing)
{
  setup();
  static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  sbf_polygon_mesh mesh = soup(positions, 1);
  ck_assert_uint_eq(crossing_count(&mesh), 0);
  mesh.polygon_sizes.count = 0;
  mesh.polygon_points.count = 0;
  ck_assert_uint_eq(crossing_count(&mesh), 0);
  teardown();
}
END_TEST

/* Against every pair, with a test of its own: the tree must not lose any. */
static bool segment_pierces(const sbf_vec3 *t, sbf_vec3 from, sbf_vec3 to) {
  double d[3] = {(double)to.x - from.x, (double)to.y - from.y, (double)to.z - from.z}, v[3];
  for (int k = 0; k < 3; k++) {
    sbf_vec3 a = t[k], b = t[(k + 1) % 3];
    double p[3] = {(double)a.x - from.x, (double)a.y - from.y, (double)a.z - from.z};
    double q[3] = {(double)b.x - from.x, (double)b.y - from.y, (double)b.z - from.z};
    v[k] = d[0] * (p[1] * q[2] - p[2] * q[1]) + d[1] * (p[2] * q[0] - p[0] * q[2]) +
           d[2] * (p[0] * q[1] - p[1] * q[0]);
  }
  if (!((v[0] > 0 && v[1] > 0 && v[2] > 0) || (v[0] < 0 && v[1] < 0 && v[2] < 0))) return false;
  double u[3] = {(double)t[1].x - t[0].x, (double)t[1].y - t[0].y, (double)t[1].z - t[0].z};
  double w[3] = {(double)t[2].x - t[0].x, (double)t[2].y - t[0].y, (double)t[2].z - t[0].z};
  double n[3] = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
  double h0 =
      n[0] * ((double)from.x - t[0].x) + n[1] * ((double)from.y - t[0].y) + n[2] * ((double)from.z - t[0].z);
  double h1 =
      n[0] * ((double)to.x - t[0].x) + n[1] * ((double)to.y - t[0].y) + n[2] * ((double)to.z - t[0].z);
  return h0 * h1 < 0;
}

START_TEST(test_counts_equal_those_of_brute_force)
{
  enum { TRIANGLES = 300 };
  static float positions[9 * TRIANGLES];
  uint32_t seed = 7, expected = 0;
  setup();
  for (int i = 0; i < TRIANGLES; i++) {
    float middle[3];
    for (int k = 0; k < 3; k++) middle[k] = (float)((seed = seed * 1664525 + 1013904223) >> 8) / (1 << 24);
    for (int k = 0; k < 9; k++)
      positions[9 * i + k] =
          middle[k % 3] + 0.2f * (float)((seed = seed * 1664525 + 1013904223) >> 8) / (1 << 24);
  }
  sbf_polygon_mesh mesh = soup(positions, TRIANGLES);
  for (int i = 0; i < TRIANGLES; i++) {
    bool crosses = false;
    for (int j = i + 1; j < TRIANGLES && !crosses; j++)
      for (int k = 0; k < 3; k++) {
        const sbf_vec3 *a = mesh.positions.at + 3 * i, *b = mesh.positions.at + 3 * j;
        crosses |= segment_pierces(a, b[k], b[(k + 1) % 3]) || segment_pierces(b, a[k], a[(k + 1) % 3]);
      }
    expected += crosses;
  }
  ck_assert_uint_gt(expected, 20);
  ck_assert_uint_eq(crossing_count(&mesh), expected);
  teardown();
}
END_TEST

/* Every triangle through every other: it must end in time, and say so. */
START_TEST(test_crowded)
{
  enum { TRIANGLES = 3000 };
  static float positions[9 * TRIANGLES];
  setup();
  for (int i = 0; i < TRIANGLES; i++) {
    double angle = 6.28318 * i / TRIANGLES, far = 1 + 0.1 * (i % 7);
    const double corners[9] = {far * cos(angle), far * sin(angle), 0.01 * (i % 5) - 1, -far * cos(angle),
        -far * sin(angle), -1, 0, 0, 1};
    for (int k = 0; k < 9; k++) positions[9 * i + k] = (float)corners[k];
  }
  sbf_polygon_mesh mesh = soup(positions, TRIANGLES);
  ck_assert_uint_gt(crossing_count(&mesh), 100);
  teardown();
}
END_TEST

START_TEST(test_enclosed)
{
  setup();
  sbf_polygon_mesh cube = shape_cube(asset, 4, 2, (sbf_vec3){0, 0, 0});
  sbfi_triangle_tree tree;
  ck_assert(sbfi_triangle_tree_build(&tree, &cube, &arena));
  for (float x = -1.9f; x < 2; x += 0.2f)
    for (float y = -1.9f; y < 2; y += 0.2f) {
      bool inside = fabsf(x) < 1 && fabsf(y) < 1;
      ck_assert_int_eq(sbfi_surface_encloses(&tree, (sbf_vec3){x, y, 0.3f}), inside);
      ck_assert(!sbfi_surface_encloses(&tree, (sbf_vec3){x, y, -1.5f}));
    }
  teardown();
}
END_TEST

RULES_MAIN("crossing", test_closed_surfaces_do_not_cross, test_two_triangles,
    test_one_polygon_has_no_self_crossing, test_counts_equal_those_of_brute_force, test_crowded,
    test_enclosed)
