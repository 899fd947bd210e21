#include "rules.h"

#define REGIONS "/sbf/soft_body[1]/level[1]/shape_regions"
#define BODY_OF(points, sizes, members, more)                                                                \
  BODY(LEVEL("model=\"shape_matching\"", points,                                                             \
      "<shape_regions><sizes>" sizes "</sizes><points>" members "</points></shape_regions>" more))

START_TEST(test_good_regions)
{
  rules_expect(BODY_OF(TETRA_POINTS, "4", "0 1 2 3", ""), "");
  rules_expect(BODY_OF(TETRA_POINTS " 0.2 0.2 0.2", "4 4", "0 1 2 3 1 2 3 4", ""), "");
}
END_TEST

START_TEST(test_repeated)
{
  rules_expect(
      BODY_OF(TETRA_POINTS, "4 5", "0 1 2 3 0 1 2 3 1", ""), "REGION_REPEATED " REGIONS "/points #8");
}
END_TEST

START_TEST(test_flat)
{
  rules_expect(BODY_OF(TETRA_POINTS, "4 1", "0 1 2 3 2", ""), "REGION_FLAT " REGIONS "/sizes #1");
  rules_expect(BODY_OF(TETRA_POINTS, "4 2", "0 1 2 3 2 3", ""), "REGION_FLAT " REGIONS "/sizes #1");
  rules_expect(BODY_OF("0 0 0 1 0 0 1 1 0 0 1 0 0 0 1", "4 5", "0 1 2 3 0 1 2 3 4", ""),
      "REGION_FLAT " REGIONS "/sizes #0");
}
END_TEST

START_TEST(test_unsupported_features)
{
  rules_expect(BODY_OF(TETRA_POINTS " 1 1 1", "4", "0 1 2 3", ""), "REGION_POINT_LEFT_OUT " REGIONS);
  rules_expect(BODY_OF(TETRA_POINTS " 1 1 1", "4", "0 1 2 3", PINS("", "4", "")), "");
}
END_TEST

START_TEST(test_empty_levels)
{
  rules_expect(
      BODY(LEVEL("model=\"shape_matching\"", TETRA_POINTS, "")), "LEVEL_EMPTY /sbf/soft_body[1]/level[1]");
  rules_expect(BODY(LEVEL("model=\"jiggle\"", TETRA_POINTS, "")), "LEVEL_EMPTY /sbf/soft_body[1]/level[1]");
  rules_expect(BODY(LEVEL("model=\"jiggle\"", TETRA_POINTS, "<jiggle/>")), "");
}
END_TEST

RULES_MAIN(
    "region_rules", test_good_regions, test_repeated, test_flat, test_unsupported_features, test_empty_levels)
