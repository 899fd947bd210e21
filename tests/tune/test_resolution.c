/* Motions in which the reference is too coarse are not measured. */
#include "harness.h"
#include "pudding_meshes.h"
#include "tune/comparison.h"
#include "tune/tuned_meshes.h"

static tune_meshes meshes;
static tune_comparison comparison;

static void setup(void) {
  const tune_grid grid = {.sizes = {60}, .size_count = 1, .reference = 120, .calibrated_alone = true};
  make_pudding_meshes(&meshes, &grid);
  compare_to_reference(&meshes, &comparison);
}
static void teardown(void) {
  tune_comparison_free(&comparison);
  tune_meshes_free(&meshes);
}

static uint32_t count_measured(void) {
  uint32_t count = 0;
  for (int i = 0; i < CHART_BUNDLE_CASES; i++) count += !comparison.unmeasured[i][0];
  return count;
}

START_TEST(equal_lattices_exclude_nothing)
{
  sbf_diagnostic error;
  uint32_t before = count_measured();
  ck_assert_uint_gt(before, 0);
  ck_assert_int_eq(tune_comparison_check_resolution(&comparison, meshes.reference.asset, &error), SBF_OK);
  ck_assert_uint_eq(count_measured(), before);
}
END_TEST

/* A lattice of a tenth of the modulus stands for one that has not converged. */
START_TEST(differing_lattices_exclude_the_motion_by_name)
{
  sbf_diagnostic error;
  tune_error is;
  sbf_asset *soft = sbf_asset_clone(meshes.reference.asset, NULL);
  for (uint32_t b = 0; b < soft->soft_bodies.count; b++) {
    const sbf_f32_list *moduli = &soft->soft_bodies.at[b].levels.at[0].lattice.young_modulus;
    for (uint32_t i = 0; i < moduli->count; i++) ((float *)(uintptr_t)moduli->at)[i] *= 0.1f;
  }
  ck_assert_int_eq(tune_comparison_check_resolution(&comparison, soft, &error), SBF_OK);
  ck_assert_uint_eq(count_measured(), 0);
  for (int i = 0; i < CHART_BUNDLE_CASES; i++)
    ck_assert_ptr_nonnull(strstr(comparison.unmeasured[i], "half"));
  /* What is not measured must still be valid. */
  ck_assert_int_eq(tune_comparison_measure(
                       &comparison, meshes.reference.asset, &(chart_setting){.level = 0}, NULL, &is, &error),
      SBF_OK);
  ck_assert(is.sound);
  ck_assert_double_eq(is.off.max_m, 0);
  sbf_asset_free(soft);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("resolution");
  TCase *c = tcase_create("resolution");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, equal_lattices_exclude_nothing);
  tcase_add_test(c, differing_lattices_exclude_the_motion_by_name);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
