#include "pudding_meshes.h"

#include "harness.h"
#include "sbfmt/convert.h"

void make_pudding_meshes(tune_meshes *meshes, const tune_grid *grid) {
  sbf_asset *asset;
  sbf_diagnostic error;
  sbf_status status = sbf_convert(harness_source("examples/pudding/pudding.glb"), NULL, &asset, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  status = tune_meshes_make(asset, grid, meshes, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  sbf_asset_free(asset);
}

void compare_to_reference(const tune_meshes *meshes, tune_comparison *comparison) {
  sbf_diagnostic error;
  sbf_status status = tune_comparison_create(
      comparison, meshes->reference.asset, &(tune_measure){.by = TUNE_BY_P99, .once = true}, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
}
