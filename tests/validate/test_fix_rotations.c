#include <math.h>

#include "rules.h"

START_TEST(test_bones_and_joints)
{
  sbf_asset *asset = rules_expect_fix(
      "<skeleton>" BONE("a", "0 0 0", "rotation=\"0 0 3 4\"") BONE("b", "0 0 0",
          "rotation=\"0 0 0 0\"") "</skeleton>"
                                  "<rigid_bodies><rigid_body id=\"x\" name=\"X\" mass=\"1\"/></rigid_bodies>"
                                  "<joints><fixed_joint id=\"j\" body_b=\"x\"><frame_a rotation=\"0 0 0 "
                                  "5\"/></fixed_joint></joints>",
      "ROTATION_NOT_UNIT /sbf/skeleton/bone[1]/@rotation\nROTATION_NOT_UNIT /sbf/skeleton/bone[2]/@rotation\n"
      "JOINT_FRAME /sbf/joints/fixed_joint[1]/frame_a/@rotation",
      "");
  sbf_quat q = asset->bones.at[0].rotation;
  ck_assert(fabsf(q.z - 0.6f) < 1e-6f && fabsf(q.w - 0.8f) < 1e-6f && q.x == 0 && q.y == 0);
  q = asset->bones.at[1].rotation;
  ck_assert(q.w == 1 && q.x == 0 && q.y == 0 && q.z == 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_keys)
{
  sbf_asset *asset = rules_expect_fix(ROOT_BONE
      "<clips><clip id=\"c\" duration=\"1\"><track bone=\"root\" property=\"rotation\" "
      "interpolation=\"cubic\"><times>0 1</times>"
      "<values>9 9 9 9 0 0 0 1 9 9 9 9 9 9 9 9 0 2 0 0 9 9 9 9</values></track></clip></clips>",
      "ROTATION_NOT_UNIT /sbf/clips/clip[1]/track[1]/values #16", "");
  const float *values = asset->clips.at[0].tracks.at[0].values.at;
  ck_assert(values[17] == 1 && values[12] == 9 && values[20] == 9);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_normals)
{
  sbf_asset_free(rules_expect_fix(RENDER("<normals>1 0 0 0 2 0 0 0 1 0 0 0</normals>"),
      "NORMAL_NOT_UNIT /sbf/render_mesh[1]/normals #1",
      "NORMAL_NOT_UNIT /sbf/render_mesh[1]/normals #3")); /* one without a direction stays */
}
END_TEST

RULES_MAIN("fix_rotations", test_bones_and_joints, test_keys, test_normals)
