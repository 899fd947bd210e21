#include "mechanics/plausible_size.h"

#include <math.h>

#include "harness.h"
#include "shapes.h"

START_TEST(sizes)
{
  static const struct {
    double size_m, scale;
  } rows[] = {{1.8, 1}, {0.005, 1}, {30, 1}, {0, 1}, {INFINITY, 1}, {-3, 1}, {NAN, 1}, {154.7, 0.01},
      {1800, 0.01}, {3500, 0.001}, {30.1, 0.01}, {2.9e9, 1e-8}, {0.0049, 100}, {0.0018, 100}, {1.6e-5, 1000}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    ck_assert_double_eq_tol(sbfi_plausible_scale(rows[i].size_m), rows[i].scale, 1e-9 * rows[i].scale);
}
END_TEST

START_TEST(extents)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  ck_assert_double_eq(sbfi_asset_extent(asset), 0);
  sbf_polygon_mesh bar = shape_bar(asset, 8, 2, 1.6f, 0.4f);
  shape_add_body(asset, "bar", &bar, false);
  ck_assert_double_eq_tol(sbfi_asset_extent(asset), 1.6, 1e-6);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *s = suite_create("plausible_size");
  TCase *c = tcase_create("plausible_size");
  tcase_add_test(c, sizes);
  tcase_add_test(c, extents);
  suite_add_tcase(s, c);
  return harness_run(s);
}
