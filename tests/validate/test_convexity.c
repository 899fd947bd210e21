#include <math.h>

#include "rules.h"
#include "shapes.h"
#include "validate/rules/convexity.h"

static sbfi_hull_fault check(const sbf_polygon_mesh *hull) {
  sbfi_arena arena;
  sbfi_arena_init(&arena, NULL, 0);
  sbfi_hull_fault fault = sbfi_hull_check(hull, &arena);
  sbfi_arena_free(&arena);
  return fault;
}

START_TEST(test_boxes)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_polygon_mesh cube = shape_cube(asset, 3, 2, (sbf_vec3){5, 5, 5});
  ck_assert_int_eq(check(&cube), SBFI_HULL_FAULT_NONE);
  sbf_vec3 *points = (sbf_vec3 *)(uintptr_t)cube.positions.at;
  sbf_vec3 kept = points[0];
  points[0] = (sbf_vec3){5, 5, 5}; /* a corner pushed to the middle */
  ck_assert_int_eq(check(&cube), SBFI_HULL_FAULT_CONCAVE);
  points[0] = (sbf_vec3){kept.x + 1e-4f, kept.y, kept.z}; /* less than counts */
  ck_assert_int_eq(check(&cube), SBFI_HULL_FAULT_NONE);
  points[0] = kept;
  cube.polygon_sizes.count--;
  cube.polygon_points.count -= 4;
  ck_assert_int_eq(check(&cube), SBFI_HULL_FAULT_OPEN);
  sbf_asset_free(asset);
}
END_TEST

/* More corners than are compared one by one: 6 n^2 faces and points. */
START_TEST(test_large_hulls)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_polygon_mesh ball = shape_cube(asset, 22, 2, (sbf_vec3){0, 0, 0});
  sbf_vec3 *points = (sbf_vec3 *)(uintptr_t)ball.positions.at;
  ck_assert_uint_gt((uint64_t)ball.positions.count * ball.polygon_sizes.count, 4000000);
  for (uint32_t i = 0; i < ball.positions.count; i++) {
    float length = sqrtf(points[i].x * points[i].x + points[i].y * points[i].y + points[i].z * points[i].z);
    points[i] = (sbf_vec3){points[i].x / length, points[i].y / length, points[i].z / length};
  }
  ck_assert_int_eq(check(&ball), SBFI_HULL_FAULT_NONE);
  points[100] = (sbf_vec3){points[100].x * 0.9f, points[100].y * 0.9f, points[100].z * 0.9f};
  ck_assert_int_eq(check(&ball), SBFI_HULL_FAULT_CONCAVE);
  sbf_asset_free(asset);
}
END_TEST

RULES_MAIN("convexity", test_boxes, test_large_hulls)
