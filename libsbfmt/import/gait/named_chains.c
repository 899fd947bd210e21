#include "import/gait/named_chains.h"

#include <string.h>

static const char *const leg_names[2] = {"leg_left", "leg_right"};
static const char *const arm_names[2] = {"arm_left", "arm_right"};
static const int sides[2] = {1, -1};

static sbf_u32_list bones_of(const sbf_asset *a, const char *name) {
  for (uint32_t i = 0; i < a->retarget_chains.count; i++)
    if (strcmp(a->retarget_chains.at[i].name, name) == 0) return a->retarget_chains.at[i].bones;
  return (sbf_u32_list){NULL, 0};
}

static bool are_consecutive(const sbf_asset *a, const uint32_t *bones, uint32_t count) {
  for (uint32_t i = 1; i < count; i++)
    if (a->bones.at[bones[i]].parent != (int32_t)bones[i - 1]) return false;
  return true;
}

bool sbfi_has_named_legs(const sbf_asset *asset) {
  for (int i = 0; i < 2; i++) {
    sbf_u32_list bones = bones_of(asset, leg_names[i]);
    if (bones.count < 3 || !are_consecutive(asset, bones.at, 3)) return false;
  }
  return true;
}

bool sbfi_draft_named_legs(sbfi_gait_draft *d) {
  if (!sbfi_has_named_legs(d->asset)) return false;
  for (int i = 0; i < 2; i++) {
    const uint32_t *bones = bones_of(d->asset, leg_names[i]).at;
    int32_t upper = (int32_t)bones[0], lower = (int32_t)bones[1], end = (int32_t)bones[2];
    d->legs[i] = (sbfi_leg_draft){.limb = upper,
        .upper = upper,
        .lower = lower,
        .end = end,
        .toe = SBF_NONE,
        .reach = sbfi_draft_distance(d, upper, lower) + sbfi_draft_distance(d, lower, end),
        .side = d->shapes[upper].side ? d->shapes[upper].side : sides[i]};
  }
  d->leg_count = d->legs[0].reach > 0 && d->legs[1].reach > 0 ? 2 : 0;
  return d->leg_count > 0;
}

uint32_t sbfi_draft_named_arms(const sbf_asset *asset, sbfi_arm_draft arms[2]) {
  for (int i = 0; i < 2; i++) {
    sbf_u32_list bones = bones_of(asset, arm_names[i]);
    if (bones.count < 3) return 0;
    const uint32_t *last = bones.at + bones.count - 3;
    arms[i] = (sbfi_arm_draft){(int32_t)last[0], (int32_t)last[1], (int32_t)last[2], sides[i]};
  }
  return 2;
}

int32_t sbfi_chain_head(const sbf_asset *asset) {
  sbf_u32_list bones = bones_of(asset, "head");
  return bones.count ? (int32_t)bones.at[bones.count - 1] : SBF_NONE;
}
