#include "joints.h"

#define PATH(kind) "/sbf/joints/" kind "_joint[1]"

START_TEST(test_good_joints)
{
  rules_expect(HINGE("spherical", LIMIT("swing", "0", "0.5")), "");
  rules_expect(HINGE("six_dof", LIMIT("linear_x", "0", "0")), "");
  rules_expect(JOINT("distance", "", "position=\"0 1.2 0\"", MEET_B, LIMIT("distance", "0", "1.5")), "");
}
END_TEST

START_TEST(test_bodies)
{ rules_expect(JOINT("fixed", "body_a=\"low\"", MEET_A, MEET_A, ""), "JOINT_ONE_BODY " PATH("fixed")); }
END_TEST

START_TEST(test_the_rest_pose)
{
  rules_expect(JOINT("spherical", "body_a=\"up\"", MEET_A, "position=\"0 0.08 0\"", ""),
      "JOINT_NOT_AT_REST " PATH("spherical"));
  rules_expect(JOINT("point_on_line", "body_a=\"up\"", MEET_A, "position=\"0.08 0.1 0\"", ""),
      ""); /* along its line */
  rules_expect(JOINT("point_on_line", "body_a=\"up\"", MEET_A, "position=\"0 0.18 0\"", ""),
      "JOINT_NOT_AT_REST " PATH("point_on_line"));
  rules_expect(JOINT("revolute", "body_a=\"up\"", MEET_A, MEET_B " rotation=\"0.3 0 0 0.9539392\"", ""),
      ""); /* a twist */
  rules_expect(JOINT("revolute", "body_a=\"up\"", MEET_A, MEET_B " rotation=\"0 0.3 0 0.9539392\"", ""),
      "JOINT_NOT_AT_REST " PATH("revolute"));
}
END_TEST

/* 0.02 rad at rest is let pass, of a twist as of a swing; 1 mm and a hundredth of the arms of a distance. */
START_TEST(test_the_rest_pose_within_tolerance)
{
#define TURNED(kind, rotation) JOINT(kind, "body_a=\"up\"", MEET_A, MEET_B " rotation=\"" rotation "\"", "")
  rules_expect(TURNED("revolute", "0 0.009 0 0.99996"), "");
  rules_expect(TURNED("revolute", "0 0.011 0 0.99994"), "JOINT_NOT_AT_REST " PATH("revolute"));
  rules_expect(TURNED("prismatic", "0.009 0 0 0.99996"), "");
  rules_expect(TURNED("prismatic", "0.011 0 0 0.99994"), "JOINT_NOT_AT_REST " PATH("prismatic"));
  rules_expect(JOINT("spherical", "body_a=\"up\"", MEET_A, "position=\"0 0.1029 0\"", ""), "");
  rules_expect(JOINT("spherical", "body_a=\"up\"", MEET_A, "position=\"0 0.1035 0\"", ""),
      "JOINT_NOT_AT_REST " PATH("spherical"));
}
END_TEST

/* Bounds that leave out 0 are good where the joint is between them at rest. */
START_TEST(test_limits_without_zero)
{
#define TWIST_04 MEET_B " rotation=\"0.19866933 0 0 0.98006658\"" /* 0.4 rad */
  rules_expect(JOINT("revolute", "body_a=\"up\"", MEET_A, TWIST_04, LIMIT("twist", "0.1", "0.5")), "");
  rules_expect(JOINT("revolute", "body_a=\"up\"", MEET_A, TWIST_04, LIMIT("twist", "0.45", "0.5")),
      "LIMIT_EXCLUDES_REST " PATH("revolute") "/limits/limit[1]");
  rules_expect(JOINT("revolute", "body_a=\"up\"", MEET_A, TWIST_04, LIMIT("twist", "-0.1", "0.3")),
      "LIMIT_EXCLUDES_REST " PATH("revolute") "/limits/limit[1]");
  rules_expect(
      JOINT("six_dof", "body_a=\"up\"", MEET_A, "position=\"0.05 0.1 0\"", LIMIT("linear_x", "0.03", "0.07")),
      "");
}
END_TEST

START_TEST(test_limits)
{
#define LIMIT_PATH(kind) PATH(kind) "/limits/limit[1]"
  rules_expect(HINGE("revolute", LIMIT("twist", "0.5", "0.4")), "LIMIT_ORDER " LIMIT_PATH("revolute"));
  rules_expect(HINGE("revolute", LIMIT("swing_y", "-1", "1")), "LIMIT_IDLE " LIMIT_PATH("revolute"));
  rules_expect(HINGE("revolute", LIMIT("twist", "-6.2", "6.2")), "");
  rules_expect(HINGE("revolute", LIMIT("twist", "-90", "90")), "LIMIT_BEYOND_RANGE " LIMIT_PATH("revolute"));
  rules_expect(
      HINGE("spherical", LIMIT("swing", "-0.5", "0.5")), "LIMIT_BEYOND_RANGE " LIMIT_PATH("spherical"));
  rules_expect(JOINT("distance", "", "position=\"0 1.2 0\"", MEET_B, LIMIT("distance", "-1", "1.5")),
      "LIMIT_BEYOND_RANGE " LIMIT_PATH("distance"));
  rules_expect(
      HINGE("revolute", LIMIT("twist", "0.1", "0.5")), "LIMIT_EXCLUDES_REST " LIMIT_PATH("revolute"));
  rules_expect(JOINT("pulley", "body_a=\"up\" pulley_a=\"0 1.2 0\" pulley_b=\"0 1 0\"", MEET_A, MEET_B,
                   LIMIT("distance", "0", "1.7")),
      "LIMIT_EXCLUDES_REST " LIMIT_PATH("pulley"));
  rules_expect(HINGE("revolute", "<limits><limit target=\"twist\" min=\"-1\" max=\"1\"/><limit "
                                 "target=\"twist\" min=\"-2\" max=\"2\"/></limits>"),
      "LIMIT_REPEATED " PATH("revolute") "/limits/limit[2]");
}
END_TEST

START_TEST(test_drives)
{
  rules_expect(HINGE("revolute", "<drive target=\"twist\" stiffness=\"1\"/>"), "");
  rules_expect(HINGE("revolute", "<drive target=\"twist\"/>"), "DRIVE_IDLE " PATH("revolute") "/drive[1]");
  rules_expect(HINGE("revolute", "<drive target=\"linear_x\" stiffness=\"1\"/>"),
      "DRIVE_IDLE " PATH("revolute") "/drive[1]");
}
END_TEST

START_TEST(test_pulleys)
{
  rules_expect(
      JOINT("pulley", "body_a=\"up\" pulley_a=\"0 1.2 0\" pulley_b=\"0 1 0\"", MEET_A, MEET_B, ""), "");
  rules_expect(JOINT("pulley", "body_a=\"up\" pulley_a=\"0 0.2 0\" pulley_b=\"0 1 0\"", MEET_A, MEET_B, ""),
      "PULLEY_NO_ROPE " PATH("pulley"));
}
END_TEST

RULES_MAIN("joint_rules", test_good_joints, test_bodies, test_the_rest_pose,
    test_the_rest_pose_within_tolerance, test_limits_without_zero, test_limits, test_drives, test_pulleys)
