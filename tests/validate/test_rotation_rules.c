#include "rules.h"

START_TEST(test_wherever_they_stand)
{
  rules_expect("<skeleton>" BONE("root", "0 0 0", "rotation=\"0 0 0 1.0004\"") "</skeleton>", "");
  rules_expect("<skeleton>" BONE("root", "0 0 0", "rotation=\"0 0 0 1.01\"") "</skeleton>",
      "ROTATION_NOT_UNIT /sbf/skeleton/bone[1]/@rotation");
  rules_expect("<skeleton>" BONE("root", "0 0 0", "rotation=\"0 0 0 0\"") "</skeleton>",
      "ROTATION_NOT_UNIT /sbf/skeleton/bone[1]/@rotation");
  rules_expect("<rigid_bodies><rigid_body id=\"x\" name=\"X\" mass=\"1\" inertia_rotation=\"0 0 1 "
               "1\"/></rigid_bodies>",
      "ROTATION_NOT_UNIT /sbf/rigid_bodies/rigid_body[1]/@inertia_rotation");
  rules_expect(ROOT_BONE
      "<poses><pose id=\"p\"><pose_key bone=\"root\" rotation=\"0 0 0 2\"/></pose></poses>",
      "ROTATION_NOT_UNIT /sbf/poses/pose[1]/pose_key[1]/@rotation");
}
END_TEST

START_TEST(test_frames_of_joints)
{
  rules_expect(
      "<rigid_bodies><rigid_body id=\"x\" name=\"X\" mass=\"1\"/></rigid_bodies><joints><fixed_joint "
      "id=\"j\" body_b=\"x\"><frame_b rotation=\"0 0 0 0.9\"/></fixed_joint></joints>",
      "JOINT_FRAME /sbf/joints/fixed_joint[1]/frame_b/@rotation");
}
END_TEST

START_TEST(test_keys)
{
#define TURNED(interpolation, times, values)                                                                 \
  ROOT_BONE "<clips><clip id=\"c\" duration=\"1\"><track bone=\"root\" property=\"rotation\" "               \
            "interpolation=\"" interpolation "\"><times>" times "</times><values>" values                    \
            "</values></track></clip></clips>"
  rules_expect(
      TURNED("linear", "0 1", "0 0 0 1 0 0 0 2"), "ROTATION_NOT_UNIT /sbf/clips/clip[1]/track[1]/values #4");
  /* tangents are no rotations */
  rules_expect(TURNED("cubic", "0", "0 0 0 0 0 0 0 1 5 5 5 5"), "");
  rules_expect(TURNED("cubic", "0", "0 0 0 1 0 0 0 3 0 0 0 1"),
      "ROTATION_NOT_UNIT /sbf/clips/clip[1]/track[1]/values #4");
}
END_TEST

RULES_MAIN("rotation_rules", test_wherever_they_stand, test_frames_of_joints, test_keys)
