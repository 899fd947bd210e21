/* Clips of another skeleton, like `convert --motion`, for hosts that have both assets loaded. */
#include "motion/retargeting.h"
#include "sbrun/animation.h"

sbf_status sbr_asset_retarget_clips(sbf_asset *asset, const sbf_asset *from, const char *name,
    void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user, sbf_diagnostic *error) {
  if (!asset || !from)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_asset_retarget_clips needs two assets");
  sbfi_reporter reporter = {report, user, 0, 0};
  return sbfi_retarget_clips(asset, from, name ? name : "", NULL, &reporter, error);
}
