#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness.h"
#include "motion/retargeting.h"
#include "sbfmt/convert.h"

/* Hips a metre up, a thigh of half a metre to its side and a shin; the thigh swings forward by 90 degrees and
 * the hips go two metres. In centimetres: only ratios matter. */
static const char bvh[] =
    "HIERARCHY\nROOT mixamorig:Hips\n{\n OFFSET 0 100 0\n"
    " CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    " JOINT mixamorig:LeftUpLeg\n {\n  OFFSET 10 0 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "  JOINT mixamorig:LeftLeg\n  {\n   OFFSET 0 -50 0\n   CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "   End Site\n   {\n    OFFSET 0 -50 0\n   }\n  }\n }\n"
    " JOINT Antenna\n {\n  OFFSET 0 10 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "  End Site\n  {\n   OFFSET 0 10 0\n  }\n }\n}\n"
    "MOTION\nFrames: 2\nFrame Time: 0.5\n"
    "30 100 40 0 0 0  0 0 0  0 0 0  0 0 0\n"
    "30 100 240 0 0 0  0 -90 0  0 45 0  0 0 0\n";

static void add_bone(
    sbf_asset *asset, const char *name, int32_t parent, sbf_vec3 head, sbf_quat rotation, float length) {
  sbf_bone *bones = (sbf_bone *)(uintptr_t)asset->bones.at;
  if (!bones) asset->bones.at = bones = sbf_asset_allocate(asset, 8, sizeof *bones);
  sbf_bone *bone = &bones[asset->bones.count++];
  sbf_bone_init(bone);
  bone->id = bone->name = name;
  bone->parent = parent;
  bone->head = head;
  bone->rotation = rotation;
  bone->length = length;
}

/* Half as high, its leg spread by 30 degrees: bones run along their +Y. */
static sbf_asset *figure(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  float s = sinf(1.3089969f), c = cosf(1.3089969f); /* half of 150 degrees about +Z */
  sbf_quat down = {0, 0, -s, c};
  sbf_vec3 hip = {0.05f, 0.5f, 0}, knee = {0.05f + 0.125f, 0.5f - 0.25f * 0.8660254f, 0};
  add_bone(asset, "pelvis", SBF_NONE, (sbf_vec3){0, 0.5f, 0}, (sbf_quat){0, 0, 0, 1}, 0.1f);
  add_bone(asset, "thigh.L", 0, hip, down, 0.25f);
  add_bone(asset, "shin_l", 1, knee, down, 0.25f);
  add_bone(asset, "ear", 0, (sbf_vec3){0, 0.6f, 0}, (sbf_quat){0, 0, 0, 1}, 0.1f);
  return asset;
}

typedef struct notes {
  uint32_t clips, unmatched;
  char last[512];
} notes;

static void take(void *user, const sbf_diagnostic *d) {
  notes *n = user;
  n->clips += d->code == SBF_CODE_IMPORT_MOTION;
  n->unmatched += d->code == SBF_CODE_IMPORT_MOTION_UNMATCHED;
  snprintf(n->last, sizeof n->last, "%s", d->message);
}

static const char *put(const char *name, const char *text) {
  const char *path = harness_scratch(name);
  ck_assert(harness_write(path, text, strlen(text)));
  return path;
}

/* Where a bone's +Y points at a time. */
static void direction(const sbf_asset *asset, float time_s, uint32_t bone, double *to, double *position) {
  static const double along[3] = {0, 1, 0};
  sbfi_bone_frame frames[8];
  sbfi_clip_poses poses;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert(sbfi_clip_poses_init(&poses, asset, &asset->clips.at[0], &scratch));
  sbfi_clip_pose(&poses, time_s, frames);
  sbfi_quatd_rotate(frames[bone].rotation, along, to);
  memcpy(position, frames[bone].position, sizeof frames[bone].position);
  sbfi_arena_free(&scratch);
}

static void expect(const double *is, double x, double y, double z) {
  ck_assert_msg(fabs(is[0] - x) + fabs(is[1] - y) + fabs(is[2] - z) < 1e-4, "%g %g %g, not %g %g %g", is[0],
      is[1], is[2], x, y, z);
}

START_TEST(the_hips_move_half_as_far_as_a_leg)
{
  sbf_asset *asset = figure();
  notes n = {0};
  sbf_diagnostic error;
  const sbf_convert_options options = {.report = take, .user = &n};
  sbf_status status = sbf_convert_motion(asset, put("swing.bvh", bvh), &options, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  ck_assert_uint_eq(asset->clips.count, 1);
  ck_assert_uint_eq(n.clips, 1);
  ck_assert_uint_eq(n.unmatched, 2); /* the ear here, the antenna there */
  ck_assert_uint_eq(sbf_asset_check(asset, NULL, NULL, 0), 0);
  double to[3], position[3];
  direction(asset, 0, 1, to, position);
  expect(to, 0, -1, 0); /* straight down, as the source's leg is, however this one was spread */
  expect(position, 0.05, 0.5, 0);
  direction(asset, 0.5f, 1, to, position);
  expect(to, 0, 0, 1);
  /* by the heights of the thighs above the lowest point, which the end site marks */
  expect(position, 0.05, 0.5, 2 * 0.5 * 0.8660254);
  direction(asset, 0.5f, 2, to, position);
  expect(to, 0, -sqrt(0.5), sqrt(0.5));
  direction(asset, 0.5f, 3, to, position);
  expect(to, 0, 1, 0); /* follows its parent */
  sbf_asset_free(asset);
}
END_TEST

START_TEST(a_second_clip_has_an_id_of_its_own)
{
  sbf_asset *asset = figure();
  const char *path = put("two words.bvh", bvh);
  ck_assert_int_eq(sbf_convert_motion(asset, path, NULL, NULL), SBF_OK);
  ck_assert_int_eq(sbf_convert_motion(asset, path, NULL, NULL), SBF_OK);
  ck_assert_uint_eq(asset->clips.count, 2);
  ck_assert_str_ne(asset->clips.at[0].id, asset->clips.at[1].id);
  ck_assert_uint_eq(sbf_asset_check(asset, NULL, NULL, 0), 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(motions_that_cannot_be_retargeted_are_refused)
{
  sbf_asset *asset = figure(), *empty = sbf_asset_create(NULL);
  sbf_diagnostic error;
  ck_assert_int_eq(sbf_convert_motion(empty, put("a.bvh", bvh), NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_MOTION_NONE);
  const sbf_bone *bones = asset->bones.at;
  for (uint32_t i = 0; i < 4; i++) ((sbf_bone *)(uintptr_t)bones)[i].name = "thing";
  ck_assert_int_eq(sbf_convert_motion(asset, put("a.bvh", bvh), NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_MOTION_NONE);
  ck_assert_ptr_nonnull(strstr(error.file, "a.bvh"));
  ck_assert_int_eq(
      sbf_convert_motion(asset, put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), NULL, &error),
      SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_MOTION_NONE);
  ck_assert_int_eq(sbf_convert_motion(asset, "/no/such.bvh", NULL, &error), SBF_FAILED);
  ck_assert_uint_eq(asset->clips.count, 0);
  sbf_asset_free(asset);
  sbf_asset_free(empty);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_motion");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, the_hips_move_half_as_far_as_a_leg);
  tcase_add_test(tests, a_second_clip_has_an_id_of_its_own);
  tcase_add_test(tests, motions_that_cannot_be_retargeted_are_refused);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
