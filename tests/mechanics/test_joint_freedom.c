#include "harness.h"
#include "mechanics/joint_freedom.h"

/* Free coordinates of each kind, as the table of spec 8.3 counts them: linear, angular. */
START_TEST(kinds_have_the_free_axes_of_the_specification)
{
  static const int linear[SBF_JOINT_KIND_COUNT] = {1, 0, 1, 0, 1, 2, 3, 3, 0, 3};
  static const int angular[SBF_JOINT_KIND_COUNT] = {0, 1, 1, 3, 3, 3, 3, 3, 0, 3};
  for (int kind = 0; kind < SBF_JOINT_KIND_COUNT; kind++) {
    int counts[2] = {0, 0};
    for (int axis = SBF_JOINT_AXIS_LINEAR_X; axis <= SBF_JOINT_AXIS_SWING_Z; axis++) {
      bool free = sbfi_joint_is_free((sbf_joint_kind)kind, (sbf_joint_axis)axis);
      counts[axis >= SBF_JOINT_AXIS_TWIST] += free;
      ck_assert_int_eq(free, !(sbfi_joint_is_locked((sbf_joint_kind)kind) >> axis & 1));
    }
    ck_assert_int_eq(counts[0], linear[kind]);
    ck_assert_int_eq(counts[1], angular[kind]);
    ck_assert_int_eq(sbfi_joint_is_free((sbf_joint_kind)kind, SBF_JOINT_AXIS_DISTANCE), counts[0] > 0);
  }
  ck_assert(!sbfi_joint_is_free(SBF_JOINT_KIND_REVOLUTE, SBF_JOINT_AXIS_SWING));
  ck_assert(sbfi_joint_is_free(SBF_JOINT_KIND_SPHERICAL, SBF_JOINT_AXIS_SWING));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("joint_freedom");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, kinds_have_the_free_axes_of_the_specification);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
