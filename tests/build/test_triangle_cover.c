#include "build/geometry/triangle_cover.h"

#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;
static sbfi_triangle_tree tree;

/* A sheet of 4 x 4 unit quads in the plane y = 0. */
static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
  sbf_polygon_mesh sheet = shape_sheet(asset, 4, 4);
  ck_assert(sbfi_triangle_tree_build(&tree, &sheet, &arena));
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static bool covered(sbf_vec3 a, sbf_vec3 b, sbf_vec3 c, double max) {
  const double corners[3][3] = {{(double)a.x, (double)a.y, (double)a.z},
      {(double)b.x, (double)b.y, (double)b.z}, {(double)c.x, (double)c.y, (double)c.z}};
  return sbfi_triangle_is_covered(&tree, corners, max);
}

START_TEST(over_many_triangles)
{
  float x0 = tree.positions[0].x, z0 = tree.positions[0].z;
  sbf_vec3 a = {x0 + 0.3f, 0.01f, z0 + 0.2f}, b = {x0 + 1.1f, 0.01f, z0 + 3.9f},
           c = {x0 + 3.7f, 0.01f, z0 + 0.9f};
  bool up = covered(a, b, c, 0.02), down = covered(a, c, b, 0.02);
  ck_assert(up != down); /* one of them faces as the sheet does */
  if (down) {
    sbf_vec3 swap = b;
    b = c;
    c = swap;
  }
  ck_assert(covered(a, b, c, 0.0101));
  ck_assert(!covered(a, b, c, 0.0099)); /* too far away */
  c.x = b.x = x0 + 4.2f;                /* beyond the rim */
  ck_assert(!covered(a, b, c, 0.02));
}
END_TEST

START_TEST(no_area)
{
  sbf_vec3 a = {0, 0, 0}, b = {1, 0, 1};
  ck_assert(!covered(a, b, b, 1));
  ck_assert(!covered(a, a, a, 1));
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("triangle_cover");
  TCase *c = tcase_create("triangle_cover");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, over_many_triangles);
  tcase_add_test(c, no_area);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
