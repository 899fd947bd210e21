#include "legs.h"

#define PATH "/sbf/ik/ik_chain[1]"
#define STRAIGHT                                                                                             \
  "<skeleton>" BONE("a", "0 1 0", "") BONE("b", "0 0.5 0", "parent=\"a\"")                                   \
      BONE("c", "0 0 0", "parent=\"b\"") "</skeleton>"

START_TEST(test_good_chains)
{
  rules_expect(LEGS IK(LEFT_IK RIGHT_IK CHAIN(
                   "all", "solver=\"fabrik\" root=\"body\" end=\"left_foot\"", "<comfort bone=\"left\"/>")),
      "");
}
END_TEST

START_TEST(test_ends)
{
  rules_expect(LEGS IK(CHAIN("x", "root=\"right\" end=\"left_foot\"", "")), "IK_CHAIN_BROKEN " PATH);
  rules_expect(LEGS IK(CHAIN("x", "root=\"body\" end=\"left_foot\"", "")), "IK_BONE_COUNT " PATH);
  rules_expect(LEGS IK(CHAIN("x", "root=\"left\" end=\"left_shin\"", "")), "IK_BONE_COUNT " PATH);
  rules_expect(LEGS IK(CHAIN("x", "solver=\"ccd\" root=\"left\" end=\"left\"", "")), "IK_NO_REACH " PATH);
}
END_TEST

START_TEST(test_bends)
{
  rules_expect(STRAIGHT IK(CHAIN("x", "root=\"a\" end=\"c\"", "")), "IK_NO_BEND " PATH);
  rules_expect(STRAIGHT IK(CHAIN("x", "root=\"a\" end=\"c\" has_pole=\"true\" pole=\"0 0.5 1\"", "")), "");
  rules_expect(STRAIGHT IK(CHAIN("x", "root=\"a\" end=\"c\" has_pole=\"true\" pole=\"0 9 0\"", "")),
      "IK_NO_BEND " PATH);
  rules_expect(STRAIGHT IK(CHAIN("x", "solver=\"fabrik\" root=\"a\" end=\"c\"", "")), "");
}
END_TEST

START_TEST(test_comforts)
{
  rules_expect(LEGS IK(CHAIN("x", "root=\"left\" end=\"left_foot\"",
                   "<comfort bone=\"left_shin\"/><comfort bone=\"right\"/>")),
      "IK_COMFORT_OUTSIDE " PATH "/comfort[2]");
}
END_TEST

RULES_MAIN("ik_rules", test_good_chains, test_ends, test_bends, test_comforts)
