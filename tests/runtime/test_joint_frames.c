#include "harness.h"
#include "ik_chains.h"
#include "rigid/joint_frames.h"

static sbf_joint source;
static sbri_rigid_joint joint;

static void begin(sbf_joint_kind kind, uint32_t *seed) {
  sbf_joint_init(&source);
  source.kind = kind;
  source.pulley_a = (sbf_vec3){0.3f, 2, 0}, source.pulley_b = (sbf_vec3){-0.4f, 2, 0.1f};
  source.pulley_ratio = 1.5f;
  joint = (sbri_rigid_joint){.source = &source, .bodies = {0, 1}};
  for (int side = 0; side < SBRI_SIDES; side++)
    joint.frames[side] = (sbri_rigid_frame){
        {0.3f * ik_random(seed), 0.3f * ik_random(seed), 0.3f * ik_random(seed)}, ik_random_rotation(seed)};
}

static float coordinate(const sbr_transform poses[SBRI_SIDES], sbf_joint_axis axis) {
  const sbr_transform anchor = {{0, 0, 0}, {0, 0, 0, 1}};
  const sbr_transform *at[SBRI_SIDES] = {&poses[0], &poses[1]};
  sbri_joint_frames joint_frames = sbri_joint_frames_of(&joint, at, &anchor, sbri_vec3(0, 0, 0));
  return sbri_joint_coordinate(&joint, &joint_frames, axis);
}

static sbr_transform moved(const sbr_transform *pose, int direction, float by) {
  sbr_transform to = *pose;
  const sbf_vec3 axis = {direction % 3 == 0, direction % 3 == 1, direction % 3 == 2};
  if (direction < 3)
    to.position = sbri_add_scaled(to.position, axis, by);
  else
    to.rotation = sbri_quat_multiply(sbri_quat_about(axis, by), to.rotation);
  return to;
}

/* The rates equal the change of the coordinates under small motions of either body. */
START_TEST(rates_are_differences)
{
  uint32_t seed = 7;
  const sbr_transform anchor = {{0, 0, 0}, {0, 0, 0, 1}};
  for (int round = 0; round < 300; round++) {
    begin(round % 2 ? SBF_JOINT_KIND_PULLEY : SBF_JOINT_KIND_SIX_DOF, &seed);
    sbr_transform poses[SBRI_SIDES];
    for (int side = 0; side < SBRI_SIDES; side++)
      poses[side] =
          (sbr_transform){{ik_random(&seed), ik_random(&seed), ik_random(&seed)}, ik_random_rotation(&seed)};
    const sbr_transform *at[SBRI_SIDES] = {&poses[0], &poses[1]};
    sbri_joint_frames joint_frames = sbri_joint_frames_of(&joint, at, &anchor, sbri_vec3(0, 0, 0));
    if (sbri_joint_coordinate(&joint, &joint_frames, SBF_JOINT_AXIS_SWING) > 2.8f) continue;
    if (fabsf(joint_frames.angles.twist) > 3) continue;
    for (int axis = 0; axis < SBF_JOINT_AXIS_COUNT; axis++) {
      float rates[SBRI_SIDES][6];
      sbri_joint_compute_gradient(&joint, &joint_frames, (sbf_joint_axis)axis, rates);
      for (int side = 0; side < SBRI_SIDES; side++)
        for (int direction = 0; direction < 6; direction++) {
          const float e = 2e-3f;
          sbr_transform up[SBRI_SIDES] = {poses[0], poses[1]}, down[SBRI_SIDES] = {poses[0], poses[1]};
          up[side] = moved(&poses[side], direction, e), down[side] = moved(&poses[side], direction, -e);
          float seen =
              (coordinate(up, (sbf_joint_axis)axis) - coordinate(down, (sbf_joint_axis)axis)) / (2 * e);
          ck_assert_float_eq_tol(rates[side][direction], seen, 2e-3f + 2e-3f * fabsf(seen));
        }
    }
  }
}
END_TEST

/* Locked axes have value and rate 0. */
START_TEST(locked_coordinates_agree_at_zero)
{
  uint32_t seed = 3;
  begin(SBF_JOINT_KIND_FIXED, &seed);
  for (int axis = SBF_JOINT_AXIS_LINEAR_X; axis <= SBF_JOINT_AXIS_SWING_Z; axis++) {
    sbr_transform poses[SBRI_SIDES] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
    /* b where its frame lies on a's, turned on by a milliradian about each axis. */
    sbf_quat small = sbri_quat_exp(sbri_vec3(1e-3f, -2e-3f, 1.5e-3f));
    sbf_quat wanted = sbri_quat_multiply(joint.frames[0].axes, small);
    poses[1].rotation = sbri_quat_multiply(wanted, sbri_quat_conjugate(joint.frames[1].axes));
    poses[1].position = sbri_sub(joint.frames[0].at, sbri_rotate(poses[1].rotation, joint.frames[1].at));
    const sbr_transform *at[SBRI_SIDES] = {&poses[0], &poses[1]};
    sbri_joint_frames joint_frames = sbri_joint_frames_of(&joint, at, &poses[0], sbri_vec3(0, 0, 0));
    ck_assert_float_eq_tol(sbri_joint_locked_coordinate(&joint_frames, (sbf_joint_axis)axis),
        sbri_joint_coordinate(&joint, &joint_frames, (sbf_joint_axis)axis), 1e-6f);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("joint_place");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, rates_are_differences);
  tcase_add_test(tests, locked_coordinates_agree_at_zero);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
