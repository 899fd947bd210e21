#include "build/sections/section_joints.h"

#include "harness.h"
#include "promises.h"
#include "sbfmt/build.h"
#include "skinned_limb.h"

static const skinned_limb limb = {.bones = 4, .sides = 8, .rings_a_bone = 4, .radius = 0.2f, .slope = 0.5f};

static sbf_asset *build(const sbf_asset *asset, bool without_hulls) {
  sbf_asset *built;
  ck_assert_int_eq(
      sbf_build(asset, &(sbf_build_options){.without_hulls = without_hulls}, &built, NULL, NULL), SBF_OK);
  ck_assert_promises_kept(built);
  return built;
}

START_TEST(a_joint_at_each_head)
{
  sbf_asset *asset = skinned_limb_make(&limb), *built = build(asset, false);
  ck_assert_uint_eq(built->joints.count, 3);
  for (uint32_t j = 0; j < 3; j++) {
    const sbf_joint *joint = &built->joints.at[j];
    const sbf_rigid_body *a = &built->rigid_bodies.at[joint->body_a],
                         *b = &built->rigid_bodies.at[joint->body_b];
    ck_assert_int_eq(joint->kind, SBF_JOINT_KIND_SPHERICAL);
    ck_assert(joint->proposed);
    ck_assert_int_eq(joint->derived, 0);
    ck_assert_int_eq(a->bone, (int32_t)j);
    ck_assert_int_eq(b->bone, (int32_t)j + 1);
    ck_assert_float_eq_tol(a->center.y + joint->frame_a.position.y, (float)j + 1, 1e-5f);
    ck_assert_float_eq_tol(b->center.y + joint->frame_b.position.y, (float)j + 1, 1e-5f);
    /* Its +X is the bone's +Y, which is +Y of the asset. */
    sbf_quat q = joint->frame_b.rotation;
    ck_assert_float_eq_tol(2 * (q.x * q.y + q.w * q.z), 1, 1e-5f);
  }
  sbf_asset_free(built);
  built = build(asset, true);
  ck_assert_uint_eq(built->joints.count, 0);
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(joints_of_the_source_are_kept)
{
  /* Bone 2 has a body and a joint already. */
  sbf_asset *asset = skinned_limb_make(&limb);
  sbf_rigid_body *body = sbf_asset_allocate(asset, 1, sizeof *body);
  sbf_joint *joint = sbf_asset_allocate(asset, 1, sizeof *joint);
  sbf_rigid_body_init(body);
  body->id = "body";
  body->bone = 2;
  sbf_joint_init(joint);
  joint->id = "hinge";
  joint->kind = SBF_JOINT_KIND_REVOLUTE;
  joint->body_b = 0;
  asset->rigid_bodies = (sbf_rigid_body_list){body, 1};
  asset->joints = (sbf_joint_list){joint, 1};
  sbf_asset *built = build(asset, false), *again = build(built, false);
  ck_assert_uint_eq(built->joints.count, 3);
  ck_assert_str_eq(built->joints.at[0].id, "hinge");
  ck_assert_int_eq(built->joints.at[0].derived, SBF_NONE);
  ck_assert_int_eq(built->rigid_bodies.at[built->joints.at[0].body_b].bone, 2);
  for (uint32_t j = 1; j < 3; j++)
    ck_assert_int_ne(built->rigid_bodies.at[built->joints.at[j].body_b].bone, 2);
  char where[256] = "";
  ck_assert_msg(sbf_asset_equal(built, again, where, sizeof where), "%s", where);
  sbf_asset_free(again);
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_joints");
  TCase *c = tcase_create("section_joints");
  tcase_add_test(c, a_joint_at_each_head);
  tcase_add_test(c, joints_of_the_source_are_kept);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
