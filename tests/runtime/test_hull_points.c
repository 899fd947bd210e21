/* Hulls of points: they contain every point, are convex and closed. Flat point sets are reported. */
#include "shapes/hull_points.h"

#include <math.h>

#include "harness.h"
#include "shapes/shape.h"

enum { MAX = 2000 };
static sbf_vec3 points[MAX];
static uint32_t random_state;

/* From -1 to 1. */
static float random_number(void) {
  random_state = random_state * 1664525u + 1013904223u;
  return (float)(random_state >> 8) / 8388608.0f - 1;
}

static sbri_point_hull hull_of(uint32_t count, sbfi_arena *arena) {
  static sbf_allocator allocator;
  sbri_point_hull hull;
  allocator = sbfi_allocator_or_default(NULL);
  sbfi_arena_init(arena, &allocator, 0);
  ck_assert(sbri_hull_of_points(&hull, points, count, arena));
  return hull;
}

/* Distance of a point outside a side's plane, m, in double precision. */
static double outside_of(const sbri_point_hull *hull, uint32_t side, sbf_vec3 x) {
  double p[3][3], n[3], size;
  for (int i = 0; i < 3; i++) {
    sbf_vec3 at = hull->vertices[hull->corners[3 * side + (uint32_t)i]];
    p[i][0] = (double)at.x, p[i][1] = (double)at.y, p[i][2] = (double)at.z;
  }
  for (int k = 0; k < 3; k++) {
    int a = (k + 1) % 3, b = (k + 2) % 3;
    n[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) - (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
  }
  size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  ck_assert_double_gt(size, 0);
  return (n[0] * ((double)x.x - p[0][0]) + n[1] * ((double)x.y - p[0][1]) + n[2] * ((double)x.z - p[0][2])) /
         size;
}

/* Every edge has its opposite. No vertex is outside any side by more than double rounding, no input point by
 * more than `within`. */
static void expect_around(const sbri_point_hull *hull, uint32_t count, double size, double within) {
  ck_assert_uint_eq(hull->triangle_count, 2 * hull->vertex_count - 4);
  for (uint32_t s = 0; s < hull->triangle_count; s++) {
    for (uint32_t i = 0; i < hull->vertex_count; i++)
      ck_assert_double_le(outside_of(hull, s, hull->vertices[i]), 1e-12 * size);
    for (uint32_t i = 0; i < count; i++) ck_assert_double_le(outside_of(hull, s, points[i]), within);
    for (uint32_t e = 0; e < 3; e++) {
      uint32_t a = hull->corners[3 * s + e], b = hull->corners[3 * s + (e + 1) % 3], found = 0;
      for (uint32_t k = 0; k < 3 * hull->triangle_count; k++)
        found += hull->corners[k] == b && hull->corners[k - k % 3 + (k + 1) % 3] == a;
      ck_assert_uint_eq(found, 1);
    }
  }
}

/* A cube as 11 points an edge, each twice, and a few inside: all in its planes and lines. */
START_TEST(points_in_planes_and_twice)
{
  uint32_t count = 0;
  sbfi_arena arena;
  for (int x = 0; x <= 10; x += _i)
    for (int y = 0; y <= 10; y += _i)
      for (int z = 0; z <= 10; z += _i)
        if (x % 10 == 0 || y % 10 == 0 || z % 10 == 0)
          points[count++] = sbri_vec3(0.1f * (float)x, 0.1f * (float)y, 0.1f * (float)z);
  for (uint32_t i = 0, once = count; i < once; i++) points[count++] = points[i];
  sbri_point_hull hull = hull_of(count, &arena);
  expect_around(&hull, count, 1, 1e-6);
  double volume = 0;
  for (uint32_t s = 0; s < hull.triangle_count; s++) {
    const uint32_t *c = &hull.corners[3 * s];
    volume += (double)sbri_dot(hull.vertices[c[0]], sbri_cross(hull.vertices[c[1]], hull.vertices[c[2]])) / 6;
  }
  ck_assert_double_eq_tol(volume, 1, 1e-5);
  sbfi_arena_free(&arena);
}
END_TEST

/* Balls, plates, needles, noise upon planes, far from the origin, of a micrometre and of a kilometre. */
START_TEST(clouds)
{
  random_state = (uint32_t)_i;
  float size = _i % 3 == 0 ? 1e-6f : _i % 3 == 1 ? 1 : 1000, off = _i % 5 ? 0 : 30 * size;
  float thin = _i % 4 == 0 ? 1e-4f : 1;
  uint32_t count = 4 + (uint32_t)_i * 2;
  sbfi_arena arena;
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 at = sbri_vec3(random_number(), random_number(), random_number());
    if (_i % 7 == 1) at = sbri_normalize(at, at);
    if (_i % 7 == 2) at = sbri_vec3(at.x > 0 ? 1 : -1, at.y, 0.00001f * at.z + (i % 2 ? 1 : -1));
    points[i] = sbri_vec3(size * at.x + off, size * at.y * thin, size * at.z * (_i % 8 ? 1 : thin));
  }
  sbri_point_hull hull = hull_of(count, &arena);
  expect_around(&hull, count, (double)size, 3e-6 * (double)size);
  sbfi_arena_free(&arena);
}
END_TEST

