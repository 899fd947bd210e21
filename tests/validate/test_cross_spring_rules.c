#include "rules.h"

#define OTHER                                                                                                \
  "<soft_body id=\"c\" name=\"C\">" LEVEL(                                                                   \
      "", "1 0 0 1.2 0 0 1 0.2 0 1 0 0.2", SPRINGS("", TETRA_EDGES, "")) "</soft_body>"
#define CROSS(attributes, ends, more)                                                                        \
  BODY(TETRA_SPRINGS) OTHER "<cross_springs " attributes "><ends>" ends "</ends>" more "</cross_springs>"
#define JOINED "body_a=\"b\" body_b=\"c\""
#define ENDS "/sbf/cross_springs[1]/ends"

START_TEST(test_good)
{ rules_expect(CROSS(JOINED, "1 0 3 2", ""), ""); }
END_TEST

START_TEST(test_levels_and_points)
{
  rules_expect(CROSS(JOINED " level_b=\"1\"", "1 0", ""), "CROSS_SPRING_LEVEL /sbf/cross_springs[1]");
  rules_expect(
      CROSS(JOINED, "1 0 4 0 0 7", ""), "CROSS_SPRING_POINT " ENDS " #1\nCROSS_SPRING_POINT " ENDS " #2");
  rules_expect(CROSS("body_a=\"c\" body_b=\"c\"", "0 1", ""), "CROSS_SPRING_ONE_BODY /sbf/cross_springs[1]");
}
END_TEST

START_TEST(test_springs)
{
  rules_expect(CROSS(JOINED, "1 0 2 2 1 0", ""), "SPRING_DUPLICATE " ENDS " #2");
  rules_expect(CROSS(JOINED, "1 0", "<rest_lengths>0</rest_lengths>"), "SPRING_NO_LENGTH " ENDS " #0");
  rules_expect(
      CROSS(JOINED, "1 0", "<stiffness>0</stiffness>"), "SPRING_LIMP /sbf/cross_springs[1]/stiffness #0");
}
END_TEST

START_TEST(test_pinned_ends)
{
#define HELD(id, x)                                                                                          \
  "<soft_body id=\"" id "\" name=\"" id "\">" LEVEL(                                                         \
      "", x " 0 0 0 1 0 0 0 1 " x " 1 1", SPRINGS("", TETRA_EDGES, "") PINS("", "0", "")) "</soft_body>"
  rules_expect(HELD("b", "-1") HELD("c", "5") "<cross_springs " JOINED
                                              "><ends>0 0 0 1</ends></cross_springs>",
      "SPRING_INERT " ENDS " #0");
}
END_TEST

RULES_MAIN("cross_spring_rules", test_good, test_levels_and_points, test_springs, test_pinned_ends)
