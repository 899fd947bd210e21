/* A fit finds the stiffness with which a mesh moves as its reference. */
#include "tune/fitted_mesh.h"

#include "harness.h"
#include "pudding_meshes.h"

static tune_meshes meshes;
static tune_comparison comparison;

static void setup(void) {
  const tune_grid grid = {.sizes = {60}, .size_count = 1, .reference = 250, .calibrated_alone = true};
  make_pudding_meshes(&meshes, &grid);
  ck_assert(tune_meshes_trust_own(&meshes));
  compare_to_reference(&meshes, &comparison);
}
static void teardown(void) {
  tune_comparison_free(&comparison);
  tune_meshes_free(&meshes);
}

static sbf_level *level_of(const sbf_asset *asset) {
  return (sbf_level *)(uintptr_t)asset->soft_bodies.at[0].levels.at;
}

static void soften(const sbf_asset *asset, float factor) {
  const sbf_level *level = level_of(asset);
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].stiffness.count; i++)
      ((float *)(uintptr_t)level->springs.at[s].stiffness.at)[i] *= factor;
  for (uint32_t p = 0; p < level->pins.count; p++)
    ((sbf_pin_set *)(uintptr_t)level->pins.at)[p].stiffness *= factor;
}

/* Of the first body, relative to the file. */
static double factor_of(const sbf_asset *asset) {
  const sbf_f32_list *is = &level_of(asset)->springs.at[0].stiffness,
                     *was = &level_of(meshes.at[0].asset)->springs.at[0].stiffness;
  ck_assert_uint_gt(is->count, 0);
  for (uint32_t i = 1; i < is->count; i++)
    ck_assert_float_eq_tol(is->at[i] / was->at[i], is->at[0] / was->at[0], 1e-5f);
  return (double)(is->at[0] / was->at[0]);
}

static sbf_status fit(const tune_mesh *mesh, tune_mesh *fitted, sbf_diagnostic *error) {
  return tune_fit_mesh(mesh, &(tune_fit){.drives = {&comparison}, .drive_count = 1}, fitted, error);
}

START_TEST(a_softened_mesh_gets_its_stiffness_back)
{
  tune_mesh soft = meshes.at[0], fitted;
  sbf_diagnostic error;
  tune_error before, after;
  const chart_setting setting = {.level = 0};
  soft.asset = sbf_asset_clone(meshes.at[0].asset, NULL);
  soften(soft.asset, 0.5f);
  ck_assert_int_eq(fit(&soft, &fitted, &error), SBF_OK);
  ck_assert_ptr_nonnull(fitted.asset);
  ck_assert_double_eq_tol(factor_of(soft.asset), 0.5, 1e-6); /* the fit changes its copy alone */
  ck_assert_double_eq_tol(factor_of(fitted.asset), 1, 0.1);
  ck_assert_int_eq(tune_comparison_measure(&comparison, soft.asset, &setting, NULL, &before, &error), SBF_OK);
  ck_assert_int_eq(
      tune_comparison_measure(&comparison, fitted.asset, &setting, NULL, &after, &error), SBF_OK);
  ck_assert(after.sound);
  ck_assert_double_lt(after.off.p99_m, 0.5 * before.off.p99_m);
  sbf_asset_free(soft.asset);
  sbf_asset_free(fitted.asset);
}
END_TEST

START_TEST(lattices_keep_the_modulus_of_their_material)
{
  tune_mesh fitted;
  sbf_diagnostic error;
  ck_assert_uint_gt(meshes.at[1].asked, 0);
  ck_assert_int_eq(fit(&meshes.at[1], &fitted, &error), SBF_OK);
  ck_assert_ptr_nonnull(fitted.asset);
  const sbf_level *was = meshes.at[1].asset->soft_bodies.at[0].levels.at,
                  *is = fitted.asset->soft_bodies.at[0].levels.at;
  ck_assert_uint_eq(is->lattice.reference_modulus.count, was->lattice.reference_modulus.count);
  ck_assert_ptr_null(is->calibration);
  for (uint32_t i = 0; i < is->lattice.reference_modulus.count; i++)
    ck_assert_float_eq(is->lattice.reference_modulus.at[i], was->lattice.reference_modulus.at[i]);
  ck_assert_float_ne(is->lattice.young_modulus.at[0], was->lattice.young_modulus.at[0]);
  sbf_asset_free(fitted.asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("fitted_mesh");
  TCase *c = tcase_create("fitted_mesh");
  tcase_add_unchecked_fixture(c, setup, teardown);
  tcase_add_test(c, a_softened_mesh_gets_its_stiffness_back);
  tcase_add_test(c, lattices_keep_the_modulus_of_their_material);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
