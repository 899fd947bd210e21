#include "rules.h"

#define ENDS "/sbf/soft_body[1]/level[1]/spring_set[1]/ends"

START_TEST(test_springs_without_effect)
{
  sbf_asset *asset = rules_expect_fix(
      BODY(LEVEL("", TETRA_POINTS,
          SPRINGS("inert_count=\"5\"", "2 2 0 1 0 2 0 3 1 2 1 3 2 3 3 3",
              "<rest_lengths>1 2 0.2 0.2 0.3 0.3 0.3 7</rest_lengths><stiffness>1 2 3 4 5 6 7 "
              "8</stiffness><color_counts>2 1 1 1 1 1 1</color_counts>") PINS("", "0 1", ""))),
      "SPRING_SAME_POINT " ENDS " #0\nSPRING_INERT " ENDS " #1", "");
  const sbf_spring_set *set = &asset->soft_bodies.at[0].levels.at[0].springs.at[0];
  ck_assert_uint_eq(set->ends.count, 5);
  ck_assert_uint_eq(set->inert_count, 6);
  ck_assert_uint_eq(set->rest_lengths.count, 5);
  ck_assert(set->stiffness.at[0] == 3 && set->stiffness.at[4] == 7);
  ck_assert_uint_eq(set->color_counts.at[0], 0);
  ck_assert_uint_eq(set->color_counts.at[6], 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_repeated)
{
#define TWO_SETS(first, second)                                                                              \
  BODY(LEVEL("", TETRA_POINTS, SPRINGS("", TETRA_EDGES " 1 0", first) SPRINGS("", "3 2", second)))
  sbf_asset_free(rules_expect_fix(TWO_SETS("", ""),
      "SPRING_DUPLICATE " ENDS " #6\nSPRING_DUPLICATE /sbf/soft_body[1]/level[1]/spring_set[2]/ends #0", ""));
  /* another stiffness is another spring */
  sbf_asset_free(
      rules_expect_fix(TWO_SETS("<stiffness>1 2 3 4 5 6 7</stiffness>", "<stiffness>9</stiffness>"), "",
          "SPRING_DUPLICATE " ENDS " #6\nSPRING_DUPLICATE /sbf/soft_body[1]/level[1]/spring_set[2]/ends #0"));
}
END_TEST

RULES_MAIN("fix_springs", test_springs_without_effect, test_repeated)
