#include "import/convert/propose_limits.h"

#include <math.h>
#include <string.h>

#include "conversions.h"
#include "sbfmt/build.h"

START_TEST(names_identify_parts)
{
  static const struct {
    const char *name;
    sbfi_limb_part part;
  } samples[] = {{"mixamorig:LeftForeArm", SBFI_PART_ELBOW}, {"LeftArm", SBFI_PART_SHOULDER},
      {"RightShoulder", SBFI_PART_COLLAR}, {"LeftUpLeg", SBFI_PART_HIP}, {"LeftLeg", SBFI_PART_KNEE},
      {"LeftToeBase", SBFI_PART_DIGIT}, {"b_RightUpperArm_06", SBFI_PART_SHOULDER},
      {"b_Tail01_012", SBFI_PART_TAIL}, {"Neck1", SBFI_PART_NECK}, {"HandThumb2", SBFI_PART_DIGIT},
      {"shin.L", SBFI_PART_KNEE}, {"Bone.003", SBFI_PART_OTHER}};
  for (size_t i = 0; i < sizeof samples / sizeof *samples; i++)
    ck_assert_msg(sbfi_part_by_name(samples[i].name) == samples[i].part, "%s", samples[i].name);
}
END_TEST

static const sbf_limit *limit_of(const sbf_joint *joint, sbf_joint_axis axis) {
  for (uint32_t i = 0; i < joint->limits.count; i++)
    if (joint->limits.at[i].target == axis) return &joint->limits.at[i];
  return NULL;
}

/* What every proposal keeps; converted_file has validated the rest pose against the limits as well. */
static void check_all(const sbf_asset *a, uint32_t min) {
  uint32_t count = 0;
  for (uint32_t j = 0; j < a->joints.count; j++) {
    const sbf_joint *joint = &a->joints.at[j];
    if (joint->limits.count == 0 || !joint->proposed) continue;
    count++;
    ck_assert_ptr_nonnull(limit_of(joint, SBF_JOINT_AXIS_TWIST));
    for (uint32_t i = 0; i < joint->limits.count; i++) {
      ck_assert(joint->limits.at[i].min <= 0 && joint->limits.at[i].max >= 0);
      ck_assert(joint->limits.at[i].max - joint->limits.at[i].min <= 3.5f);
    }
  }
  ck_assert_uint_ge(count, min);
}

/* Where the joint's +Z takes the bone's direction, which is its +X: its +Y. */
static sbf_vec3 bends_to(const sbf_joint *joint) {
  sbf_quat q = joint->frame_b.rotation;
  return (sbf_vec3){
      2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
}

START_TEST(a_human_rig)
{
  const char *path = harness_shared("greenman/greenman.glb");
  if (!path) return;
  converted c;
  converted_file(&c, path, &(sbf_convert_options){.limits = SBF_CONVERT_LIMITS_HUMAN});
  check_all(c.asset, 3);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_LIMITS_PROPOSED), 1);
  const sbf_limit *left = limit_of(joint_named(c.asset, "hand_L"), SBF_JOINT_AXIS_SWING_Z);
  const sbf_limit *right = limit_of(joint_named(c.asset, "hand_R"), SBF_JOINT_AXIS_SWING_Z);
  ck_assert_float_eq(left->min, right->min);
  ck_assert_float_eq(left->max, right->max);
  ck_assert_float_eq_tol(left->max, 80 * 0.0174533f, 1e-4f);
  converted_free(&c);
}
END_TEST

START_TEST(a_fox)
{
  const char *path = harness_shared("fox/fox.glb");
  if (!path) return;
  converted c;
  converted_file(&c, path, &(sbf_convert_options){.limits = SBF_CONVERT_LIMITS_QUADRUPED});
  check_all(c.asset, 20);
  ck_assert_float_eq_tol(
      limit_of(joint_named(c.asset, "b_Head_05"), SBF_JOINT_AXIS_SWING)->max, 0.698f, 1e-3f);
  /* Elbows bend forward, knees as they are bent. */
  ck_assert_float_gt(bends_to(joint_named(c.asset, "b_LeftForeArm_010")).z, 0.5f);
  ck_assert_float_gt(bends_to(joint_named(c.asset, "b_RightForeArm_07")).z, 0.5f);
  for (int side = 0; side < 2; side++) {
    const sbf_joint *knee = joint_named(c.asset, side ? "b_LeftLeg02_016" : "b_RightLeg02_020");
    const sbf_limit *bend = limit_of(knee, SBF_JOINT_AXIS_SWING_Z);
    ck_assert_float_lt(bends_to(knee).z, 0);
    ck_assert_float_gt(bend->max, 1);
    ck_assert_float_lt(bend->max, 2.5f);
  }
  converted_free(&c);
}
END_TEST

