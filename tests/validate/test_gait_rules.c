#include "legs.h"

#define WALK(attributes, inside) LEGS IK(LEFT_IK RIGHT_IK) GAIT(attributes, inside)
#define LEFT_AT(more) "<leg name=\"Left\" ik=\"ik_left\" " more "/>"

START_TEST(test_a_good_gait)
{ rules_expect(WALK("hips=\"body\"", LEFT_LEG RIGHT_LEG), ""); }
END_TEST

START_TEST(test_legs)
{
  rules_expect(WALK("", ""), "GAIT_NO_LEGS /sbf/gait[1]");
  rules_expect(WALK("", LEFT_LEG "<leg name=\"Again\" ik=\"ik_left\" home=\"0.1 0 0\" group=\"1\"/>"),
      "LEG_REPEATED /sbf/gait[1]/leg[2]");
  rules_expect(WALK("", LEFT_LEG LEFT_AT("home=\"0.1 0 0\"")),
      "LEG_REPEATED /sbf/gait[1]/leg[2]\nGAIT_ONE_GROUP /sbf/gait[1]");
}
END_TEST

START_TEST(test_homes)
{
  rules_expect(WALK("", LEFT_AT("home=\"0.1 0 0.09\"")), ""); /* 0.508 m of 0.5099 m */
  rules_expect(WALK("", LEFT_AT("home=\"0.1 0 0.12\"")), "LEG_HOME_BEYOND_REACH /sbf/gait[1]/leg[1]");
  rules_expect(WALK("", LEFT_LEG "<leg name=\"Right\" ik=\"ik_right\" home=\"-0.1 0.1 0\" group=\"1\"/>"),
      "LEG_UNEVEN /sbf/gait[1]");
  rules_expect(
      WALK("", LEFT_LEG "<leg name=\"Right\" ik=\"ik_right\" home=\"-0.1 0.1 0\" sole=\"0.1\" group=\"1\"/>"),
      "");
}
END_TEST

START_TEST(test_steps)
{
  rules_expect(WALK("step_trigger=\"0.25\"", LEFT_LEG), "");
  rules_expect(WALK("step_trigger=\"0.3\"", LEFT_LEG), "LEG_TRIGGER_BEYOND_REACH /sbf/gait[1]/leg[1]");
  rules_expect(WALK("step_height=\"0.6\"", LEFT_LEG), "GAIT_STEP_TOO_HIGH /sbf/gait[1]");
  rules_expect(WALK("step_duration=\"0.02\"", LEFT_LEG), "GAIT_STEP_TOO_SHORT /sbf/gait[1]");
  rules_expect(WALK("step_duration=\"0.02\"", LEFT_LEG) "<environment control_tick=\"0.01\"/>", "");
}
END_TEST

START_TEST(test_bones)
{
  const char *outside =
      LEGS IK(LEFT_IK RIGHT_IK) "<gait id=\"walk\" body=\"left\" chest=\"body\">" LEFT_LEG RIGHT_LEG
                                "<head_turn bone=\"right\"/></gait>";
  rules_expect(outside, "GAIT_BONE_OUTSIDE /sbf/gait[1]/leg[2]\nGAIT_BONE_OUTSIDE "
                        "/sbf/gait[1]\nGAIT_BONE_OUTSIDE /sbf/gait[1]");
}
END_TEST

START_TEST(test_tails)
{
#define TAIL(tails)                                                                                          \
  WALK("", LEFT_LEG tails) "<chains><chain id=\"tail\"><bones>4 5 6</bones></chain></chains>"
  rules_expect(TAIL("<tail chain=\"tail\"/>"), "");
  rules_expect(
      TAIL("<tail chain=\"tail\"/><tail chain=\"tail\"/>"), "FOLLOWER_REPEATED /sbf/gait[1]/tail[2]");
}
END_TEST

#define KIND(kind, inside) LEGS "<gait id=\"g\" body=\"body\" kind=\"" kind "\">" inside "</gait>"
#define WAVE(bones) "<undulation><bones>" bones "</bones></undulation>"

START_TEST(test_kinds)
{
  rules_expect(KIND("none", ""), "");
  rules_expect(KIND("fly", ""), "");
  rules_expect(KIND("crawl", ""), "");
  rules_expect(KIND("swim", WAVE("0 1 2")), "");
  rules_expect(KIND("swim", "<fin><bones>1</bones></fin>"), "");
  rules_expect(KIND("swim", ""), "GAIT_NOTHING_MOVES /sbf/gait[1]");
  rules_expect(KIND("slither", "<fin><bones>1</bones></fin>"), "GAIT_NOTHING_MOVES /sbf/gait[1]");
  rules_expect(KIND("roll", ""), "GAIT_NOTHING_MOVES /sbf/gait[1]");
}
END_TEST

START_TEST(test_parts)
{
  rules_expect(KIND("swim", WAVE("1")), "GAIT_CHAIN_SHORT /sbf/gait[1]/undulation");
  rules_expect(KIND("swim", WAVE("1 1")), "BONE_REPEATED /sbf/gait[1]/undulation #1");
  rules_expect(KIND("fly", "<fin/>"), "GAIT_CHAIN_SHORT /sbf/gait[1]/fin[1]");
  rules_expect(KIND("roll", "<tread><bones>2</bones></tread>"), "GAIT_CHAIN_SHORT /sbf/gait[1]/tread[1]");
  rules_expect(
      KIND("fly", "<fin axis=\"0 0 0\"><bones>1</bones></fin>"), "GAIT_AXIS_ZERO /sbf/gait[1]/fin[1]/@axis");
  rules_expect(KIND("roll", "<wheel bone=\"left\" radius=\"1\" axis=\"0 0 0\"/>"),
      "GAIT_AXIS_ZERO /sbf/gait[1]/wheel[1]/@axis");
  rules_expect(LEGS "<gait id=\"g\" body=\"left\" kind=\"roll\"><wheel bone=\"right\" radius=\"1\"/></gait>",
      "GAIT_BONE_OUTSIDE /sbf/gait[1]");
#define REST(distance)                                                                                       \
  LEGS "<gait id=\"g\" body=\"body\" kind=\"none\" rest_pose=\"p\"/><poses><pose id=\"p\" " distance         \
       "><pose_key bone=\"left\"/></pose></poses>"
  rules_expect(REST(""), "");
  rules_expect(REST("distance=\"0.5\""), "GAIT_POSE_WALKS /sbf/gait[1]");
}
END_TEST

RULES_MAIN("gait_rules", test_a_good_gait, test_legs, test_homes, test_steps, test_bones, test_tails,
    test_kinds, test_parts)
