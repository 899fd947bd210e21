#include <string.h>

#include "harness.h"
#include "motion/retargeting.h"

enum { MAX = 16 };

static sbf_asset *skeleton(const char *const *names) {
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_bone *bones = sbf_asset_allocate(asset, MAX, sizeof *bones);
  for (; names[asset->bones.count]; asset->bones.count++) {
    sbf_bone *bone = &bones[asset->bones.count];
    sbf_bone_init(bone);
    bone->id = bone->name = names[asset->bones.count];
    bone->parent = (int32_t)asset->bones.count - 1;
    bone->rotation = (sbf_quat){1, 0, 0, 0}; /* +Y down */
  }
  asset->bones.at = bones;
  return asset;
}

static void expect(const char *const *from, const char *const *to, const int32_t *sources) {
  sbf_asset *a = skeleton(from), *b = skeleton(to);
  sbfi_bone_match matches[MAX];
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert_int_ge(sbfi_match_bones(a, b, &scratch, matches), 0);
  for (uint32_t i = 0; to[i]; i++)
    ck_assert_msg(
        matches[i].source == sources[i], "%s follows %d, not %d", to[i], matches[i].source, sources[i]);
  sbfi_arena_free(&scratch);
  sbf_asset_free(a);
  sbf_asset_free(b);
}

START_TEST(names_mean_parts)
{
  static const char *const cmu[] = {"Hips", "LHipJoint", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg",
      "LeftArm", "LeftForeArm", "LeftHand", "LeftShoulder", "Head", NULL};
  static const char *const blender[] = {"pelvis", "thigh.L", "shin.L", "foot.L", "thigh.R", "upper_arm.L",
      "forearm.L", "hand.L", "shoulder.L", "head", "tail", NULL};
  expect(cmu, blender, (const int32_t[]){0, 2, 3, 4, 5, 6, 7, 8, 9, 10, SBF_NONE});
  static const char *const biped[] = {
      "Bip001 Pelvis", "Bip001 L Thigh", "Bip001 L Calf", "Bip001 R Thigh", "mixamorig:LeftUpLeg", NULL};
  expect(cmu, biped, (const int32_t[]){0, 2, 3, 5, 2});
  static const char *const control[] = {"LeftFootCtrl", "LeftFootIK", "foot_l", NULL};
  expect(cmu, control, (const int32_t[]){SBF_NONE, SBF_NONE, 4});
}
END_TEST

START_TEST(the_meaning_of_a_word_depends_on_the_others)
{
  static const char *const cmu[] = {"Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", NULL};
  static const char *const numbered[] = {"root", "Leg.001.L", "Leg.002.L", "Leg.003.L", NULL};
  expect(cmu, numbered, (const int32_t[]){0, 1, 2, 3});
  static const char *const short_legs[] = {"hip_L", "leg_L", NULL}; /* hips that run down are thighs */
  expect(cmu, short_legs, (const int32_t[]){1, 2});
}
END_TEST

START_TEST(several_bones_of_a_part_match_by_fraction)
{
  static const char *const three[] = {"Spine", "Spine1", "Spine2", NULL};
  static const char *const two[] = {"spine_01", "chest", NULL}, *const five[] = {"spine", "spine.001",
                                                                    "spine.002", "spine.003", "spine.004",
                                                                    NULL};
  expect(three, two, (const int32_t[]){1, 2});
  expect(two, three, (const int32_t[]){0, 1, 1});
  expect(three, five, (const int32_t[]){0, 1, 1, 2, 2});
}
END_TEST

START_TEST(chains_come_first)
{
  static const char *const a_names[] = {"Head", "a", "b", NULL}, *const b_names[] = {"Head", "x", "y", NULL};
  static const uint32_t a_bones[] = {1, 2}, b_bones[] = {0, 1};
  const sbf_retarget_chain a_chain = {.id = "c", .name = "Leg_Left", .bones = {a_bones, 2}};
  const sbf_retarget_chain b_chain = {.id = "c", .name = "leg.L", .bones = {b_bones, 2}};
  sbf_asset *a = skeleton(a_names), *b = skeleton(b_names);
  a->retarget_chains = (sbf_retarget_chain_list){&a_chain, 1};
  b->retarget_chains = (sbf_retarget_chain_list){&b_chain, 1};
  sbfi_bone_match matches[MAX];
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert_int_eq(sbfi_match_bones(a, b, &scratch, matches), 2);
  ck_assert_int_eq(matches[0].source, 1);
  ck_assert_int_eq(matches[1].source, 2);
  ck_assert_int_eq(matches[2].source, SBF_NONE);
  sbfi_arena_free(&scratch);
  sbf_asset_free(a);
  sbf_asset_free(b);
}
END_TEST

START_TEST(chains_identify_parts_without_names)
{
  static const char *const names[] = {"b0", "b1", "b2", "b3", "b4", "b5", "b6", "b7", NULL};
  static const uint32_t leg[] = {1, 2, 3}, arm[] = {4, 5, 6, 7};
  static const sbfi_part parts[] = {SBFI_PART_HIPS, SBFI_PART_THIGH, SBFI_PART_LIMB, SBFI_PART_OTHER,
      SBFI_PART_OTHER, SBFI_PART_LIMB, SBFI_PART_LIMB, SBFI_PART_HAND};
  const sbf_retarget_chain chains[] = {
      {.id = "l", .name = "left_leg", .bones = {leg, 3}}, {.id = "a", .name = "ArmRight", .bones = {arm, 4}}};
  sbf_asset *a = skeleton(names), *b = skeleton(names);
  for (uint32_t i = 1; i < 8; i++) ((sbf_bone *)(uintptr_t)b->bones.at)[i].parent = 0;
  b->retarget_chains = (sbf_retarget_chain_list){chains, 2};
  sbfi_bone_match matches[MAX];
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert_int_eq(sbfi_match_bones(a, b, &scratch, matches), 8);
  for (uint32_t i = 0; i < 8; i++) ck_assert_int_eq(matches[i].part, parts[i]);
  sbfi_arena_free(&scratch);
  sbf_asset_free(a);
  sbf_asset_free(b);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("bone_match");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, names_mean_parts);
  tcase_add_test(tests, the_meaning_of_a_word_depends_on_the_others);
  tcase_add_test(tests, several_bones_of_a_part_match_by_fraction);
  tcase_add_test(tests, chains_come_first);
  tcase_add_test(tests, chains_identify_parts_without_names);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
