#include <math.h>
#include <string.h>

#include "conversions.h"
#include "sbfmt/build.h"

static sbf_vec3 turned(sbf_quat q, double x, double y, double z) {
  const double u[3] = {(double)q.x, (double)q.y, (double)q.z}, w = (double)q.w, v[3] = {x, y, z};
  double t[3], out[3];
  for (int k = 0; k < 3; k++) t[k] = 2 * (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
  for (int k = 0; k < 3; k++)
    out[k] = v[k] + w * t[k] + u[(k + 1) % 3] * t[(k + 2) % 3] - u[(k + 2) % 3] * t[(k + 1) % 3];
  return (sbf_vec3){(float)out[0], (float)out[1], (float)out[2]};
}

static sbf_vec3 placed(const sbf_frame *frame, const sbf_rigid_body *body) {
  return (sbf_vec3){frame->position.x + body->center.x, frame->position.y + body->center.y,
      frame->position.z + body->center.z};
}

/* Both frames of a joint are at the bone's head at rest, and +X, +Y, +Z are the bone's +Y, +Z, +X. */
static void check_frames(const sbf_asset *a, const sbf_joint *joint) {
  const sbf_rigid_body *body_a = &a->rigid_bodies.at[joint->body_a],
                       *body_b = &a->rigid_bodies.at[joint->body_b];
  const sbf_bone *bone = &a->bones.at[body_b->bone];
  const sbf_vec3 head = bone->head;
  check_near(placed(&joint->frame_a, body_a), (double)head.x, (double)head.y, (double)head.z, 1e-6);
  check_near(placed(&joint->frame_b, body_b), (double)head.x, (double)head.y, (double)head.z, 1e-6);
  const sbf_quat qa = joint->frame_a.rotation, qb = joint->frame_b.rotation;
  ck_assert_float_eq(qa.x * qb.x + qa.y * qb.y + qa.z * qb.z + qa.w * qb.w,
      qa.x * qa.x + qa.y * qa.y + qa.z * qa.z + qa.w * qa.w);
  for (int axis = 0; axis < 3; axis++) {
    double own[3] = {axis == 0, axis == 1, axis == 2}, of_bone[3] = {axis == 2, axis == 0, axis == 1};
    sbf_vec3 is = turned(qb, own[0], own[1], own[2]);
    sbf_vec3 expected = turned(bone->rotation, of_bone[0], of_bone[1], of_bone[2]);
    check_near(is, (double)expected.x, (double)expected.y, (double)expected.z, 2e-6);
  }
}

static void make_arm(sbfi_scene *scene) {
  scene_begin(scene);
  int32_t root = scene_node(scene, "root", SBF_NONE, true, 0, 0, 0);
  int32_t chest = scene_node(scene, "chest", root, true, 0, 1, 0);
  int32_t collar = scene_node(scene, "collar", chest, true, 0, 0.5, 0);
  int32_t arm = scene_node(scene, "arm", collar, true, 0, 0.5, 0);
  scene_box(scene, scene_node(scene, "Chest", chest, false, 0, 0, 0), 0.25, 0, 0.25, 0, false);
  scene_box(scene, scene_node(scene, "Arm", arm, false, 0, 0, 0), 0.25, 0, 0.5, 0, false);
  scene_box(scene, scene_node(scene, "Sleeve", arm, false, 0, 0, 0), 0.25, 0, 1.5, 0, false);
  sbfi_scene_node *node = (sbfi_scene_node *)(uintptr_t)&scene->nodes[arm];
  node->limits[SBFI_LIMIT_SWING_Z] = (sbfi_scene_limit){true, -0.5f, 1.25f};
  node->limits[SBFI_LIMIT_TWIST] = (sbfi_scene_limit){true, 0, 0.25f};
  scene_end(scene);
}

START_TEST(bones_with_sections_become_bodies_and_joints)
{
  sbfi_scene scene;
  converted c;
  make_arm(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  ck_assert_uint_eq(a->rigid_bodies.count, 2); /* two sections move with the arm as one */
  ck_assert_uint_eq(a->joints.count, 1);       /* past the collar, which has none */
  const sbf_rigid_body *arm = &a->rigid_bodies.at[1];
  ck_assert_int_eq(arm->bone, bone_named(a, "arm"));
  ck_assert_ptr_null(arm->hull);
  ck_assert(!arm->proposed && arm->derived == SBF_NONE && arm->motion == SBF_BODY_MOTION_KINEMATIC);
  check_near(arm->center, 0, 3, 0, 1e-6); /* the middle of both boxes */
  const sbf_joint *joint = joint_named(a, "arm");
  ck_assert_int_eq(joint->kind, SBF_JOINT_KIND_SPHERICAL);
  ck_assert(!joint->proposed && joint->body_a == 0 && joint->body_b == 1);
  check_frames(a, joint);
  ck_assert_uint_eq(joint->limits.count, 2);
  ck_assert_int_eq(joint->limits.at[0].target, SBF_JOINT_AXIS_TWIST);
  ck_assert_float_eq(joint->limits.at[0].max, 0.25f);
  ck_assert_int_eq(joint->limits.at[1].target, SBF_JOINT_AXIS_SWING_Z);
  ck_assert_float_eq(joint->limits.at[1].min, -0.5f);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(joints_without_limits_are_proposals)
{
  sbfi_scene scene;
  converted c;
  make_arm(&scene);
  memset(((sbfi_scene_node *)(uintptr_t)scene.nodes)[3].limits, 0, sizeof scene.nodes[3].limits);
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert(joint_named(c.asset, "arm")->proposed);
  ck_assert_uint_eq(joint_named(c.asset, "arm")->limits.count, 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* The build gives these bodies their hulls, of all their sections, and makes no others. */
START_TEST(the_build_adds_their_hulls)
{
  sbfi_scene scene;
  converted c;
  make_arm(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  sbf_asset *built;
  sbf_build_report report;
  ck_assert_int_eq(sbf_build(c.asset, NULL, &built, &report, NULL), SBF_OK);
  ck_assert_uint_eq(report.hulls, 2);
  ck_assert_uint_eq(built->rigid_bodies.count, 2);
  const sbf_rigid_body *arm = &built->rigid_bodies.at[1];
  ck_assert(arm->derived == SBF_NONE && arm->hull_derived == 0);
  ck_assert_uint_eq(arm->hull->positions.count, 8); /* of both boxes in one */
  float low = INFINITY, high = -INFINITY;
  for (uint32_t i = 0; i < 8; i++) {
    low = fminf(low, arm->hull->positions.at[i].y);
    high = fmaxf(high, arm->hull->positions.at[i].y);
  }
  ck_assert_float_eq_tol(high - low, 1.5f, 1e-6f);
  ck_assert_uint_eq(built->joints.count, 1);
  sbf_asset_free(built);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

static const sbf_limit *limit_of(const sbf_joint *joint, sbf_joint_axis axis) {
  for (uint32_t i = 0; i < joint->limits.count; i++)
    if (joint->limits.at[i].target == axis) return &joint->limits.at[i];
  ck_abort_msg("joint %s has no such limit", joint->name);
  return NULL;
}

/* The example's own limits, through assimp; examples/lizard/README.md has them in degrees. */
START_TEST(the_example_lizard_has_its_limits)
{
  converted c;
  converted_file(&c, harness_source("examples/lizard/lizard.glb"), NULL);
  const sbf_asset *a = c.asset;
  ck_assert_uint_eq(a->soft_bodies.count, 22);
  ck_assert_uint_eq(a->rigid_bodies.count, 22);
  ck_assert_uint_eq(a->joints.count, 21); /* all but the pelvis, which hangs on the root */
  for (uint32_t i = 0; i < 21; i++) {
    ck_assert_uint_eq(a->joints.at[i].limits.count, 3);
    ck_assert(!a->joints.at[i].proposed);
    check_frames(a, &a->joints.at[i]);
  }
  static const struct {
    const char *bone;
    double swing_y, swing_z_min, swing_z_max, twist;
  } rows[] = {{"spine", 25, -15, 15, 15}, {"head", 40, -35, 30, 25}, {"tail5", 42, -37, 37, 10},
      {"lower_leg.L", 8, -60, 65, 12}, {"lower_leg.R", 8, -60, 65, 12}, {"hand.R", 25, -50, 50, 20}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    const sbf_joint *joint = joint_named(a, rows[i].bone);
    const double degree = 3.14159265358979 / 180;
    ck_assert_double_eq_tol(
        (double)limit_of(joint, SBF_JOINT_AXIS_SWING_Y)->max, rows[i].swing_y * degree, 1e-4);
    ck_assert_double_eq_tol(
        (double)limit_of(joint, SBF_JOINT_AXIS_SWING_Y)->min, -rows[i].swing_y * degree, 1e-4);
    ck_assert_double_eq_tol(
        (double)limit_of(joint, SBF_JOINT_AXIS_SWING_Z)->min, rows[i].swing_z_min * degree, 1e-4);
    ck_assert_double_eq_tol(
        (double)limit_of(joint, SBF_JOINT_AXIS_SWING_Z)->max, rows[i].swing_z_max * degree, 1e-4);
    ck_assert_double_eq_tol((double)limit_of(joint, SBF_JOINT_AXIS_TWIST)->max, rows[i].twist * degree, 1e-4);
  }
  converted_free(&c);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_joints");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, bones_with_sections_become_bodies_and_joints);
  tcase_add_test(tests, joints_without_limits_are_proposals);
  tcase_add_test(tests, the_build_adds_their_hulls);
  tcase_add_test(tests, the_example_lizard_has_its_limits);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