/* Every joint between sections that a build cuts is proposed at the conversion: none is left for the build to
 * make without limits, and every rigid body gets a hull but what such sections hang on. */
START_TEST(sections_of_a_skin)
{
  converted c;
  converted_file(&c, harness_source("examples/calf/calf.glb"),
      &(sbf_convert_options){.limits = SBF_CONVERT_LIMITS_QUADRUPED,
          .softness.soft = (const char *const[]){"*"},
          .softness.soft_count = 1});
  sbf_asset *built;
  sbf_build_report report;
  ck_assert_int_eq(sbf_build(c.asset, NULL, &built, &report, NULL), SBF_OK);
  ck_assert_uint_eq(report.sections, 22);
  ck_assert_uint_eq(built->rigid_bodies.count, 22);
  ck_assert_uint_eq(built->joints.count, 21);
  uint32_t limited = 0;
  for (uint32_t j = 0; j < 21; j++) {
    ck_assert_int_eq(built->joints.at[j].derived, SBF_NONE);
    limited += built->joints.at[j].limits.count > 0;
  }
  ck_assert_uint_ge(limited, 19); /* ears are none that a table knows */
  for (uint32_t i = 0; i < 22; i++) ck_assert_ptr_nonnull(built->rigid_bodies.at[i].hull);
  sbf_asset_free(built);
  converted_free(&c);
}
END_TEST

/* All its joints state limits, which stay; taken away, a reptile's are proposed. */
START_TEST(the_example_lizard)
{
  const sbf_convert_options options = {.limits = SBF_CONVERT_LIMITS_REPTILE};
  const char *path = harness_source("examples/lizard/lizard.glb");
  sbfi_scene scene;
  sbf_diagnostic error;
  converted c;
  converted_file(&c, path, &options);
  for (uint32_t j = 0; j < c.asset->joints.count; j++) ck_assert(!c.asset->joints.at[j].proposed);
  uint32_t joints = c.asset->joints.count;
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_LIMITS_PROPOSED), 0);
  converted_free(&c);
  ck_assert_int_eq(sbfi_scene_read(&scene, path, &(sbfi_scene_options){.allocator = NULL}, &error), SBF_OK);
  sbfi_scene_node *nodes = (sbfi_scene_node *)(uintptr_t)scene.nodes;
  for (uint32_t i = 0; i < scene.node_count; i++) memset(nodes[i].limits, 0, sizeof nodes[i].limits);
  converted_scene(&c, &scene, &scene, &options);
  check_all(c.asset, joints);
  for (uint32_t l = 0; l < c.asset->gaits.at[0].legs.count; l++) {
    int32_t root = c.asset->ik_chains.at[c.asset->gaits.at[0].legs.at[l].ik].root;
    for (uint32_t j = 0; j < joints; j++) {
      const sbf_joint *joint = &c.asset->joints.at[j];
      if (c.asset->rigid_bodies.at[joint->body_b].bone == root)
        ck_assert_ptr_nonnull(limit_of(joint, SBF_JOINT_AXIS_SWING)); /* a cone for thigh and upper arm */
    }
  }
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(without_the_wish_nothing_is_proposed)
{
  converted c;
  converted_file(&c, harness_source("examples/lizard/lizard.glb"), NULL);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_LIMITS_PROPOSED), 0);
  converted_free(&c);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("propose_limits");
  TCase *c = tcase_create("propose_limits");
  tcase_add_test(c, names_identify_parts);
  tcase_add_test(c, a_human_rig);
  tcase_add_test(c, a_fox);
  tcase_add_test(c, the_example_lizard);
  tcase_add_test(c, sections_of_a_skin);
  tcase_add_test(c, without_the_wish_nothing_is_proposed);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
