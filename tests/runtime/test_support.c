#include <math.h>

#include "animation/skeleton/rig_mass.h"
#include "gait_stage.h"
#include "harness.h"
#include "math/quat.h"
#include "quadruped.h"

/* A quadruped all of whose mass is `ahead` of the middle between its feet, m. */
static void begin(gait_stage *stage, float ahead) {
  gait_stage_begin(stage, quadruped_asset());
  sbri_bone_mass *masses =
      (sbri_bone_mass *)(uintptr_t)stage->rig.bones.masses; /* of the stage's own memory */
  float middle = 0;
  for (uint32_t l = 0; l < stage->rig.leg_count; l++)
    middle += stage->rig.legs[l].home.position.z / (float)stage->rig.leg_count;
  for (uint32_t b = 0; b < stage->rig.bones.count; b++) masses[b] = (sbri_bone_mass){0};
  const sbr_transform *root = &stage->rig.bones.rest[0];
  sbf_vec3 position = sbri_sub(sbri_vec3(0, 0.3f, middle + ahead), root->position);
  masses[0] = (sbri_bone_mass){1, sbri_rotate(sbri_quat_conjugate(root->rotation), position)};
  sbri_gait_reset(&stage->rig, stage->state, &stage->input, sbri_vec3(0, 0, 0), 0);
}

START_TEST(a_balanced_rest_pose_is_unchanged)
{
  gait_stage stage;
  begin(&stage, 0.02f);
  ck_assert(stage.state->balance.stand.x == 0 && stage.state->balance.stand.z == 0);
  ck_assert(stage.state->balance.sway_z.value == 0);
  gait_stage_end(&stage);
}
END_TEST

START_TEST(an_unbalanced_character_moves_over_its_feet_and_stays)
{
  gait_stage stage;
  begin(&stage, 1);
  float foremost = -1e30f, margin = 0.02f * stage.rig.stand.reach;
  sbf_vec3 center;
  for (uint32_t i = 0; i < 4 * stage.rig.leg_count; i++) {
    const sbri_leg *leg = &stage.rig.legs[i / 4];
    foremost = fmaxf(foremost, leg->home.position.z + leg->sole.corners[i % 4].z);
  }
  ck_assert(sbri_rig_center(&stage.rig, stage.rig.bones.rest, 1, &center));
  ck_assert_float_eq_tol(center.z + stage.state->balance.stand.z, foremost - margin, 1e-5f);
  ck_assert_float_eq(stage.state->balance.stand.x, 0);
  ck_assert_float_eq(stage.state->balance.sway_z.value, stage.state->balance.stand.z);
  gait_stage_ticks(&stage, 120);
  ck_assert_float_eq_tol(stage.state->balance.sway_z.value, stage.state->balance.stand.z, 1e-5f);
  gait_stage_end(&stage);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("support");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_balanced_rest_pose_is_unchanged);
  tcase_add_test(tests, an_unbalanced_character_moves_over_its_feet_and_stays);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
