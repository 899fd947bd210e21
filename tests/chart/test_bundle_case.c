/* How a character is driven for a chart: as stated up to 2 m, slower above. */
#include "chart/bundle_case.h"

#include <math.h>

#include "chart/subject.h"
#include "harness.h"

/* A mass on a spring of 1 m, scaled. */
static sbf_asset *of_size(float size_m) {
  sbf_asset *asset = chart_mass_on_spring(1, 100);
  ck_assert_ptr_nonnull(asset);
  sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)asset->soft_bodies.at; /* the test's own */
  sbf_level *level = (sbf_level *)(uintptr_t)body->levels.at;
  for (uint32_t i = 0; i < level->positions.count; i++) {
    sbf_vec3 *p = (sbf_vec3 *)(uintptr_t)&level->positions.at[i];
    *p = (sbf_vec3){p->x * size_m, p->y * size_m, p->z * size_m};
  }
  for (uint32_t i = 0; i < body->surface.positions.count; i++) {
    sbf_vec3 *p = (sbf_vec3 *)(uintptr_t)&body->surface.positions.at[i];
    *p = (sbf_vec3){p->x * size_m, p->y * size_m, p->z * size_m};
  }
  return asset;
}

static chart_drive drive_of(float size_m) {
  chart_bundle bundle;
  chart_case cases[CHART_BUNDLE_CASES];
  sbf_diagnostic error;
  sbf_asset *asset = of_size(size_m);
  ck_assert_int_eq(chart_bundle_cases(asset, NULL, &bundle, cases, &error), SBF_OK);
  sbf_asset_free(asset);
  return bundle.drive;
}

START_TEST(small_ones_are_driven_as_stated)
{
  const float sizes[] = {0.1f, 1, 2};
  chart_drive drive = drive_of(sizes[_i]);
  ck_assert_float_eq(drive.turn_rad_s, chart_usual_drive.turn_rad_s);
  for (int i = 0; i < 2; i++) {
    ck_assert_uint_eq(drive.turn_ticks[i], chart_usual_drive.turn_ticks[i]);
    ck_assert_uint_eq(drive.hop_ticks[i], chart_usual_drive.hop_ticks[i]);
  }
}
END_TEST

START_TEST(rotation_and_hops_slow_by_the_root_of_size)
{
  chart_drive drive = drive_of(8);
  ck_assert_float_eq_tol(drive.turn_rad_s, chart_usual_drive.turn_rad_s / 2, 1e-6f);
  for (int i = 0; i < 2; i++) {
    ck_assert_uint_eq(drive.turn_ticks[i], 2 * chart_usual_drive.turn_ticks[i]);
    ck_assert_uint_eq(drive.hop_ticks[i], 2 * chart_usual_drive.hop_ticks[i]);
  }
  ck_assert_double_eq(drive.speed, chart_usual_drive.speed);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("bundle_case");
  TCase *c = tcase_create("bundle_case");
  tcase_add_loop_test(c, small_ones_are_driven_as_stated, 0, 3);
  tcase_add_test(c, rotation_and_hops_slow_by_the_root_of_size);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