/* Of 2,000 points of a ball 256 are vertices, and none of the others stands out by more than a fiftieth. */
START_TEST(many_points)
{
  sbfi_arena arena;
  random_state = 1;
  for (uint32_t i = 0; i < MAX; i++) {
    sbf_vec3 at = sbri_vec3(random_number(), random_number(), random_number());
    points[i] = sbri_normalize(at, at);
  }
  sbri_point_hull hull = hull_of(MAX, &arena);
  ck_assert_uint_eq(hull.vertex_count, SBRI_HULL_VERTICES);
  expect_around(&hull, MAX, 1, 0.02);
  sbfi_arena_free(&arena);
}
END_TEST

/* One place, a line, a plane askew. */
START_TEST(flat_point_sets_have_no_hull)
{
  const sbf_vec3 along[3][2] = {{{0, 0, 0}, {0, 0, 0}}, {{1, 2, 3}, {0, 0, 0}}, {{1, 2, 3}, {3, -1, 0}}};
  sbr_shape_definition d = sbr_default_shape_definition();
  sbr_shape *shape = NULL;
  sbf_diagnostic error;
  d.kind = SBR_SHAPE_HULL, d.points = points, d.point_count = 20;
  for (uint32_t i = 0; i < 20; i++)
    points[i] = sbri_add(sbri_scale(along[_i][0], (float)(i % 5)), sbri_scale(along[_i][1], (float)(i % 3)));
  ck_assert(sbr_shape_create(NULL, &d, &shape, &error) != SBF_OK);
  ck_assert_msg(strstr(error.message, "in one plane"), "%s", error.message);
  points[7].y = NAN;
  ck_assert(sbr_shape_create(NULL, &d, &shape, &error) != SBF_OK);
  ck_assert_msg(strstr(error.message, "a point"), "%s", error.message);
  ck_assert_ptr_null(shape);
}
END_TEST

/* Tilted boxes with faces and edges roughened by a tenth of a micrometre to a millimetre: sides are long and
 * narrow, some remove earlier hull vertices, and their planes would tilt in single precision. No plane of the
 * shape cuts off a vertex of it. */
static void expect_ragged(uint32_t seed) {
  sbr_shape_definition d = sbr_default_shape_definition();
  sbr_shape *shape = NULL;
  d.kind = SBR_SHAPE_HULL, d.points = points, d.point_count = 200;
  random_state = 77 * seed + 1;
  sbf_vec3 a = sbri_vec3(random_number(), random_number(), random_number()), b = sbri_vec3(-a.y, a.x, 0);
  a = sbri_normalize(a, a), b = sbri_normalize(b, b);
  sbf_vec3 c = sbri_cross(a, b);
  float ragged = powf(10, -5 + 2 * random_number());
  for (uint32_t i = 0; i < 200; i++) {
    float u = i < 8 ? (i & 4 ? 1.0f : -1.0f) : random_number();
    sbf_vec3 at =
        sbri_add_scaled(sbri_scale(a, 0.75f * u), b, (i & 1 ? 0.5f : -0.5f) + ragged * random_number());
    points[i] = sbri_add_scaled(at, c, (i & 2 ? 0.1f : -0.1f) + ragged * random_number());
  }
  ck_assert(sbr_shape_create(NULL, &d, &shape, NULL) == SBF_OK);
  ck_assert_uint_eq(shape->hull.face_count, 2 * shape->hull.vertex_count - 4);
  for (uint32_t f = 0; f < shape->hull.face_count; f++)
    for (uint32_t v = 0; v < shape->hull.vertex_count; v++) {
      const sbri_hull_face *face = &shape->hull.faces[f];
      ck_assert_float_le(sbri_dot(face->normal, shape->hull.vertices[v]) - face->offset, 5e-5f);
    }
  sbr_shape_destroy(shape);
}

START_TEST(ragged_boxes)
{
  for (uint32_t seed = 0; seed < 300; seed++) expect_ragged(seed);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("hull of points");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, points_in_planes_and_twice, 1, 3);
  tcase_add_loop_test(tests, clouds, 0, 60);
  tcase_add_test(tests, many_points);
  tcase_add_loop_test(tests, flat_point_sets_have_no_hull, 0, 3);
  tcase_add_test(tests, ragged_boxes);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
