#include <math.h>
#include <stdio.h>

#include "joints.h"
#include "validate/rules/joint_rest.h"

static sbfi_joint_rest rest_of(const char *inside) {
  sbf_asset *asset = rules_load(inside, false);
  sbfi_joint_rest rest = sbfi_joint_rest_of(asset, &asset->joints.at[0]);
  sbf_asset_free(asset);
  return rest;
}

static void expect_near(double value, double expected) {
  ck_assert_msg(fabs(value - expected) < 1e-6, "%.9g, not %.9g", value, expected);
}

START_TEST(test_offsets_between_frames)
{
  /* frame a is turned a quarter about +Z: its +X points up, and b lies 0.2 m below its origin */
  sbfi_joint_rest rest = rest_of(JOINT("six_dof", "body_a=\"up\"",
      "position=\"0 0.1 0\" rotation=\"0 0 0.70710677 0.70710677\"", "position=\"0.05 0.1 0\"", ""));
  expect_near(rest.at[SBF_JOINT_AXIS_LINEAR_X], -0.2);
  expect_near(rest.at[SBF_JOINT_AXIS_LINEAR_Y], -0.05);
  expect_near(rest.at[SBF_JOINT_AXIS_LINEAR_Z], 0);
  expect_near(rest.at[SBF_JOINT_AXIS_DISTANCE], sqrt(0.0425));
}
END_TEST

START_TEST(test_angles)
{
  /* a twist of 0.4 rad, then a swing of 0.6 rad about the axis (0, 0.6, 0.8): Q = S T */
  double s = sin(0.3), c = cos(0.3), ts = sin(0.2), tc = cos(0.2);
  double sy = 0.6 * s, sz = 0.8 * s;
  char text[2048];
  snprintf(text, sizeof text,
      JOINT("spherical", "body_a=\"up\"", MEET_A, MEET_B " rotation=\"%.9g %.9g %.9g %.9g\"", ""), c * ts,
      sy * tc + sz * ts, sz * tc - sy * ts, c * tc);
  sbfi_joint_rest rest = rest_of(text);
  expect_near(rest.at[SBF_JOINT_AXIS_TWIST], 0.4);
  expect_near(rest.at[SBF_JOINT_AXIS_SWING_Y], 0.36);
  expect_near(rest.at[SBF_JOINT_AXIS_SWING_Z], 0.48);
  expect_near(rest.at[SBF_JOINT_AXIS_SWING], 0.6);
  /* the same rotation, the quaternion's sign turned */
  snprintf(text, sizeof text,
      JOINT("spherical", "body_a=\"up\"", MEET_A, MEET_B " rotation=\"%.9g %.9g %.9g %.9g\"", ""), -c * ts,
      -sy * tc - sz * ts, sy * ts - sz * tc, -c * tc);
  rest = rest_of(text);
  expect_near(rest.at[SBF_JOINT_AXIS_TWIST], 0.4);
  expect_near(rest.at[SBF_JOINT_AXIS_SWING_Y], 0.36);
}
END_TEST

START_TEST(test_ropes)
{
  sbfi_joint_rest rest = rest_of(JOINT("pulley",
      "body_a=\"up\" pulley_a=\"0 1.2 0\" pulley_b=\"0 1 0\" pulley_ratio=\"2\"", MEET_A, MEET_B, ""));
  expect_near(rest.rope_a, 1);
  expect_near(rest.rope_b, 0.8);
  expect_near(rest.at[SBF_JOINT_AXIS_DISTANCE], 2.6);
}
END_TEST

START_TEST(test_the_world)
{
  sbfi_joint_rest rest = rest_of(JOINT("distance", "", "position=\"0 1.2 0\"", MEET_B, ""));
  expect_near(rest.at[SBF_JOINT_AXIS_DISTANCE], 1);
  expect_near(rest.at[SBF_JOINT_AXIS_LINEAR_Y], -1);
}
END_TEST

START_TEST(test_free_motions)
{
  ck_assert(sbfi_joint_is_free(SBF_JOINT_KIND_REVOLUTE, SBF_JOINT_AXIS_TWIST));
  ck_assert(!sbfi_joint_is_free(SBF_JOINT_KIND_REVOLUTE, SBF_JOINT_AXIS_SWING));
  ck_assert(sbfi_joint_is_free(SBF_JOINT_KIND_SPHERICAL, SBF_JOINT_AXIS_SWING));
  ck_assert(!sbfi_joint_is_free(SBF_JOINT_KIND_SPHERICAL, SBF_JOINT_AXIS_DISTANCE));
  ck_assert(sbfi_joint_is_free(SBF_JOINT_KIND_POINT_IN_PLANE, SBF_JOINT_AXIS_LINEAR_Z));
  ck_assert(!sbfi_joint_is_free(SBF_JOINT_KIND_POINT_IN_PLANE, SBF_JOINT_AXIS_LINEAR_X));
  for (int axis = 0; axis < SBF_JOINT_AXIS_COUNT; axis++) {
    ck_assert(!sbfi_joint_is_free(SBF_JOINT_KIND_FIXED, axis));
    ck_assert(sbfi_joint_is_free(SBF_JOINT_KIND_SIX_DOF, axis));
  }
}
END_TEST

RULES_MAIN(
    "joint_rest", test_offsets_between_frames, test_angles, test_ropes, test_the_world, test_free_motions)
