#include "rules.h"

#define PATH "/sbf/soft_body[1]/pins/pin_set[1]/points"

START_TEST(test_repeated)
{
  sbf_asset *asset =
      rules_expect_fix(BODY(TETRA PINS("", "0 1 0",
                           "<offsets>0 0 0 0.2 0 0 0.1 0.1 0.1</offsets><weights>1 0.5 0.5</weights>")),
          "PIN_REPEATED " PATH " #2", "");
  const sbf_pin_set *set = &asset->soft_bodies.at[0].pins.at[0];
  ck_assert_uint_eq(set->points.count, 2);
  ck_assert_uint_eq(set->offsets.count, 2);
  ck_assert_uint_eq(set->weights.count, 2);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_goals)
{
  sbf_asset_free(
      rules_expect_fix(BODY(TETRA PINS("maximum=\"0.5\"", "0 1 0", "")), "PIN_REPEATED " PATH " #2", ""));
  /* to two places: they may be meant to act together */
  sbf_asset_free(
      rules_expect_fix(BODY(TETRA PINS("maximum=\"0.5\"", "0 0", "<offsets>0 0 0 0.1 0 0</offsets>")), "",
          "PIN_REPEATED " PATH " #1"));
}
END_TEST

START_TEST(test_levels)
{
  sbf_asset_free(rules_expect_fix(
      BODY(LEVEL("", TETRA_POINTS,
          SPRINGS("", TETRA_EDGES, "") "<pins><pin_set><points>0</points></pin_set><pin_set><points>1 "
                                       "0</points></pin_set></pins>")),
      "PIN_REPEATED /sbf/soft_body[1]/level[1]/pins/pin_set[2]/points #1\nSPRING_INERT "
      "/sbf/soft_body[1]/level[1]/spring_set[1]/ends #0",
      ""));
}
END_TEST

RULES_MAIN("fix_pins", test_repeated, test_goals, test_levels)
