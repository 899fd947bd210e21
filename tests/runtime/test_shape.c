/* Distances, normals and penetration of every shape, against closed forms. */
#include <math.h>

#include "harness.h"
#include "shapes/shape.h"

static sbr_shape *shape_of(sbr_shape_definition d) {
  sbr_shape *shape = NULL;
  sbf_diagnostic error;
  ck_assert_msg(sbr_shape_create(NULL, &d, &shape, &error) == SBF_OK, "%s", error.message);
  return shape;
}

static void expect(const sbr_shape *s, sbf_vec3 x, float gap, sbf_vec3 normal) {
  sbri_nearest found;
  ck_assert(sbri_shape_nearest(s, x, 10, 10, &found));
  ck_assert_float_eq_tol(found.gap, gap, 1e-5f);
  ck_assert_float_ge(sbri_dot(found.normal, normal), 0.9999f);
  sbf_vec3 back = sbri_add_scaled(found.position, found.normal, found.gap);
  ck_assert_float_le(sbri_length(sbri_sub(back, x)), 1e-4f);
}

static void expect_way(const sbr_shape *s, sbf_vec3 x, sbf_vec3 direction, float fraction, sbf_vec3 normal) {
  float found = -1;
  sbf_vec3 n = {0, 0, 0};
  bool enters = sbri_shape_enter(s, x, direction, &found, &n);
  ck_assert_int_eq(enters, fraction >= 0);
  if (!enters) return;
  ck_assert_float_eq_tol(found, fraction, 1e-5f);
  ck_assert_float_ge(sbri_dot(n, normal), 0.9999f);
}

static const sbf_vec3 x_axis = {1, 0, 0}, y_axis = {0, 1, 0}, down = {0, -4, 0};

START_TEST(round_shapes)
{
  sbr_shape_definition d = sbr_default_shape_definition();
  sbr_shape *s = shape_of(d);
  expect(s, sbri_vec3(2, 0, 0), 1.5f, x_axis);
  expect(s, sbri_vec3(0, 0.25f, 0), -0.25f, y_axis);
  expect_way(s, sbri_vec3(0, 2.5f, 0), down, 0.5f, y_axis);
  expect_way(s, sbri_vec3(0.6f, 2.5f, 0), down, -1, y_axis);
  sbr_shape_destroy(s);
  d.kind = SBR_SHAPE_CAPSULE;
  s = shape_of(d);
  expect(s, sbri_vec3(0, 2, 0), 1, y_axis);
  expect(s, sbri_vec3(2, 0.3f, 0), 1.5f, x_axis);
  expect_way(s, sbri_vec3(0, 3, 0), down, 0.5f, y_axis);
  expect_way(s, sbri_vec3(2, 0.4f, 0), sbri_vec3(-3, 0, 0), 0.5f, x_axis);
  sbr_shape_destroy(s);
  d.kind = SBR_SHAPE_PLANE;
  s = shape_of(d);
  expect(s, sbri_vec3(7, -0.5f, 3), -0.5f, y_axis);
  expect_way(s, sbri_vec3(7, 1, 3), down, 0.25f, y_axis);
  sbr_shape_destroy(s);
}
END_TEST

static const sbf_vec3 corners[8] = {{-0.5f, -0.5f, -0.5f}, {0.5f, -0.5f, -0.5f}, {-0.5f, 0.5f, -0.5f},
    {0.5f, 0.5f, -0.5f}, {-0.5f, -0.5f, 0.5f}, {0.5f, -0.5f, 0.5f}, {-0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}};
static const uint32_t sides[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0,
    4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

/* A cube of a metre as a box, as a hull and as a mesh. */
START_TEST(flat_shapes)
{
  const sbr_shape_kind kinds[3] = {SBR_SHAPE_BOX, SBR_SHAPE_HULL, SBR_SHAPE_MESH};
  sbr_shape_definition d = sbr_default_shape_definition();
  d.points = corners, d.point_count = 8, d.triangles = sides, d.triangle_count = 12;
  d.kind = kinds[_i];
  sbr_shape *s = shape_of(d);
  expect(s, sbri_vec3(0.1f, 2, 0.2f), 1.5f, y_axis);
  expect(s, sbri_vec3(0.4f, 0, 0.1f), -0.1f, x_axis);
  expect(s, sbri_vec3(1.5f, 1.5f, 0), sqrtf(2), sbri_vec3(0.70710678f, 0.70710678f, 0));
  expect_way(s, sbri_vec3(0.1f, 2.5f, 0.2f), down, 0.5f, y_axis);
  expect_way(s, sbri_vec3(0.6f, 2.5f, 0.2f), down, -1, y_axis);
  expect_way(s, sbri_vec3(0.1f, 0.2f, 0.1f), sbri_vec3(0.1f, 0, 0), -1, y_axis);
  sbr_shape_destroy(s);
}
END_TEST

START_TEST(height_fields)
{
  float heights[16];
  for (int i = 0; i < 16; i++) heights[i] = 0.5f * (float)(i % 4);
  sbr_height_field field = {.heights_m = heights, .columns = 4, .rows = 4, .cell_m = 1};
  sbr_shape_definition d = sbr_default_shape_definition();
  d.kind = SBR_SHAPE_HEIGHT_FIELD, d.heights = &field;
  sbr_shape *s = shape_of(d);
  sbf_vec3 n = sbri_normalize(sbri_vec3(-0.5f, 1, 0), y_axis);
  expect(s, sbri_add_scaled(sbri_vec3(1.5f, 0.75f, 1.5f), n, 0.3f), 0.3f, n);
  expect(s, sbri_add_scaled(sbri_vec3(1.5f, 0.75f, 1.5f), n, -0.3f), -0.3f, n);
  expect_way(s, sbri_vec3(1.5f, 2.75f, 1.5f), down, 0.5f, n);
  sbr_shape_destroy(s);
}
END_TEST

START_TEST(bad_definitions_are_refused)
{
  sbr_shape_definition d = sbr_default_shape_definition();
  sbr_shape *s = NULL;
  d.radius = 0;
  ck_assert(sbr_shape_create(NULL, &d, &s, NULL) != SBF_OK);
  d = sbr_default_shape_definition();
  d.kind = SBR_SHAPE_MESH;
  ck_assert(sbr_shape_create(NULL, &d, &s, NULL) != SBF_OK);
  const uint32_t beyond[3] = {0, 1, 8};
  d.points = corners, d.point_count = 8, d.triangles = beyond, d.triangle_count = 1;
  ck_assert(sbr_shape_create(NULL, &d, &s, NULL) != SBF_OK);
  d.kind = SBR_SHAPE_HULL, d.triangles = sides;
  ck_assert(sbr_shape_create(NULL, &d, &s, NULL) != SBF_OK); /* one triangle encloses nothing */
  ck_assert_ptr_null(s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("shape");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, round_shapes);
  tcase_add_loop_test(tests, flat_shapes, 0, 3);
  tcase_add_test(tests, height_fields);
  tcase_add_test(tests, bad_definitions_are_refused);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
