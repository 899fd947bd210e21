#include <math.h>

#include "legs.h"
#include "validate/rules/bone_chain.h"

enum { BODY_BONE, LEFT, LEFT_SHIN, LEFT_FOOT, RIGHT };

START_TEST(test_runs)
{
  sbf_asset *asset = rules_load(LEGS, false);
  ck_assert(sbfi_bone_is_descendant(asset, LEFT_FOOT, BODY_BONE));
  ck_assert(sbfi_bone_is_descendant(asset, LEFT, LEFT));
  ck_assert(!sbfi_bone_is_descendant(asset, RIGHT, LEFT));
  ck_assert(!sbfi_bone_is_descendant(asset, BODY_BONE, LEFT));
  sbfi_bone_run run = sbfi_bone_run_of(asset, LEFT, LEFT_FOOT);
  ck_assert(run.whole);
  ck_assert_uint_eq(run.count, 3);
  ck_assert(fabs(run.reach - 2 * sqrt(0.065)) < 1e-6);
  ck_assert(fabs(run.off_line - 0.05) < 1e-6);
  ck_assert(fabs(run.head_to_end - 0.5) < 1e-6);
  ck_assert(!sbfi_bone_run_of(asset, RIGHT, LEFT_FOOT).whole);
  run = sbfi_bone_run_of(asset, LEFT, LEFT);
  ck_assert(run.whole && run.count == 1 && run.reach == 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_distance_from_a_line)
{
  sbf_asset *asset = rules_load(LEGS, false);
  sbf_vec3 position = {0.1f, 7, 0.25f};
  ck_assert(fabs(sbfi_distance_from_line(asset, LEFT, LEFT_FOOT, position) - 0.25) < 1e-6);
  ck_assert(fabs(sbfi_distance_from_line(asset, LEFT, LEFT, position) - sqrt(6.5 * 6.5 + 0.0625)) < 1e-6);
  sbf_asset_free(asset);
}
END_TEST

RULES_MAIN("bone_chain", test_runs, test_distance_from_a_line)
