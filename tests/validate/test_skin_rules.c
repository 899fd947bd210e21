#include "rules.h"

#define BONES                                                                                                \
  "<skeleton>" BONE("one", "0 0 0", "length=\"0.1\"")                                                        \
      BONE("two", "0 0 0.1", "parent=\"one\" length=\"0.1\"") "</skeleton>"
#define SKINNED(counts, bones, weights)                                                                      \
  BONES RENDER("<skin><influence_counts>" counts "</influence_counts><bones>" bones                          \
               "</bones><weights>" weights "</weights></skin>")
#define PATH "/sbf/render_mesh[1]/skin"

START_TEST(test_sums)
{
  rules_expect(SKINNED("1 1 1 2", "0 1 1 0 1", "1 1 1 0.25 0.7505"), "");
  rules_expect(SKINNED("1 1 1 2", "0 1 1 0 1", "1 0.9 1 0.25 0.7"),
      "SKIN_SUM " PATH "/weights #1\nSKIN_SUM " PATH "/weights #3");
}
END_TEST

START_TEST(test_bones_of_a_point)
{ rules_expect(SKINNED("1 1 1 2", "0 1 1 1 1", "1 1 1 0.5 0.5"), "SKIN_BONE_REPEATED " PATH "/bones #4"); }
END_TEST

START_TEST(test_points_without_weights)
{ rules_expect(SKINNED("1 0 1 0", "0 1", "1 1"), "RIG_UNWEIGHTED_POINTS " PATH "/influence_counts #1"); }
END_TEST

RULES_MAIN("skin_rules", test_sums, test_bones_of_a_point, test_points_without_weights)
